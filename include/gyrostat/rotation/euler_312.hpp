// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The 3-1-2 angles (psi, phi, theta), rad: R_IB = Rz(theta) Rx(psi) Ry(phi).
namespace gyrostat::inline GYROSTAT_LEVEL {

/// The unit quaternion of the angles.
template <Real Scalar>
Quat<Scalar> quaternion_from_312(Scalar psi, Scalar phi, Scalar theta) noexcept {
  const Scalar cx = std::cos(psi / 2), sx = std::sin(psi / 2);
  const Scalar cy = std::cos(phi / 2), sy = std::sin(phi / 2);
  const Scalar cz = std::cos(theta / 2), sz = std::sin(theta / 2);
  return {cz * cx * cy - sz * sx * sy, cz * sx * cy - sz * cx * sy, cz * cx * sy + sz * sx * cy,
          sz * cx * cy + cz * sx * sy};
}

/// (psi, phi, theta) of a unit quaternion: |psi| <= pi/2, phi and theta in [-pi, pi]. An error d of the attitude becomes one of about
/// d/cos(psi) in phi and theta. At cos(psi) = 0 only theta + phi (psi > 0) or theta - phi has a meaning, and comes back right.
template <Real Scalar>
Vec3<Scalar> angles_312(const Quat<Scalar>& q) noexcept {
  const Scalar a = 2 * (q.y * q.z + q.w * q.x);                            // R32
  const Scalar b = 2 * (q.w * q.y - q.x * q.z);                            // -R31
  const Scalar c = (q.w - q.y) * (q.w + q.y) + (q.z - q.x) * (q.z + q.x);  // R33
  const Scalar phi = std::atan2(b, c);
  // (theta + phi)/2 or (theta - phi)/2, the one that stays determined
  const Scalar theta = a > 0 ? 2 * std::atan2(q.z + q.y, q.w + q.x) - phi : 2 * std::atan2(q.z - q.y, q.w - q.x) + phi;
  return {std::atan2(a, std::hypot(b, c)), phi, std::remainder(theta, 2 * pi<Scalar>)};
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
