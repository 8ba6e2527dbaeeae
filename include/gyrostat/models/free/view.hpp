// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/periodic.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/motion.hpp"

/// How long an axis of the body sees a direction of space (the sun, a station).
namespace gyrostat::free {

template <Real Scalar>
struct View {
  Scalar fraction = 0;     ///< of the time with an angle between the two of half_angle or less
  Scalar mean_cosine = 0;  ///< of max(0, cos of the angle): what a flat panel across the axis receives
};

/// In the long run, of a motion whose turn in a period is no fraction of a whole turn with a small denominator (resonance()): the phases
/// then fill a torus evenly, and the azimuth about M integrates in closed form. To 1e-6 (the fraction), 1e-9 (the mean). In a steady
/// rotation over a turn; on a separatrix NaN.
/// @param axis unit, body axes; @param direction unit, inertial axes; @param half_angle in [0, pi], rad
template <Real Scalar>
View<Scalar> long_run_view(const Motion<Scalar>& motion, const Vec3<Scalar>& axis, const Vec3<Scalar>& direction,
                           Scalar half_angle) noexcept {
  using std::acos, std::cos, std::sin, std::sqrt;
  if (motion.kind() == Kind::separatrix) return {nan<Scalar>, nan<Scalar>};
  const bool steady = motion.kind() == Kind::steady;
  const auto start = motion.at(Scalar(0));
  // the axis about which all goes round: M, or omega where that is steady
  const Vec3<Scalar> pole =
      steady ? rotate<Scalar>(start.attitude, start.angular_velocity) : motion.inertial_momentum();
  const Scalar length = pole.norm();
  const Scalar s = length > 0 ? direction.dot(pole) / length : direction.dot(rotate<Scalar>(start.attitude, axis));
  const Scalar limit = cos(half_angle);
  const auto at = [&](Scalar b) -> std::array<Scalar, 2> {
    const Scalar A = b * s, B = sqrt(std::max(Scalar(0), (1 - b) * (1 + b) * (1 - s) * (1 + s)));
    const auto angle = [](Scalar above, Scalar below) {
      return below > 0 ? acos(std::clamp(above / below, Scalar(-1), Scalar(1))) : above <= 0 ? pi<Scalar> : Scalar(0);
    };
    const Scalar lit = angle(-A, B);
    return {angle(limit - A, B) / pi<Scalar>, (A * lit + B * sin(lit)) / pi<Scalar>};
  };
  if (steady) {
    const auto v = length > 0 ? at(axis.dot(start.angular_velocity) / length)
                              : std::array<Scalar, 2>{Scalar(s >= limit), std::max(s, Scalar(0))};
    return {v[0], v[1]};
  }
  constexpr int nodes = 16384;
  View<Scalar> view;
  for (int i = 0; i < nodes; ++i) {
    const auto v =
        at(axis.dot(motion.at(motion.period() * (Scalar(i) + Scalar(0.5)) / nodes).angular_momentum) / length);
    view.fraction += v[0] / nodes;
    view.mean_cosine += v[1] / nodes;
  }
  return view;
}

/// The fraction over [begin, end], by the times at which the axis enters and leaves the cone; about 1/turns from that of the long run.
template <Real Scalar>
Scalar view_fraction(const Motion<Scalar>& motion, const Vec3<Scalar>& axis, const Vec3<Scalar>& direction,
                     Scalar half_angle, Scalar begin, Scalar end) noexcept {
  using std::abs, std::ceil, std::cos, std::min;
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
    if ((last < 0) == (next < 0)) {
      if (next >= 0) seen += high - low;
    } else if (const auto root = math::bracketed_root<Scalar>(above, low, high)) {
      seen += next >= 0 ? high - *root : *root - low;
    }
    low = high;
    last = next;
  }
  return seen / (end - begin);
}

}  // namespace gyrostat::free
