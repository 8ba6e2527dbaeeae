// SPDX-License-Identifier: BSD-3-Clause
// What a user of each component writes first.
#include <cstdio>

#include "gyrostat/gyrostat.hpp"
#if defined(GYROSTAT_HAVE_GSL)
#include "gyrostat/math/gsl.hpp"
#endif
#if defined(GYROSTAT_HAVE_CVODE)
#include "gyrostat/ode/cvode.hpp"
#endif

int main() {
  const auto half = gyrostat::math::Native::complete(gyrostat::math::Modulus<double>::from_k2(0.5));
  if (!(half.K > half.E)) return 1;
#if defined(GYROSTAT_COMPILED)
  std::printf("gyrostat %s, compiled\n", gyrostat::library_version());
#else
  std::printf("gyrostat %s, headers\n", gyrostat::header_version);
#endif
  return 0;
}
