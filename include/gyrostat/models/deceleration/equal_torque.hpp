// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/models/deceleration/euler_poinsot.hpp"

namespace gyrostat::deceleration {

/// Equal control torques without rotor momentum (deceleration.md, section 2): the torque is parallel to M, so |M| obeys
/// d|M|/dt = -drag |M| - b and M runs along its free polhode in the clock |M| dt. Exact for any b and drag.
template <Real Scalar, class Elliptic = math::Native>
class EqualTorqueMotion {
 public:
  struct Sample {
    Scalar norm;            ///< |M|, N m s; 0 from the stop on
    Vec3<Scalar> momentum;  ///< M in principal axes, N m s
  };

  /// @param problem momentum != 0, rotor momentum 0, control b times the unit tensor; exactly
  /// on the separatrix (modulus().kp2 = 0) M is NaN
  explicit EqualTorqueMotion(const Problem<Scalar>& problem) noexcept
      : b_(problem.control(0, 0)), drag_(problem.drag), start_(problem.momentum), norm_(start_.norm()) {
    polhode_ = polhode_through<Scalar>(problem.inverse_inertia, problem.inverse_gaps(), start_);
    // A sphere, or M across an axis of symmetry: omega is parallel to M for ever.
    steady_ = !std::isfinite(polhode_.modulus.k2) || !std::isfinite(polhode_.modulus.kp2);
    ratio_ = start_.dot(problem.inverse_inertia.cwiseProduct(start_)) / (norm_ * norm_);
    if (steady_) return;
    argument_ = argument_of<Elliptic>(polhode_, start_);
    if (problem.exact_gaps) return;
    const auto& x = polhode_.axes;
    const Vec3<Scalar> off = problem.gap_errors();
    const Scalar near_mid = off[x.near / 2] / x.near_mid;
    gap_error_ = near_mid + polhode_.tilt / polhode_.along * (off[1 - x.near / 2] + x.mid_far * near_mid) / x.near_mid;
  }

  /// Time at which M vanishes, s; infinite without control.
  Scalar stop_time() const noexcept {
    if (!(b_ > 0)) return infinity<Scalar>;
    return drag_ > 0 ? std::log1p(drag_ * norm_ / b_) / drag_ : norm_ / b_;
  }

  Sample at(Scalar t) const noexcept {
    if (!(t < stop_time())) return {0, Vec3<Scalar>::Zero()};
    const Scalar norm = std::max(Scalar(0), norm_ * std::exp(-drag_ * t) - b_ * t * phi1(drag_ * t));
    if (steady_) return {norm, start_ * (norm / norm_)};
    return {norm, momentum_on<Elliptic>(polhode_, norm, argument_ + turn(t))};
  }

  /// Relative rounding error of M at t: the rounding of the start grows with the turn, and as 1/kp2 near the separatrix;
  /// that of the moments counts the more the nearer two of them are.
  Scalar rounding(Scalar t) const noexcept {
    const Scalar far = std::min(t, stop_time());
    if (steady_) return 8 * epsilon<Scalar>;
    const auto& x = polhode_.axes;
    const Scalar gap = x.axisymmetric() ? x.near_mid : std::min(x.near_mid, x.mid_far);
    const Scalar start = 3 * epsilon<Scalar> * (1 + std::sqrt(x.near_far / gap));
    return (start + gap_error_) * (2 + turn(far)) / polhode_.modulus.kp2;
  }

  math::Modulus<Scalar> modulus() const noexcept { return steady_ ? math::Modulus<Scalar>{0, 1} : polhode_.modulus; }
  /// nullptr where omega is parallel to M for ever.
  const Polhode<Scalar>* polhode() const noexcept { return steady_ ? nullptr : &polhode_; }
  Regime regime() const noexcept { return steady_ ? Regime::point : polhode_.regime; }
  Scalar energy_ratio() const noexcept { return ratio_; }  ///< 2h/M^2, constant, 1/(kg m^2)

 private:
  /// Growth of u up to t: rate times the integral of |M|.
  Scalar turn(Scalar t) const noexcept {
    const Scalar x = drag_ * t;
    return polhode_.rate_per_momentum() * t * (norm_ * phi1(x) - b_ * t * phi2(x));
  }

  /// (1 - e^-x)/x, x >= 0.
  static Scalar phi1(Scalar x) noexcept { return x > 0 ? -std::expm1(-x) / x : Scalar(1); }

  /// (e^-x - 1 + x)/x^2, x >= 0, by its series below 1 where the difference cancels.
  static Scalar phi2(Scalar x) noexcept {
    if (x >= 1) return (x + std::expm1(-x)) / (x * x);
    Scalar term = Scalar(.5), sum = term;
    for (int n = 3; n < 26; ++n) sum += term *= -x / Scalar(n);
    return sum;
  }

  Scalar b_, drag_;
  Vec3<Scalar> start_;
  Scalar norm_;
  Polhode<Scalar> polhode_{};
  Scalar argument_ = 0, ratio_ = 0;
  Scalar gap_error_ = 0;  ///< relative, of the rate and of k2, from the differences of the moments
  bool steady_ = false;
};

}  // namespace gyrostat::deceleration
