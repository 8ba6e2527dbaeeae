// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/rotation/vector.hpp"

/// What the free gyrostat conserves: the energy of its carrier, and the total momentum in space, hence its length.
namespace gyrostat {

/// h = omega . J omega / 2, J. Any axes, the same for both. The integral of the free gyrostat whose rotors are held at
/// a constant relative rate; the rotors' own energy is not in it.
template <Real Scalar>
Scalar carrier_energy(const Mat3<Scalar>& J, const Vec3<Scalar>& omega) noexcept {
  return omega.dot(J * omega) / 2;
}

/// M = J omega + l, N m s; l relative to the carrier.
template <Real Scalar>
Vec3<Scalar> total_momentum(const Mat3<Scalar>& J, const Vec3<Scalar>& omega,
                            const Vec3<Scalar>& rotor_momentum) noexcept {
  return J * omega + rotor_momentum;
}

/// |v| without overflow or underflow of the squares.
template <Real Scalar>
Scalar safe_norm(const Vec3<Scalar>& v) noexcept {
  return std::hypot(v[0], v[1], v[2]);
}

}  // namespace gyrostat
