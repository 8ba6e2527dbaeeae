// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// R(q) v, rounded once at the end: for constants of a motion found at its start, whose rounding all its steps would inherit. q need not have
/// unit norm.
template <Real Scalar>
Vec3<Scalar> rotate_once(const Quat<Scalar>& q, const Vec3<Scalar>& v) noexcept {
  using Wide = Wider<Scalar>;
  const Quat<Wide> wide{Wide(q.w), Wide(q.x), Wide(q.y), Wide(q.z)};
  return vector_cast<Scalar>(rotate<Wide>(normalised(wide), vector_cast<Wide>(v)));
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
