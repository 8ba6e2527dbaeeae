// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

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
/// |Pi| sin(beta) + |r| (1 - cos(beta)), beta being the tilt of axis 3. That rate is bounded over an interval, from either end, by
///     |Pi|' <= |M1 + i M2|/D + |kappa1 - kappa2|/2 |Pi|,   |r|' <= |M3|/D3 + |D1 - D2|/(2 D3) |Pi|^2,   |(sin(beta/2))'| <= |Pi|/2,
///     y' <= |D^-1/2 M|,  y^2 = omega.D omega.
/// So an interval over whose halves c e^{-iA} moves by less than its |c| at the ends cannot hide a turn; a longer one is divided.
///
/// Where the motion crosses cos(psi) = 0 theta jumps by pi, forward or back. Close by, theta follows the motion past the line, on the
/// side on which it passes; least_cosine() says how near it came, and below the error of the attitude the side is not known.
template <Real Scalar>
class SpinAngle {
 public:
  /// What is seen of the motion at one time.
  struct Sample {
    Vec3<Scalar> angular_velocity;
    Quat<Scalar> attitude;
    Scalar turned;  ///< the integral of r since the start, rad
  };

  /// At t = 0. theta keeps the turns of the start's, psi its side of pi/2, and phi stays within pi of the start's.
  explicit SpinAngle(const Problem<Scalar>& problem) noexcept
      : inertia_(problem.inertia),
        drive_(std::hypot(problem.torque[0] / inertia_[0], problem.torque[1] / inertia_[1])),
        axial_drive_(std::abs(problem.torque[2]) / inertia_[2]),
        power_(problem.torque.cwiseQuotient(inertia_.cwiseSqrt()).norm()),
        root_transverse_(std::sqrt(std::min(inertia_[0], inertia_[1]))),
        root_axial_(std::sqrt(inertia_[2])),
        skew_(std::abs(inertia_[0] - inertia_[1]) / (2 * inertia_[2])),
        split_slope_(std::abs((inertia_[2] - inertia_[1]) / inertia_[0] - (inertia_[2] - inertia_[0]) / inertia_[1]) /
                     2),
        split_(std::abs(problem.gyroscopic() * (1 / inertia_[0] - 1 / inertia_[1])) / 2) {
    const auto& a = problem.angles;
    attitude_ = quaternion_from_312(a.psi, a.phi, a.theta);
    half_turn_ = std::cos(a.psi) < 0 ? pi<Scalar> : Scalar(0);
    here_ = view({problem.angular_velocity, attitude_, 0});
    phi_ = a.phi;
    theta_ = near(here_.theta, a.theta);
    psi_turns_ = near(psi(), a.psi) - psi();
  }

  /// Goes on to t >= the last time, where the motion is `sample`. `at(t)`: the sample at a time in between.
  template <class At>
  void follow(Scalar t, const Sample& sample, const At& at) noexcept {
    const View target = view(sample);
    for (int trip = 0; trip < trip_cap && time_ < t; ++trip) {
      Scalar step = t - time_;
      View next = target;
      bool arrives = true;
      if (drift(here_, step / 2) > here_.room) {
        step = std::min(step / 2, Scalar(1.5L) * here_.room / here_.rate);
        while (drift(here_, step / 2) > here_.room && divisible(step)) step /= 2;
        next = view(at(time_ + step));
        arrives = false;
      }
      for (; drift(next, step / 2) > next.room && divisible(step) && ++trip < trip_cap; arrives = false) {
        step /= 2;
        next = view(at(time_ + step));
      }
      if (trip >= trip_cap) {
        next = target;
        arrives = true;
        least_cosine_ = 0;
      }
      for (const View& end : {here_, next})
        least_cosine_ = std::min(least_cosine_, std::max(Scalar(0), end.cosine - drift(end, step / 2)));
      theta_ = near(next.theta, theta_ + (next.turned - here_.turned));
      here_ = next;
      time_ = arrives ? t : time_ + step;
    }
    if (time_ < t) {  // cut into too many pieces: a turn may be missed
      theta_ = near(target.theta, theta_ + (target.turned - here_.turned));
      here_ = target;
      time_ = t;
      least_cosine_ = 0;
    }
    if (!(time_ == t)) theta_ = nan<Scalar>;
    attitude_ = sample.attitude;
  }

  /// At the last time.
  Angles<Scalar> angles() const noexcept {
    const Vec3<Scalar> reduced = angles_312(attitude_);
    return {psi() + psi_turns_, phi_ + std::remainder(reduced[1] + half_turn_ - phi_, 2 * pi<Scalar>),
            near(reduced[2] + half_turn_, theta_)};
  }
  /// A lower bound of cos(psi) so far.
  Scalar least_cosine() const noexcept { return least_cosine_; }

 private:
  static constexpr int trip_cap = 1000;

  struct View {
    Scalar theta, turned, cosine, transverse, axial, root_energy, half_tilt_sine;
    Scalar rate;  ///< bound of the rate of c e^{-iA}
    Scalar room;  ///< how far c e^{-iA} may move
  };

  View view(const Sample& sample) const noexcept {
    const Quat<Scalar>& q = sample.attitude;
    const Vec3<Scalar>& w = sample.angular_velocity;
    const Scalar a = 2 * (q.w * q.z - q.x * q.y), b = (q.w - q.z) * (q.w + q.z) + (q.y - q.x) * (q.y + q.x);
    View v{};
    v.theta = std::atan2(a, b) + half_turn_;
    v.turned = sample.turned;
    v.cosine = std::sqrt(a * a + b * b);
    v.transverse = std::sqrt(w[0] * w[0] + w[1] * w[1]);
    v.axial = std::abs(w[2]);
    v.root_energy = std::sqrt(w.dot(inertia_.cwiseProduct(w)));
    v.half_tilt_sine = std::sqrt(q.x * q.x + q.y * q.y);
    v.rate =
        v.transverse * std::min(Scalar(1), 2 * v.half_tilt_sine) + 2 * v.axial * v.half_tilt_sine * v.half_tilt_sine;
    // nearer to cos(psi) = 0 than rounding the side is not known anyway
    v.room = std::max(Scalar(0.9L) * v.cosine, 16 * epsilon<Scalar>);
    return v;
  }

  /// Of two triples for the same attitude, (psi, phi, theta) and (pi - psi, phi + pi, theta + pi), the one on the side of the start.
  Scalar psi() const noexcept {
    const Scalar reduced = angles_312(attitude_)[0];
    return half_turn_ > 0 ? half_turn_ - reduced : reduced;
  }

  /// theta plus the turns that bring it nearest to what is expected.
  static Scalar near(Scalar theta, Scalar expected) noexcept {
    return theta + 2 * pi<Scalar> * std::round((expected - theta) / (2 * pi<Scalar>));
  }

  bool divisible(Scalar step) const noexcept { return time_ + step / 2 > time_ && step < infinity<Scalar>; }

  /// Bound of how far c e^{-iA} moves in a time before or after a sample.
  Scalar drift(const View& v, Scalar step) const noexcept {
    const Scalar y = v.root_energy + power_ * step;
    const Scalar by_energy = y / root_transverse_;
    const Scalar r_by_energy = y / root_axial_;
    const Scalar r_by_rate = v.axial + (axial_drive_ + skew_ * by_energy * by_energy) * step;
    const Scalar r = std::min(r_by_energy, r_by_rate);
    const Scalar by_rate = (v.transverse + drive_ * step) * std::exp((split_slope_ * r + split_) * step);
    const Scalar rate = std::min(by_energy, by_rate);
    const Scalar s = std::min(Scalar(1), v.half_tilt_sine + rate * step / 2);
    return step * (rate * std::min(Scalar(1), 2 * s) + 2 * r * s * s);
  }

  Vec3<Scalar> inertia_;
  Scalar drive_, axial_drive_, power_, root_transverse_, root_axial_, skew_, split_slope_, split_;
  Scalar time_ = 0, phi_ = 0, theta_ = 0, psi_turns_ = 0;
  Scalar half_turn_ = 0;  ///< pi where the start lies beyond psi = pi/2
  Scalar least_cosine_ = 1;
  View here_{};
  Quat<Scalar> attitude_;
};

/// Whether an error of the attitude, rad, leaves a turn of theta or phi open at these states: cos(psi) came as near to zero on the way,
/// `least_cosine`, or phi to the end of its range, pi from the start's.
template <Real Scalar>
bool loses_turns(std::span<const State<Scalar>> states, Scalar start_phi, Scalar least_cosine,
                 Scalar attitude_error) noexcept {
  for (const State<Scalar>& s : states) {
    const Scalar cosine = std::abs(std::cos(s.angles.psi)), room = pi<Scalar> - std::abs(s.angles.phi - start_phi);
    if (!(attitude_error < room * cosine)) return true;
    least_cosine = std::min(least_cosine, cosine);
  }
  return !(attitude_error < Scalar(0.3L) * least_cosine);
}

}  // namespace gyrostat::spinning
