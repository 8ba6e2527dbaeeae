// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "gyrostat/core/real.hpp"

#if defined(__clang__)
#define GYROSTAT_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
// it warns where it does not vectorise one all the same
#define GYROSTAT_QUIET_LOOPS _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wpass-failed\"")
#define GYROSTAT_QUIET_LOOPS_END _Pragma("clang diagnostic pop")
#elif defined(__GNUC__)
#define GYROSTAT_INDEPENDENT _Pragma("GCC ivdep")
#else
#define GYROSTAT_INDEPENDENT
#endif
#if !defined(GYROSTAT_QUIET_LOOPS)
#define GYROSTAT_QUIET_LOOPS
#define GYROSTAT_QUIET_LOOPS_END
#endif

namespace gyrostat::spinning {

/// Where a grid of the linear motion is written: an array for each quantity, none of them overlapping, SI units.
template <Real Scalar>
struct GridColumns {
  Scalar *p, *q;              ///< body rates
  Scalar *psi, *phi, *theta;  ///< 3-1-2 angles
  Scalar *G1, *G2;            ///< inertial momentum
  Scalar *v1, *v2, *v3;       ///< inertial velocity
  Scalar *x1, *x2, *x3;       ///< inertial position
  Scalar* G3 = nullptr;       ///< inertial momentum along axis 3; nullptr: not wanted

  /// The same arrays from entry n on.
  GridColumns from(std::size_t n) const noexcept {
    return {p + n,  q + n,  psi + n, phi + n, theta + n, G1 + n, G2 + n,
            v1 + n, v2 + n, v3 + n,  x1 + n,  x2 + n,    x3 + n, G3 == nullptr ? nullptr : G3 + n};
  }
};

}  // namespace gyrostat::spinning
