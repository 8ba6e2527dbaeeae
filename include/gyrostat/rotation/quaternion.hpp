// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Hamilton's product: rotate(p * q, v) = rotate(p, rotate(q, v)).
template <Real Scalar>
constexpr Quat<Scalar> operator*(const Quat<Scalar>& p, const Quat<Scalar>& q) noexcept {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}

/// The inverse of a unit quaternion.
template <Real Scalar>
constexpr Quat<Scalar> conjugate(const Quat<Scalar>& q) noexcept {
  return {q.w, -q.x, -q.y, -q.z};
}

/// Without overflow or underflow of the squares.
template <Real Scalar>
Scalar norm(const Quat<Scalar>& q) noexcept {
  using std::hypot, std::sqrt;
  const Scalar least = std::numeric_limits<Scalar>::min() / epsilon<Scalar>;  // whose roundings are numbers
  const Scalar square = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z);
  if (square > least && square < infinity<Scalar>) return sqrt(square);
  return hypot(hypot(q.w, q.x), hypot(q.y, q.z));
}

/// q / |q|; NaN where q vanishes or is not finite.
template <Real Scalar>
Quat<Scalar> normalised(const Quat<Scalar>& q) noexcept {
  const Scalar n = norm(q);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

/// q as it stands where it is of unit norm to rounding, else q / |q|.
template <Real Scalar>
Quat<Scalar> as_unit(const Quat<Scalar>& q) noexcept {
  using std::abs;
  return abs(norm(q) - 1) <= 4 * epsilon<Scalar> ? q : normalised(q);
}

/// q v q*, for a unit quaternion.
template <Real Scalar>
Vec3<Scalar> rotate(const Quat<Scalar>& q, const Vec3<Scalar>& v) noexcept {
  const Vec3<Scalar> u(q.x, q.y, q.z);
  const Vec3<Scalar> twice = cross<Scalar>(u, v) * Scalar(2);
  return v + q.w * twice + cross<Scalar>(u, twice);
}

/// The rotation tensor of a unit quaternion, R v = rotate(q, v). Proper and orthogonal as far as q has unit norm.
template <Real Scalar>
Mat3<Scalar> to_matrix(const Quat<Scalar>& q) noexcept {
  const Scalar x = 2 * q.x, y = 2 * q.y, z = 2 * q.z;
  const Scalar xx = x * q.x, yy = y * q.y, zz = z * q.z;
  Mat3<Scalar> R;
  R << 1 - (yy + zz), x * q.y - z * q.w, x * q.z + y * q.w,  //
      x * q.y + z * q.w, 1 - (xx + zz), y * q.z - x * q.w,   //
      x * q.z - y * q.w, y * q.z + x * q.w, 1 - (xx + yy);
  return R;
}

/// The unit quaternion with w >= 0 of a rotation tensor. The largest of its four components is found first and divides
/// the rest (Shepperd 1978), so the relative accuracy of small rotations and of the axis of half a turn is kept. Of a
/// tensor that is orthogonal to rounding only, a nearby rotation.
template <Real Scalar>
Quat<Scalar> from_matrix(const Mat3<Scalar>& R) noexcept {
  const Scalar trace = R(0, 0) + R(1, 1) + R(2, 2);
  Quat<Scalar> q;
  if (trace >= R(0, 0) && trace >= R(1, 1) && trace >= R(2, 2)) {
    q = {1 + trace, R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)};
  } else if (R(0, 0) >= R(1, 1) && R(0, 0) >= R(2, 2)) {
    q = {R(2, 1) - R(1, 2), 1 + R(0, 0) - (R(1, 1) + R(2, 2)), R(1, 0) + R(0, 1), R(0, 2) + R(2, 0)};
  } else if (R(1, 1) >= R(2, 2)) {
    q = {R(0, 2) - R(2, 0), R(1, 0) + R(0, 1), 1 + R(1, 1) - (R(0, 0) + R(2, 2)), R(2, 1) + R(1, 2)};
  } else {
    q = {R(1, 0) - R(0, 1), R(0, 2) + R(2, 0), R(2, 1) + R(1, 2), 1 + R(2, 2) - (R(0, 0) + R(1, 1))};
  }
  using std::copysign;
  const Scalar n = copysign(norm(q), q.w);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

/// The angle of the rotation between two attitudes, rad; the signs of the quaternions do not matter.
template <Real Scalar>
Scalar angle_between(const Quat<Scalar>& p, const Quat<Scalar>& q) noexcept {
  const Quat<Scalar> d = conjugate(p) * q;
  const Scalar square = d.x * d.x + d.y * d.y + d.z * d.z, sine = std::sqrt(square);
  if (square < Scalar(1e-6L)) return 2 * sine * (1 + square / 6);  // of the arc sine, to 1e-13 of it
  return 2 * std::atan2(sine, std::abs(d.w));
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
