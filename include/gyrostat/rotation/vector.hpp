// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

template <Real Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

template <Real Scalar>
using Mat3 = Eigen::Matrix<Scalar, 3, 3>;

/// Quaternion w + x i + y j + z k (Hamilton's product). As an attitude it has unit norm and takes body components to
/// inertial ones, v_I = q v_B q*; q and -q are the same attitude.
template <Real Scalar>
struct Quat {
  Scalar w = 1;
  Scalar x = 0;
  Scalar y = 0;
  Scalar z = 0;

  friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

/// |v|, also where its square would overflow or vanish. The same bits wherever v lies: Eigen's sums depend on the address.
template <Real Scalar>
Scalar magnitude(const Vec3<Scalar>& v) noexcept {
  using std::abs, std::sqrt;
  const Scalar least = std::numeric_limits<Scalar>::min() / epsilon<Scalar>;  // whose roundings are numbers
  const Scalar square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if (square > least && square < infinity<Scalar>) return sqrt(square);
  const Scalar x = abs(v[0]), y = abs(v[1]), z = abs(v[2]);
  Scalar most = x < y ? y : x;
  most = most < z ? z : most;
  if (!(square == square) || !(most > 0) || !(most < infinity<Scalar>)) return x + y + z;
  const Scalar a = x / most, b = y / most, c = z / most;
  return most * sqrt(a * a + b * b + c * c);
}

/// a x b.
template <Real Scalar>
Vec3<Scalar> cross(const Vec3<Scalar>& a, const Vec3<Scalar>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// [v]x, the skew tensor with [v]x b = v x b.
template <Real Scalar>
Mat3<Scalar> cross_matrix(const Vec3<Scalar>& v) noexcept {
  Mat3<Scalar> m;
  m << 0, -v[2], v[1],  //
      v[2], 0, -v[0],   //
      -v[1], v[0], 0;
  return m;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
