// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/math/complex.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::heavy {

/// The attitude of the Euler angles of docs/heavy.md, section 3: down = (sin theta sin phi, sin theta cos phi, cos theta) in body axes,
/// and psi the precession about the vertical, right-handed about DOWN: R_IB = diag(1, -1, -1) Rz(psi) Rx(theta) Rz(phi). Without
/// a jump of sign where the angles have none.
/// @param psi, phi rad   @param down unit; theta is taken of it
template <Real Scalar>
Quat<Scalar> attitude_from_angles(Scalar psi, Scalar phi, const Vec3<Scalar>& down) noexcept {
  // cos and sin of theta/2, the larger one first
  const Scalar larger = std::sqrt((1 + std::abs(down[2])) / 2),
               smaller = std::sqrt(down[0] * down[0] + down[1] * down[1]) / (2 * larger);
  const Scalar c = down[2] < 0 ? smaller : larger, s = down[2] < 0 ? larger : smaller;
  const auto sum = math::unit((psi + phi) / 2), difference = math::unit((psi - phi) / 2);
  return {-s * difference.re, c * sum.re, -c * sum.im, s * difference.im};
}

/// The angle phi of down nearest to pi/2 + u, rad. @param turn e^(i u)
template <Real Scalar>
Scalar spin_angle(const Vec3<Scalar>& down, Scalar u, math::Complex<Scalar> turn) noexcept {
  return pi<Scalar> / 2 + u +
         std::atan2(-(down[0] * turn.im + down[1] * turn.re), down[0] * turn.re - down[1] * turn.im);
}

}  // namespace gyrostat::heavy
