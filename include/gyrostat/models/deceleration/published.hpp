// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "gyrostat/math/elliptic.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The dimensionless equations (27), (28) of the paper on quasi-optimal deceleration of an asymmetric gyrostat in a
/// resistive medium ([1] of docs/references.md), and the formulas that feed them, as printed and with the misprints
/// corrected (docs/deceleration.md, section 8). For the reproduction of its figures only. Corrected does not mean right:
/// with rotor momentum they average over the orbit of a body without.
namespace gyrostat::deceleration::published {

enum class Reading : std::uint8_t { printed, corrected };

/// The data of a figure, SI units; principal axes, A > B > C.
template <Real Scalar>
struct Data {
  Vec3<Scalar> inertia;           ///< A, B, C, kg m^2
  Vec3<Scalar> rotor_momentum;    ///< l, N m s
  Vec3<Scalar> angular_velocity;  ///< (p0, q0, r0), rad/s
  Vec3<Scalar> control;           ///< b, N m
  Scalar drag;                    ///< lambda T: dimensionless, see System
  Scalar sigma;                   ///< b3 T/M0, the identifying number (26)

  /// M = J omega + l at the start, N m s.
  Vec3<Scalar> momentum() const noexcept { return inertia.cwiseProduct(angular_velocity) + rotor_momentum; }
  /// The unit of momentum, |M| at the start.
  Scalar momentum_unit() const noexcept { return momentum().norm(); }
  /// The unit T of slow time, from (26), s.
  Scalar time_unit() const noexcept { return sigma * momentum_unit() / control[2]; }
  /// H of (9), the carrier's energy and l.omega, J. It is not conserved by the free gyrostat.
  Scalar energy() const noexcept {
    return angular_velocity.dot(inertia.cwiseProduct(angular_velocity)) / 2 + rotor_momentum.dot(angular_velocity);
  }
};

/// L1, L2 of (10), (N m s)^2. Corrected, L1 = C S0 and L2 = A S0 with S0 = l.J^-1 l.
template <Real Scalar>
std::array<Scalar, 2> rotor_terms(const Data<Scalar>& d, Reading reading) noexcept {
  const Vec3<Scalar>& J = d.inertia;
  const Vec3<Scalar> l2 = d.rotor_momentum.cwiseProduct(d.rotor_momentum);
  const Scalar third = reading == Reading::printed ? J[0] / J[1] : J[0] / J[2];
  return {J[2] / J[0] * l2[0] + J[2] / J[1] * l2[1] + l2[2], l2[0] + J[0] / J[1] * l2[1] + third * l2[2]};
}

/// k2 of (11) at the start. The corrected one is that of the body without rotors at the same momentum M, where it lies in
/// [0, 1]; above one the orbit is in the other regime.
template <Real Scalar>
Scalar modulus_squared(const Data<Scalar>& d, Reading reading) noexcept {
  const auto [L1, L2] = rotor_terms(d, reading);
  const Scalar A = d.inertia[0], B = d.inertia[1], C = d.inertia[2];
  const Scalar M2 = d.momentum().squaredNorm(), H = d.energy();
  const bool printed = reading == Reading::printed;
  return (B - C) * (2 * A * H + (printed ? L1 : L2) - M2) / ((A - B) * (M2 - 2 * C * H - (printed ? L2 : L1)));
}

/// M^2/(2H) of (13), kg m^2; of the corrected one, H counts half of S0 in.
template <Real Scalar>
Scalar momentum_energy_ratio(const Vec3<Scalar>& J, Scalar k2, Reading reading) noexcept {
  const Scalar A = J[0], B = J[1], C = J[2];
  const Scalar beta1 = A * (B - C) + (reading == Reading::printed ? (A - C) * C : C * (A - B)) * k2;
  return beta1 / ((B - C) + (A - B) * k2);
}

/// b1/b3 of (22) for which k2 is quasi-stationary at b2/b3 = kappa2: line 1 of figure 3. k2 in (0, 1).
template <class Elliptic = math::Native, Real Scalar>
Scalar quasi_stationary_ratio(Scalar kappa2, math::Modulus<Scalar> m, Reading reading) noexcept {
  const auto mean = Elliptic::means(m);
  const Scalar slope = (m.k2 * mean.F - mean.V) / (m.k2 * mean.F);
  return (reading == Reading::printed ? kappa2 - 1 : kappa2) * slope + mean.V / (m.k2 * mean.F);
}

/// The greatest b1/b3 for which k2 falls, (29), correct as printed.
template <class Elliptic = math::Native, Real Scalar>
Scalar greatest_ratio(Scalar kappa2, math::Modulus<Scalar> m) noexcept {
  const auto mean = Elliptic::means(m);
  return (kappa2 * m.kp2 * mean.W + mean.V) / (m.k2 * mean.F);
}

/// The system (27) for (H/b3, |M|/M0, k2) over t/T, T = sigma M0/b3 in slow time. The printed value 0.2 of lambda is
/// read as that of lambda T: the only reading in which |M| vanishes near t = T. Where k2 leaves [0, 1) or |M| vanishes
/// the equations end: NaN.
template <Real Scalar, class Elliptic = math::Native>
class System {
 public:
  using State = std::array<Scalar, 3>;
  enum Index : int { energy, momentum, modulus };

  System(const Data<Scalar>& d, Reading reading) noexcept
      : reading_(reading),
        kappa_{d.control[0] / d.control[2], d.control[1] / d.control[2]},
        drag_(d.drag),
        sigma_(d.sigma) {
    const Scalar unit = d.momentum_unit();
    const auto L = rotor_terms(d, reading);
    L_ = {L[0] / (unit * unit), L[1] / (unit * unit)};
    J_ = d.inertia / (unit * d.time_unit());
  }

  /// H/b3 of (28).
  Scalar energy_at(Scalar M, Scalar k2) const noexcept {
    const Scalar A = J_[0], B = J_[1], C = J_[2];
    const Scalar M2 = M * M;
    const Scalar sum = reading_ == Reading::printed ? (B - C) * (L_[0] - M2) - k2 * (A - B) * (M2 - L_[1])
                                                    : (B - C) * (M2 - L_[1]) + k2 * (A - B) * (M2 - L_[0]);
    return sum / (2 * sigma_ * alpha(k2));
  }

  /// The start |M| = M0 at k2.
  State start(Scalar k2) const noexcept { return {energy_at(1, k2), 1, k2}; }

  void operator()(Scalar, const State& y, State& dydt) const noexcept {
    const Scalar A = J_[0], B = J_[1], C = J_[2];
    const Scalar M = y[momentum], k2 = y[modulus];
    if (!(M > 0 && k2 < 1)) {
      dydt.fill(nan<Scalar>);
      return;
    }
    const auto mean = Elliptic::means(math::Modulus<Scalar>::from_k2(k2));
    const Scalar F = mean.F, W = mean.W, V = mean.V;
    const bool printed = reading_ == Reading::printed;
    const Scalar third = printed ? F - k2 - 1 : V;
    const Scalar stored = printed ? y[energy] : y[energy] + L_[0] / (2 * C * sigma_);
    const Scalar inertia_scale = alpha(k2);
    dydt[energy] =
        -2 * drag_ * stored - M / inertia_scale * (kappa_[0] * (B - C) * F + kappa_[1] * (A - C) * W + (A - B) * third);
    dydt[momentum] = -drag_ * M - sigma_ / inertia_scale *
                                      (kappa_[0] * A * (B - C) * F + kappa_[1] * B * (A - C) * W + C * (A - B) * V);
    const Scalar growth = kappa_[0] * k2 * F + kappa_[1] * W * (k2 - 1) - V;
    dydt[modulus] = printed ? 2 * sigma_ / denominator(M) * growth : 2 * sigma_ / M * growth;
  }

  /// The printed denominator of dk2/dt. It vanishes at some |M| above M0 for the data of figures 5 to 13.
  Scalar denominator(Scalar M) const noexcept { return M * M * (J_[0] - J_[2]) - J_[0] * L_[1] + J_[2] * L_[0]; }

 private:
  Scalar alpha(Scalar k2) const noexcept { return J_[0] * (J_[1] - J_[2]) + J_[2] * (J_[0] - J_[1]) * k2; }

  Reading reading_;
  std::array<Scalar, 2> kappa_;  // b1/b3, b2/b3
  Scalar drag_;
  Scalar sigma_;
  std::array<Scalar, 2> L_;  // in units of M0^2
  Vec3<Scalar> J_;           // in units of M0 T
};

}  // namespace gyrostat::deceleration::published
