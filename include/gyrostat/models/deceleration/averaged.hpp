// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "gyrostat/models/deceleration/euler_poinsot.hpp"

/// Averaged deceleration without rotor momentum (deceleration.md, section 2), in both regimes and through the separatrix.
namespace gyrostat::deceleration {

/// Principal control torques as a regime sees them, N m.
template <Real Scalar>
struct ControlTorques {
  Scalar near, mid, far;

  static ControlTorques of(const Mat3<Scalar>& control, const PolhodeAxes<Scalar>& axes) noexcept {
    return {control(axes.near, axes.near), control(1, 1), control(axes.far, axes.far)};
  }
};

/// What the torques do to a polhode in the mean: d|M|/dt = -drag |M| - deceleration,
/// dk2/dt = 2 kp2 escape/|M|, so that -d ln(kp2)/dt = 2 escape/|M|; escape carries the factor k2.
template <Real Scalar>
struct MeanTorque {
  Scalar deceleration;  ///< D, N m
  Scalar escape;  ///< G/kp2 (of the tilt equation where the near axis is one of symmetry: G = tilt (1 - tilt) g), N m
  Scalar K;       ///< quarter period in u
};

/// Orbit means of the control torque on the polhode p. NaN in, NaN out.
template <class Elliptic = math::Native, Real Scalar>
MeanTorque<Scalar> mean_torque(const Polhode<Scalar>& p, const ControlTorques<Scalar>& b) noexcept {
  const Scalar k2 = p.modulus.k2, kp2 = p.modulus.kp2;
  if (p.axes.axisymmetric()) {
    const Scalar across = (b.mid + b.far) / 2;
    return {b.near * p.along + across * p.tilt, p.tilt * p.along * (b.near - across), pi<Scalar> / 2};
  }
  const auto m = Elliptic::means(p.modulus);
  const Scalar alpha = p.axes.mid_far + p.axes.near_mid * k2;
  const Scalar D =
      (b.near * p.axes.mid_far * m.F + b.mid * p.axes.near_far * m.W + b.far * p.axes.near_mid * m.V) / alpha;
  return {D, (b.near - b.far) * (k2 / kp2) * m.F - (b.mid - b.far) * m.W, m.K};
}

/// The averaged equations over the arc length of the path (ln|M|, x), x = -ln kp2 (the tilt itself where the near axis
/// is one of symmetry): regular at rest, where ln|M| falls for ever, and through the separatrix, where x runs to
/// infinity and comes back in the other regime.
///
/// State: ln(|M|/reference), x, t [s], and the phase u/K.
template <class Elliptic, Real Scalar>
class AveragedEquations {
 public:
  using State = std::array<Scalar, 4>;
  enum Index : int { log_norm, spread, time, phase };

  /// x at which the separatrix is taken as reached: kp2 has sunk under the rounding of k2.
  static constexpr Scalar crossing = std::numeric_limits<Scalar>::digits * Scalar(0.6931471805599453L);

  AveragedEquations(const Polhode<Scalar>& start, const Mat3<Scalar>& control, Scalar drag, Scalar reference) noexcept
      : family_(start), control_(ControlTorques<Scalar>::of(control, start.axes)), drag_(drag), reference_(reference) {}

  State state_of(const Polhode<Scalar>& p, Scalar norm, Scalar t, Scalar phi) const noexcept {
    const Scalar x = p.axes.axisymmetric()       ? p.tilt
                     : p.modulus.k2 < Scalar(.5) ? -std::log1p(-p.modulus.k2)
                                                 : -std::log(p.modulus.kp2);
    return {std::log(norm / reference_), x, t, phi};
  }

  Polhode<Scalar> polhode(const State& y) const noexcept {
    Polhode<Scalar> p = family_;
    if (p.axes.axisymmetric()) {
      p.tilt = y[spread];
      p.along = 1 - p.tilt;
      return p;
    }
    const Scalar minus_k2 = std::expm1(-y[spread]);
    return at_modulus(p, {-minus_k2, y[spread] < Scalar(.7) ? 1 + minus_k2 : std::exp(-y[spread])});
  }
  Scalar norm(const State& y) const noexcept { return reference_ * std::exp(y[log_norm]); }
  const ControlTorques<Scalar>& control() const noexcept { return control_; }
  MeanTorque<Scalar> torque(const Polhode<Scalar>& p) const noexcept { return mean_torque<Elliptic>(p, control_); }

  void operator()(Scalar, const State& y, State& dy) const noexcept {
    const Polhode<Scalar> p = polhode(y);
    const auto mean = torque(p);
    const Scalar M = norm(y);
    const Scalar fall = drag_ * M + mean.deceleration, spreading = 2 * mean.escape;
    const Scalar speed = std::sqrt(fall * fall + spreading * spreading);
    const Scalar turn = p.rate_per_momentum() / mean.K;  // phase per unit of |M| dt
    const Scalar dt = speed > 0 ? M / speed : 1 / (turn * M);
    dy[log_norm] = -fall * dt / M;
    dy[spread] = spreading * dt / M;
    dy[time] = dt;
    dy[phase] = turn * M * dt;
  }

 private:
  Polhode<Scalar> family_;
  ControlTorques<Scalar> control_;
  Scalar drag_, reference_;
};

}  // namespace gyrostat::deceleration
