// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/rotation/phi.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// How an attitude moves with the angular velocity omega_B in body axes, rad/s. The attitude takes body components to
/// inertial ones, v_I = R_IB v_B = q v_B q*.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// dq/dt = q (0, omega_B) / 2.
template <Real Scalar>
Quat<Scalar> quaternion_rate(const Quat<Scalar>& q, const Vec3<Scalar>& omega_B) noexcept {
  const Quat<Scalar> half{0, omega_B[0] / 2, omega_B[1] / 2, omega_B[2] / 2};
  return q * half;
}

/// dR_IB/dt = R_IB [omega_B]x (Poisson).
template <Real Scalar>
Mat3<Scalar> matrix_rate(const Mat3<Scalar>& R_IB, const Vec3<Scalar>& omega_B) noexcept {
  return R_IB * cross_matrix<Scalar>(omega_B);
}

/// The body components of a vector fixed in space: dv_B/dt = v_B x omega_B (Poisson).
template <Real Scalar>
Vec3<Scalar> fixed_vector_rate(const Vec3<Scalar>& v_B, const Vec3<Scalar>& omega_B) noexcept {
  return cross<Scalar>(v_B, omega_B);
}

/// T(v) of the rotation vector v with omega_B = T(v) dv/dt:
/// T = I - (1 - cos a)/a^2 [v]x + (a - sin a)/a^3 [v]x^2, a = |v| <= 4 pi.
template <Real Scalar>
Mat3<Scalar> right_tangent(const Vec3<Scalar>& v) noexcept {
  const Scalar angle = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const Mat3<Scalar> V = cross_matrix<Scalar>(v);
  return Mat3<Scalar>::Identity() - versine_ratio(angle) * V + sine_defect_ratio(angle) * (V * V);
}

/// omega_I = T(v) dv/dt; the transpose of the right one.
template <Real Scalar>
Mat3<Scalar> left_tangent(const Vec3<Scalar>& v) noexcept {
  return right_tangent<Scalar>(-v);
}

/// dv/dt = T(v) omega_B, |v| < 2 pi: I + [v]x/2 + (1 - (a/2) cot(a/2))/a^2 [v]x^2.
template <Real Scalar>
Mat3<Scalar> right_tangent_inverse(const Vec3<Scalar>& v) noexcept {
  const Scalar angle = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const Mat3<Scalar> V = cross_matrix<Scalar>(v);
  return Mat3<Scalar>::Identity() + V / 2 + cotangent_defect_ratio(angle) * (V * V);
}

/// dv/dt = T(v) omega_I, |v| < 2 pi.
template <Real Scalar>
Mat3<Scalar> left_tangent_inverse(const Vec3<Scalar>& v) noexcept {
  return right_tangent_inverse<Scalar>(-v);
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
