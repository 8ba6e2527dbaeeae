// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/rotation/phi.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The unit quaternion of a rotation vector v (axis times angle, rad), any length below 1e154.
template <Real Scalar>
Quat<Scalar> quaternion_from_vector(const Vec3<Scalar>& v) noexcept {
  // Where the square underflows sinc is 1 to the last bit.
  const Scalar half = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2;
  const Scalar s = sinc(half) / 2;
  return {std::cos(half), s * v[0], s * v[1], s * v[2]};
}

/// The shortest rotation vector of a quaternion of any norm > 0, |v| <= pi; q and -q give the same one, but for half a
/// turn, where the vector part gives the sign.
template <Real Scalar>
Vec3<Scalar> vector_from_quaternion(const Quat<Scalar>& q) noexcept {
  const Scalar s = std::hypot(q.x, q.y, q.z);
  const Scalar angle = 2 * std::atan2(s, std::abs(q.w));
  const Scalar k = s == 0 ? angle : (q.w < 0 ? -angle : angle) / s;
  return {k * q.x, k * q.y, k * q.z};
}

/// The rotation tensor of a rotation vector: I + sinc(a) [v]x + (1 - cos a)/a^2 [v]x^2, a = |v|.
template <Real Scalar>
Mat3<Scalar> matrix_from_vector(const Vec3<Scalar>& v) noexcept {
  const Scalar angle = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const Mat3<Scalar> V = cross_matrix<Scalar>(v);
  return Mat3<Scalar>::Identity() + sinc(angle) * V + versine_ratio(angle) * (V * V);
}

/// The shortest rotation vector of a rotation tensor, |v| <= pi.
template <Real Scalar>
Vec3<Scalar> vector_from_matrix(const Mat3<Scalar>& R) noexcept {
  return vector_from_quaternion(from_matrix(R));
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
