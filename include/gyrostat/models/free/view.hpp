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

/// What is seen in one turn about a pole, at the angle arc cos s from the direction, of an axis at the angle arc cos b from the pole.
template <Real Scalar>
struct SeenInTurn {
  Scalar s, limit;  ///< limit: cosine of half the angle of the cone

  View<Scalar> operator()(Scalar b) const noexcept {
    const Scalar A = b * s, B = std::sqrt(std::max(Scalar(0), (1 - b) * (1 + b) * (1 - s) * (1 + s)));
    const auto angle = [](Scalar above, Scalar below) noexcept {
      return below > 0    ? std::acos(std::clamp(above / below, Scalar(-1), Scalar(1)))
             : above <= 0 ? pi<Scalar>
                          : Scalar(0);
    };
    const Scalar lit = angle(-A, B);
    return {angle(limit - A, B) / pi<Scalar>, (A * lit + B * std::sin(lit)) / pi<Scalar>};
  }
  /// The b beyond which a turn touches the cone or leaves it, or the half space of the direction: where the above has roots for ends.
  std::array<Scalar, 4> edges() const noexcept {
    const Scalar c = std::sqrt(std::max(Scalar(0), (1 - s) * (1 + s)));
    const Scalar sine = std::sqrt(std::max(Scalar(0), (1 - limit) * (1 + limit)));
    return {s * limit - c * sine, s * limit + c * sine, -c, c};
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
/// @param axis unit, body axes; @param direction unit, inertial axes; @param half_angle in [0, pi], rad
template <Real Scalar>
View<Scalar> long_run_view(const Motion<Scalar>& motion, const Vec3<Scalar>& axis, const Vec3<Scalar>& direction,
                           Scalar half_angle) noexcept {
  if (motion.kind() == Kind::separatrix) return {nan<Scalar>, nan<Scalar>, nan<Scalar>};
  const bool steady = motion.kind() == Kind::steady;
  const auto start = motion.at(Scalar(0));
  // the axis about which all goes round: M, or omega where that is steady
  const Vec3<Scalar> pole =
      steady ? rotate<Scalar>(start.attitude, start.angular_velocity) : motion.inertial_momentum();
  const Scalar length = pole.norm();
  const Scalar s = length > 0 ? direction.dot(pole) / length : direction.dot(rotate<Scalar>(start.attitude, axis));
  const detail::SeenInTurn<Scalar> turn{std::clamp(s, Scalar(-1), Scalar(1)), std::cos(half_angle)};
  if (steady)
    return length > 0 ? turn(axis.dot(start.angular_velocity) / length)
                      : View<Scalar>{Scalar(s >= turn.limit), std::max(s, Scalar(0))};
  const Scalar T = motion.period();
  const auto along = [&](Scalar t) noexcept { return axis.dot(motion.at(t).angular_momentum) / length; };
  std::vector<Scalar> cuts{Scalar(0), T};
  for (const Scalar edge : turn.edges())
    for (const Scalar t : periodic_zeros(motion, [&](Scalar x) noexcept { return along(x) - edge; }, Scalar(0), T))
      cuts.push_back(t);
  // beside a separatrix all happens in a small share of the period
  const int pieces = nodes_of(motion) / 16;
  for (int i = 1; i < pieces; ++i) cuts.push_back(T * Scalar(i) / Scalar(pieces));
  std::sort(cuts.begin(), cuts.end());
  View<Scalar> view;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    detail::add_view(view, [&](Scalar x) noexcept { return turn(along(x * T)); }, cuts[i] / T, cuts[i + 1] / T);
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
