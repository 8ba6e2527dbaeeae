// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/free/motion.hpp"

/// Equal control torques without rotor momentum (docs/deceleration.md, section 2.3): the torque is parallel to M, so the body goes through
/// its free motion, only ever more slowly. Exact for any torque and drag.
namespace gyrostat::deceleration {

/// |M|, by d|M|/dt = -drag |M| - control, and the clock of the free motion, tau = int |M| dt/|M(0)|.
template <Real Scalar>
class EqualTorqueLaw {
 public:
  EqualTorqueLaw() = default;
  /// @param control greatest torque, >= 0, N m  @param drag >= 0, 1/s  @param norm |M| at t = 0, > 0, N m s
  EqualTorqueLaw(Scalar control, Scalar drag, Scalar norm) noexcept : b_(control), drag_(drag), norm_(norm) {}

  /// Time at which M vanishes, s; infinite without control.
  Scalar stop_time() const noexcept {
    if (!(b_ > 0)) return infinity<Scalar>;
    const Scalar undragged = norm_ / b_, x = drag_ * undragged;
    if (!(x > 0)) return undragged;
    // the drag itself may be too small to keep its digits in products, and the time without it may be beyond all numbers
    return x < infinity<Scalar> ? undragged * (std::log1p(x) / x) : std::log1p(drag_ * norm_ / b_) / drag_;
  }

  /// |M|, N m s; 0 from the stop on.
  Scalar norm(Scalar t) const noexcept {
    if (!(t < stop_time())) return 0;
    return std::max(Scalar(0), norm_ * std::exp(-drag_ * t) - b_ * t * phi1(drag_ * t));
  }

  /// tau, s; constant from the stop on, and never more than 1/drag.
  Scalar clock(Scalar t) const noexcept {
    t = std::min(t, stop_time());
    const Scalar x = drag_ * t;
    return t * (phi1(x) - b_ / norm_ * t * phi2(x));
  }

  /// How far the clock may be off at tau, by the rounding of the data and its own, s.
  Scalar clock_error(Scalar tau) const noexcept {
    return b_ == 0 && drag_ == 0 ? Scalar(0) : 8 * epsilon<Scalar> * tau;
  }

 private:
  /// (1 - e^-x)/x, x >= 0.
  static Scalar phi1(Scalar x) noexcept { return x > 0 ? -std::expm1(-x) / x : Scalar(1); }

  /// (e^-x - 1 + x)/x^2, x >= 0, by its series below 1 where the difference cancels.
  static Scalar phi2(Scalar x) noexcept {
    if (x >= 1) return (x + std::expm1(-x)) / (x * x);
    Scalar term = Scalar(.5), sum = term;
    for (int n = 3; n < 26; ++n) sum += term *= -x / Scalar(n);
    return sum;
  }

  Scalar b_ = 0, drag_ = 0, norm_ = 1;
};

/// The whole motion: attitude and direction of M are at t what they are in the free motion at tau(t).
template <Real Scalar>
class EqualTorqueMotion {
 public:
  /// Body axes.
  struct Sample {
    Scalar norm;                    ///< |M|, N m s; 0 from the stop on
    Scalar tau;                     ///< the free motion's time, s
    free::State<Scalar> unbraked;   ///< the free motion then
    Vec3<Scalar> angular_momentum;  ///< M, N m s
  };

  EqualTorqueMotion() = default;
  /// @param body without rotor momentum; M must not vanish. Setup as in free::Motion::make. Errors: those of it.
  template <Real Setup = Scalar>
  static Result<EqualTorqueMotion> make(const free::Problem<Setup>& body, Scalar control, Scalar drag) noexcept {
    const auto motion = free::Motion<Scalar>::template make<Setup>(body);
    if (!motion) return motion.error();
    return EqualTorqueMotion({control, drag, motion->angular_momentum_norm()}, *motion);
  }

  Sample at(Scalar t) const noexcept {
    const Scalar norm = law_.norm(t), tau = law_.clock(t);
    const auto unbraked = motion_.at(tau);
    return {norm, tau, unbraked, unbraked.angular_momentum * (norm / motion_.angular_momentum_norm())};
  }

  const EqualTorqueLaw<Scalar>& law() const noexcept { return law_; }
  const free::Motion<Scalar>& unbraked() const noexcept { return motion_; }

 private:
  EqualTorqueMotion(const EqualTorqueLaw<Scalar>& law, const free::Motion<Scalar>& motion) noexcept
      : law_(law), motion_(motion) {}

  EqualTorqueLaw<Scalar> law_;
  free::Motion<Scalar> motion_;
};

}  // namespace gyrostat::deceleration
