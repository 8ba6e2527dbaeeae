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
#if defined(GYROSTAT_COMPILED)
  std::printf("gyrostat %s, compiled\n", gyrostat::library_version());
#else
  std::printf("gyrostat %s, headers\n", gyrostat::header_version);
#endif
  return gyrostat::epsilon<double> > 0 ? 0 : 1;
}
