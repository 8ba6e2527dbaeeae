// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/lanes.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// a i + b j + c k, the sum of three quaternions (w, x, y, z) each multiplied from the right by a unit of the algebra: with
/// a = q o1, b = q o2, c = q o3 it is q (0, o).
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> times_units(const Lanes<Scalar>& a, const Lanes<Scalar>& b,
                                          const Lanes<Scalar>& c) noexcept {
  const Scalar one = 1;
  return multiply_add(shuffle<1, 0, 3, 2>(a), lanes(-one, one, one, -one),
                      multiply_add(shuffle<2, 3, 0, 1>(b), lanes(-one, -one, one, one),
                                   shuffle<3, 2, 1, 0>(c) * lanes(-one, one, -one, one)));
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
