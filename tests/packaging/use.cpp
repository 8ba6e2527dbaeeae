// SPDX-License-Identifier: BSD-3-Clause
// What a user writes first, with each component that there is.
#include <cstdio>

#include "gyrostat/gyrostat.hpp"
#if defined(GYROSTAT_HAVE_GSL)
#include "gyrostat/math/gsl.hpp"
#endif
#if defined(GYROSTAT_HAVE_CVODE)
#include "gyrostat/ode/cvode.hpp"
#endif

namespace {

template <class Elliptic>
bool right() {
  const auto half = Elliptic::complete(gyrostat::math::Modulus<double>::from_k2(0.5));
  return half.K > half.E;
}

}  // namespace

int main() {
  if (!right<gyrostat::math::Native>()) return 1;
#if defined(GYROSTAT_HAVE_GSL)
  if (!right<gyrostat::math::Gsl>()) return 1;
#endif
#if defined(GYROSTAT_HAVE_CVODE)
  // no equations, so no solver: a failure comes back as a value
  if (gyrostat::ode::Cvode::create({}, 0, {})) return 1;
#endif
#if defined(GYROSTAT_COMPILED)
  std::printf("gyrostat %s, compiled\n", gyrostat::library_version());
#else
  std::printf("gyrostat %s, headers\n", gyrostat::header_version);
#endif
  return 0;
}
