// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A thrusting, charged gyrostat that spins about its body axis 3 under torques and forces constant in the body
/// (docs/spinning.md, section 2):
///     D1 p' = M1 - q [(D3 - D2) r + Lambda],   D2 q' = M2 + p [(D3 - D1) r + Lambda],   D3 r' = M3 - (D2 - D1) p q,
///     R' = R [omega]x,   m v' = R f,   x' = v.
namespace gyrostat::spinning {

/// 3-1-2 angles, rad: R_IB = Rz(theta) Rx(psi) Ry(phi); psi and phi tilt axis 3, theta is the spin angle, not reduced by turns.
template <Real Scalar>
struct Angles {
  Scalar psi = 0, phi = 0, theta = 0;
};

/// A motion at one time. Body axes but for momentum_I, velocity and position, which are inertial. SI units.
template <Real Scalar>
struct State {
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< (p, q, r), rad/s
  Angles<Scalar> angles;
  Quat<Scalar> attitude;             ///< body to inertial
  Vec3<Scalar> momentum_I{0, 0, 0};  ///< R (D1 p, D2 q, D3 r + lambda3), N m s
  Vec3<Scalar> velocity{0, 0, 0};    ///< of the mass centre, m/s
  Vec3<Scalar> position{0, 0, 0};    ///< of the mass centre, m
};

/// Rate, rad/s, that a torque of angular acceleration `drive`, rad/s^2, builds up from rest within `span`, s: until the span ends, the body has turned,
/// or, unless the torque is axial, the gyroscopic `stiffness`, 1/s, stops it.
template <Real Scalar>
Scalar built_rate(Scalar drive, Scalar stiffness, bool axial, Scalar span) noexcept {
  const Scalar built = std::min(drive * span, std::sqrt(drive));
  return axial ? built : std::min(built, drive / stiffness);
}

/// Body, loads and start. Plain data: whoever fills it has validated it. Axis 3 is the spin axis.
template <Real Scalar>
struct Problem {
  Vec3<Scalar> inertia{1, 1, 1};           ///< D1, D2, D3, kg m^2
  Scalar mass = 1;                         ///< kg
  Scalar rotor_momentum = 0;               ///< lambda3, along axis 3, constant and relative to the carrier, N m s
  Scalar charge_momentum = 0;              ///< e_H = e H l^2 cos(sigma): the Lorentz torque is e_H (q, -p, 0), N m s
  Vec3<Scalar> torque{0, 0, 0};            ///< M, N m
  Vec3<Scalar> force{0, 0, 0};             ///< f, N
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< (p, q, r) at t = 0, rad/s
  Angles<Scalar> angles;                   ///< at t = 0
  Vec3<Scalar> velocity{0, 0, 0};          ///< at t = 0, inertial, m/s
  Vec3<Scalar> position{0, 0, 0};          ///< at t = 0, inertial, m
  bool converted = false;  ///< rates and torque were turned into these axes: each component errs as the greatest does

  Scalar spin() const noexcept { return angular_velocity[2]; }                     ///< r0, rad/s
  Scalar gyroscopic() const noexcept { return rotor_momentum - charge_momentum; }  ///< Lambda, N m s
  /// L3 = D3 r0 + lambda3, N m s.
  Scalar axial_momentum() const noexcept { return inertia[2] * spin() + rotor_momentum; }
  /// X = L3 - e_H, which sets every gyroscopic stiffness, N m s.
  Scalar effective_momentum() const noexcept { return inertia[2] * spin() + gyroscopic(); }
  /// ((D3 - D2) r + Lambda)/D1 at spin r, 1/s; 0 where a rotor or a charge cancels the stiffness but for rounding.
  Scalar kappa1(Scalar r) const noexcept { return stiffness((inertia[2] - inertia[1]) * r) / inertia[0]; }
  /// ((D3 - D1) r + Lambda)/D2 at spin r, 1/s; likewise.
  Scalar kappa2(Scalar r) const noexcept { return stiffness((inertia[2] - inertia[0]) * r) / inertia[1]; }
  /// The greater of |D3 - D2|/D1 and |D3 - D1|/D2: how much of a change of the spin goes into what turns the transverse rates.
  Scalar greatest_zeta() const noexcept {
    return std::max(std::abs(inertia[2] - inertia[1]) / inertia[0], std::abs(inertia[2] - inertia[0]) / inertia[1]);
  }
  /// How fast the body turns at the start, or is soon made to within `span`, s; rad/s.
  Scalar rate_size(Scalar span) const noexcept {
    const Scalar stiffness = std::max(std::abs(gyroscopic() / inertia[0]), std::abs(gyroscopic() / inertia[1]));
    return std::max(angular_velocity.norm(),
                    built_rate(torque.cwiseQuotient(inertia).norm(), stiffness, torque[2] != 0, span));
  }
  /// The angle that body and nutation turn through in `span`, s, to its order, rad.
  Scalar phase(Scalar span) const noexcept {
    const Scalar spun_up = std::abs(torque[2]) / inertia[2] * span / 2;  // rate, on the mean
    return span * (rate_size(span) + spun_up + std::abs(gyroscopic()) / std::min(inertia[0], inertia[1]));
  }
  /// nu^2 = kappa1 kappa2 at r0, 1/s^2: negative where the spin is unstable.
  Scalar nutation_squared() const noexcept { return kappa1(spin()) * kappa2(spin()); }

 private:
  Scalar stiffness(Scalar of_spin) const noexcept {
    const Scalar sum = of_spin + gyroscopic();
    const Scalar rounding = 2 * epsilon<Scalar> * (std::abs(rotor_momentum) + std::abs(charge_momentum));
    return std::abs(sum) <= rounding ? Scalar(0) : sum;
  }
};

}  // namespace gyrostat::spinning
