// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/quadrature.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/motion.hpp"

/// How long an axis of the body sees a direction of space (the sun, a station).
namespace gyrostat::free {

/// What an axis of the body sees of a direction, as fractions of the time.
template <Real Scalar>
struct View {
  Scalar fraction = 0;     ///< of the time with an angle between the two of half_angle or less
  Scalar mean_cosine = 0;  ///< of max(0, cos of the angle): what a flat panel across the axis receives
  Scalar error = 0;        ///< estimate of what the quadrature leaves, of both
};

namespace detail {

/// Between two vectors, rad, to some roundings also where it is small or nearly pi.
template <Real Scalar>
Scalar angle_between(const Vec3<Scalar>& a, const Vec3<Scalar>& b) noexcept {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// What is seen in one turn about a pole, at the angle delta from the direction, of an axis at the angle theta from the pole, rad.
template <Real Scalar>
struct SeenInTurn {
  Scalar delta, half_angle;  ///< half_angle: of the cone, rad; below 0 it holds nothing

  View<Scalar> operator()(Scalar theta) const noexcept {
    const Scalar lit = azimuth(theta, pi<Scalar> / 2);
    const Scalar mean = std::cos(theta) * std::cos(delta) * lit + std::sin(theta) * std::sin(delta) * std::sin(lit);
    return {azimuth(theta, half_angle) / pi<Scalar>, mean / pi<Scalar>};
  }
  /// The theta at which a turn touches the cone, or the half space of the direction: beyond, the above has roots for ends.
  std::array<Scalar, 4> edges() const noexcept {
    const auto folded = [](Scalar angle) noexcept {
      return angle > pi<Scalar> ? 2 * pi<Scalar> - angle : std::abs(angle);
    };
    const Scalar right = pi<Scalar> / 2;
    return {folded(delta - half_angle), folded(delta + half_angle), folded(delta - right), folded(delta + right)};
  }

 private:
  /// phi of cos within = cos theta cos delta + sin theta sin delta cos phi, rad, 0 and pi beyond: by half angles, which keep their digits beside
  /// the poles.
  Scalar azimuth(Scalar theta, Scalar within) const noexcept {
    if (within < 0) return 0;
    const Scalar apart = theta - delta, sum = theta + delta;
    const Scalar inside =
        std::sin((within + apart) / 2) * std::sin((within - apart) / 2);  // sin theta sin delta sin^2(phi/2)
    const Scalar outside = std::sin((sum + within) / 2) * std::sin((sum - within) / 2);  // and the same of cos^2
    if (!(outside > 0)) return inside >= 0 ? pi<Scalar> : Scalar(0);
    return inside > 0 ? 2 * std::atan(std::sqrt(inside / outside)) : Scalar(0);
  }
};

/// Adds the integral of what is seen over [from, to] of a period, a root of the time at either end taken in.
template <Real Scalar, class Seen>
void add_view(View<Scalar>& sum, const Seen& seen, Scalar from, Scalar to) noexcept {
  constexpr Scalar wanted = Scalar(1e-11L);
  constexpr int deepest = 12;
  const Scalar width = to - from;
  const auto take = [&](Scalar middle, Scalar half, bool halvable) noexcept -> Result<bool> {
    View<Scalar> part;
    Scalar gauss = 0, gauss_cosine = 0;
    for (const auto& point : math::kronrod_points<Scalar>) {
      const Scalar u = middle + half * point.node, x = from + width * (u * u * (3 - 2 * u));
      const auto at = seen(x);
      const Scalar stretch = half * width * (6 * u * (1 - u));
      part.fraction += point.weight * stretch * at.fraction;
      part.mean_cosine += point.weight * stretch * at.mean_cosine;
      gauss += point.gauss_weight * stretch * at.fraction;
      gauss_cosine += point.gauss_weight * stretch * at.mean_cosine;
    }
    part.error = std::max(std::abs(part.fraction - gauss), std::abs(part.mean_cosine - gauss_cosine));
    if (halvable && part.error > wanted * half) return false;
    sum.fraction += part.fraction;
    sum.mean_cosine += part.mean_cosine;
    sum.error += part.error;
    return true;
  };
  (void)math::halved_panels(Scalar(0), Scalar(1), 1, deepest, take);
}

}  // namespace detail

/// In the long run, of a motion whose turn in a period is no fraction of a whole turn with a small denominator (resonance()): the phases
/// then fill a torus evenly, and the azimuth about M integrates in closed form; over the other phase by Kronrod's rule between the times at
/// which the axis comes to see the direction all the way round, or not at all. In a steady rotation over a turn; on a separatrix NaN.
/// @param axis unit, body axes; @param direction unit, inertial axes; @param half_angle up to pi, rad; below 0 nothing is seen
template <Real Scalar>
View<Scalar> long_run_view(const Motion<Scalar>& motion, const Vec3<Scalar>& axis, const Vec3<Scalar>& direction,
                           Scalar half_angle) noexcept {
  if (motion.kind() == Kind::separatrix) return {nan<Scalar>, nan<Scalar>, nan<Scalar>};
  const bool steady = motion.kind() == Kind::steady;
  const auto start = motion.at(Scalar(0));
  // the axis about which all goes round: M, or omega where that is steady
  const Vec3<Scalar> pole =
      steady ? rotate<Scalar>(start.attitude, start.angular_velocity) : motion.inertial_momentum();
  if (!(pole.norm() > 0)) {
    const Vec3<Scalar> there = rotate<Scalar>(start.attitude, axis);
    const Scalar seen = detail::angle_between<Scalar>(direction, there) <= half_angle ? Scalar(1) : Scalar(0);
    return {seen, std::max(direction.dot(there), Scalar(0))};
  }
  const detail::SeenInTurn<Scalar> turn{detail::angle_between<Scalar>(direction, pole), half_angle};
  if (steady) return turn(detail::angle_between<Scalar>(axis, start.angular_velocity));

  // between its extremes the angle from M goes through each edge once
  const Scalar T = motion.period();
  const auto theta = [&](Scalar t) noexcept {
    return detail::angle_between<Scalar>(axis, motion.at(t).angular_momentum);
  };
  const auto turning = [&](Scalar t) noexcept {
    const auto state = motion.at(t);
    return axis.dot(state.angular_momentum.cross(state.angular_velocity));
  };
  std::vector<Scalar> extremes = periodic_zeros(motion, turning, Scalar(0), T);
  extremes.insert(extremes.begin(), Scalar(0));
  extremes.push_back(T);
  std::vector<Scalar> cuts = extremes;
  for (const Scalar edge : turn.edges())
    for (std::size_t i = 0; i + 1 < extremes.size(); ++i) {
      const auto off = [&](Scalar t) noexcept { return theta(t) - edge; };
      if ((off(extremes[i]) < 0) == (off(extremes[i + 1]) < 0)) continue;
      if (const auto root = math::bracketed_root<Scalar>(off, extremes[i], extremes[i + 1])) cuts.push_back(*root);
    }
  // beside a separatrix all happens in a small share of the period
  const int pieces = nodes_of(motion) / 16;
  for (int i = 1; i < pieces; ++i) cuts.push_back(T * Scalar(i) / Scalar(pieces));
  std::sort(cuts.begin(), cuts.end());
  View<Scalar> view;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    detail::add_view(view, [&](Scalar x) noexcept { return turn(theta(x * T)); }, cuts[i] / T, cuts[i + 1] / T);
  return view;
}

namespace detail {

/// How long a function is positive between two times, by its values there and a bound `fast` of its slope: pieces in which it might
/// cross zero and come back are halved.
template <Real Scalar, class Function>
Scalar time_above(const Function& above, Scalar low, Scalar at_low, Scalar high, Scalar at_high, Scalar fast,
                  int halvings) noexcept {
  if ((at_low < 0) != (at_high < 0)) {
    const auto root = math::bracketed_root<Scalar>(above, low, high);
    return !root ? Scalar(0) : at_high >= 0 ? high - *root : *root - low;
  }
  const Scalar all = at_low < 0 ? Scalar(0) : high - low;
  if (halvings == 0 || std::abs(at_low) + std::abs(at_high) >= fast * (high - low)) return all;
  const Scalar middle = low + (high - low) / 2, at_middle = above(middle);
  return time_above(above, low, at_low, middle, at_middle, fast, halvings - 1) +
         time_above(above, middle, at_middle, high, at_high, fast, halvings - 1);
}

}  // namespace detail

/// The fraction over [begin, end], by the times at which the axis enters and leaves the cone; about 1/turns from that of the long run.
template <Real Scalar>
Scalar view_fraction(const Motion<Scalar>& motion, const Vec3<Scalar>& axis, const Vec3<Scalar>& direction,
                     Scalar half_angle, Scalar begin, Scalar end) noexcept {
  using std::ceil, std::cos, std::min;
  constexpr int halvings = 20;  // of a fifth of a radian: what is in view for less than 2e-7 rad may be missed
  const Scalar limit = cos(half_angle);
  const auto above = [&](Scalar t) { return direction.dot(rotate<Scalar>(motion.at(t).attitude, axis)) - limit; };
  const auto s = motion.at(begin);
  const Scalar period = motion.period() < infinity<Scalar> ? motion.period() : infinity<Scalar>;
  const Scalar fastest = s.angular_velocity.norm() + motion.angular_momentum_norm() / motion.principal_moments()[2];
  const Scalar step = min(period / Scalar(nodes_of(motion)), Scalar(0.2) / fastest);
  const Scalar count = ceil((end - begin) / step);
  if (!(count >= 1 && count < Scalar(1e8))) return nan<Scalar>;
  Scalar seen = 0, low = begin, last = above(begin);
  for (Scalar i = 1; i <= count; i += 1) {
    const Scalar high = begin + (end - begin) * (i / count), next = above(high);
    seen += detail::time_above(above, low, last, high, next, fastest, halvings);
    low = high;
    last = next;
  }
  return seen / (end - begin);
}

}  // namespace gyrostat::free
