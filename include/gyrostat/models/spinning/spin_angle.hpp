// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The spin angle theta of the 3-1-2 angles, not reduced by turns (docs/spinning.md, section 2).
namespace gyrostat::spinning {

/// Follows theta along a motion, turn by turn, for certain.
///
/// theta is the argument of c = R22 - i R12, |c| = cos(psi), and theta less the integral A of r that of c e^{-iA}, whose rate is at most
/// |Pi| sin(beta) + |r| (1 - cos(beta)), beta being the tilt of axis 3. That rate is bounded over an interval by
///     |Pi|' <= |M1 + i M2|/D + |kappa1 - kappa2|/2 |Pi|,   y' <= |D^-1/2 M|,  y^2 = omega.D omega,   |(sin(beta/2))'| <= |Pi|/2,
/// so an interval over which c e^{-iA} moves by less than |c| cannot hide a turn, and longer ones are halved.
///
/// Where the motion crosses cos(psi) = 0 theta jumps by pi, forward or back. Close by, theta follows the motion past the line, on the
/// side on which it passes; least_cosine() tells how near it came, and below the error of the attitude the side is not known.
template <Real Scalar>
class SpinAngle {
 public:
  /// What is seen of the motion at one time.
  struct Sample {
    Vec3<Scalar> angular_velocity;
    Quat<Scalar> attitude;
    Scalar turned;  ///< the integral of r since the start, rad
  };

  /// At t = 0. theta keeps the turns of the start's, |psi| is brought below pi/2 and phi stays within pi of the start's.
  explicit SpinAngle(const Problem<Scalar>& problem) noexcept
      : inertia_(problem.inertia),
        drive_(std::hypot(problem.torque[0] / inertia_[0], problem.torque[1] / inertia_[1])),
        power_(problem.torque.cwiseQuotient(inertia_.cwiseSqrt()).norm()),
        root_inverse_{1 / std::sqrt(std::min(inertia_[0], inertia_[1])), 1 / std::sqrt(inertia_[2])},
        split_slope_(std::abs((inertia_[2] - inertia_[1]) / inertia_[0] - (inertia_[2] - inertia_[0]) / inertia_[1]) /
                     2),
        split_(std::abs(problem.gyroscopic() * (1 / inertia_[0] - 1 / inertia_[1])) / 2) {
    const auto& a = problem.angles;
    last_ = {problem.angular_velocity, quaternion_from_312(a.psi, a.phi, a.theta), 0};
    look();
    const bool upright = std::cos(a.psi) >= 0;
    phi_ = upright ? a.phi : a.phi + std::remainder(angles_[1] - a.phi, 2 * pi<Scalar>);
    theta_ = a.theta + std::remainder(angles_[2] - a.theta, 2 * pi<Scalar>);
  }

  /// Goes on to t >= the last time, where the motion is `sample`. `at(t)`: the sample at a time in between.
  template <class At>
  void follow(Scalar t, const Sample& sample, const At& at) noexcept {
    for (int trip = 1; trip <= trip_cap && time_ < t; ++trip) {
      // nearer to cos(psi) = 0 than rounding the side is not known anyway
      const Scalar room = std::max(Scalar(0.9L) * cosine_, 16 * epsilon<Scalar>);
      Scalar step = t - time_;
      Scalar moved = drift(step);
      while (moved > room && time_ + step / 2 > time_ && trip < trip_cap) {
        step /= 2;
        moved = drift(step);
      }
      const bool arrives = !(step < t - time_);
      least_cosine_ = std::min(least_cosine_, std::max(Scalar(0), cosine_ - moved));
      const Scalar from = last_.turned;
      const Scalar theta = theta_;
      last_ = arrives ? sample : at(time_ + step);
      time_ = arrives ? t : time_ + step;
      look();
      const Scalar expected = theta + (last_.turned - from);
      theta_ = angles_[2] + 2 * pi<Scalar> * std::round((expected - angles_[2]) / (2 * pi<Scalar>));
    }
  }

  /// At the last time.
  Angles<Scalar> angles() const noexcept {
    return {angles_[0], phi_ + std::remainder(angles_[1] - phi_, 2 * pi<Scalar>), theta_};
  }
  /// How far phi is from the ends of its range at the last time, rad.
  Scalar phi_room() const noexcept { return pi<Scalar> - std::abs(std::remainder(angles_[1] - phi_, 2 * pi<Scalar>)); }
  /// cos(psi) at the last time.
  Scalar cosine() const noexcept { return cosine_; }
  /// A lower bound of cos(psi) so far.
  Scalar least_cosine() const noexcept { return least_cosine_; }

 private:
  static constexpr int trip_cap = 1000;

  void look() noexcept {
    const Quat<Scalar>& q = last_.attitude;
    angles_ = angles_312(q);
    const Vec3<Scalar>& w = last_.angular_velocity;
    transverse_ = std::hypot(w[0], w[1]);
    root_energy_ = std::sqrt(w.dot(inertia_.cwiseProduct(w)));
    half_tilt_sine_ = std::hypot(q.x, q.y);
    cosine_ = std::hypot(2 * (q.w * q.z - q.x * q.y), (q.w - q.z) * (q.w + q.z) + (q.y - q.x) * (q.y + q.x));
  }

  /// Bound of how far c e^{-iA} moves in a time from the last sample.
  Scalar drift(Scalar step) const noexcept {
    const Scalar y = root_energy_ + power_ * step;
    const Scalar r = y * root_inverse_[1];
    const Scalar pi_by_energy = y * root_inverse_[0];
    const Scalar pi_by_rate = (transverse_ + drive_ * step) * std::exp((split_slope_ * r + split_) * step);
    const Scalar rate = std::min(pi_by_energy, pi_by_rate);
    const Scalar s = std::min(Scalar(1), half_tilt_sine_ + rate * step / 2);
    return step * (rate * std::min(Scalar(1), 2 * s) + 2 * r * s * s);
  }

  Vec3<Scalar> inertia_;
  Scalar drive_, power_;
  Scalar root_inverse_[2];  ///< of the least transverse and of the axial moment
  Scalar split_slope_, split_;
  Scalar time_ = 0, phi_ = 0, theta_ = 0;
  Scalar transverse_ = 0, root_energy_ = 0, half_tilt_sine_ = 0, cosine_ = 0;  // at the last sample
  Scalar least_cosine_ = 1;
  Vec3<Scalar> angles_{0, 0, 0};
  Sample last_{};
};

/// What an error of the attitude makes of the angles at the times at which they were looked at.
template <Real Scalar>
class AngleLever {
 public:
  void look(const SpinAngle<Scalar>& angle) noexcept {
    cosine_ = std::min(cosine_, angle.cosine());
    room_ = std::min(room_, angle.phi_room());
    least_cosine_ = angle.least_cosine();
  }

  /// A lower bound of cos(psi) up to the last time.
  Scalar least_cosine() const noexcept { return std::min(cosine_, least_cosine_); }
  /// Turns of theta or phi are not known: the motion came nearer to cos(psi) = 0, or phi to the end of its range, than this error of the
  /// attitude, rad.
  bool loses_turns(Scalar attitude_error) const noexcept {
    return !(attitude_error < Scalar(0.3L) * least_cosine()) || !(attitude_error < room_ * cosine_);
  }
  /// The error of the angles, rad.
  Scalar error(Scalar attitude_error) const noexcept {
    return 2 * attitude_error / cosine_ + (loses_turns(attitude_error) ? 2 * pi<Scalar> : Scalar(0));
  }

 private:
  Scalar cosine_ = 1, room_ = pi<Scalar>, least_cosine_ = 1;
};

}  // namespace gyrostat::spinning
