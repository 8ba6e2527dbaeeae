// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"
#include "gyrostat/models/heavy/hanging.hpp"
#include "gyrostat/models/heavy/problem.hpp"

/// Swings of a hanging body: the two families of periodic motions about its rest without vertical momentum (docs/heavy.md, section 6).
/// Reversal of time takes (w, down) to (-w, down), so that each swings between two points of rest.
namespace gyrostat::heavy {

/// Unknown: T, and the direction from the hanging rest in which the body is let go.
template <Real Scalar>
struct LetGo {
  static constexpr int unknowns = 2, conditions = 0;
  Scalar rate;              ///< rad/s
  Vec3<Scalar> hang, u, v;  ///< down at rest and two tangents, orthonormal
  Scalar swing;             ///< rad, angle from the hanging rest

  State<Scalar> start(Scalar direction) const noexcept {
    State<Scalar> s;
    s.down = std::cos(swing) * hang + std::sin(swing) * (std::cos(direction) * u + std::sin(direction) * v);
    s.down /= s.down.norm();
    return s;
  }
  Scalar direction(const State<Scalar>& start) const noexcept {
    return std::atan2(start.down.dot(v), start.down.dot(u));
  }

  Eigen::Matrix<Scalar, 7, 2> basis(const State<Scalar>& start) const noexcept {
    const Scalar at = direction(start);
    Eigen::Matrix<Scalar, 7, 2> by = Eigen::Matrix<Scalar, 7, 2>::Zero();
    const Vec3<Scalar> across = std::cos(at) * v - std::sin(at) * u;  // unit: x[0] = sin(swing) times the direction
    for (int k = 0; k < 3; ++k) by(3 + k, 0) = across[k];
    by(6, 1) = 1;
    return by;
  }
  void move(State<Scalar>& from, Scalar& period, const Eigen::Matrix<Scalar, 2, 1>& x) const noexcept {
    const Scalar radius = std::hypot(from.down.dot(u), from.down.dot(v));
    from = start(direction(from) + x[0] / radius);
    period += x[1] / rate;
  }
};

/// The swings of one mode, let go at given angles from the hanging rest: start is at rest, energy is the potential one there. As many
/// orbits as angles, followed from small swings upward in steps of at most 0.1 rad. No heap.
///
/// Returns how many were found; behind the first that was not, orbits are left alone (the family turns back, or lies too near another).
/// Errors: not_applicable (all orientations alike, or the mode has no restoring torque); out_of_domain (mode not 0 or 1, an angle
/// outside (0, pi), spans of different lengths); not_increasing.
/// @param mode 0 for the lower frequency, 1 for the higher   @param angles rad, increasing
template <Real Scalar>
Result<std::size_t> swing_orbits(const Problem<Scalar>& problem, int mode, std::span<const Scalar> angles,
                                 std::span<PeriodicOrbit<Scalar>> orbits) noexcept {
  if ((mode != 0 && mode != 1) || angles.size() != orbits.size()) return Errc::out_of_domain;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] > 0) || !(angles[i] < pi<Scalar>)) return Errc::out_of_domain;
    if (i > 0 && !(angles[i] > angles[i - 1])) return Errc::not_increasing;
  }
  const auto rest = hanging(problem);
  if (!rest) return rest.error();
  const auto k = static_cast<std::size_t>(mode);
  const Scalar frequency = rest->frequency[k];
  if (!(frequency > 0)) return Errc::not_applicable;

  LetGo<Scalar> space{frequency, rest->down, rest->swing[k], cross<Scalar>(rest->down, rest->swing[k]), 0};
  constexpr Scalar longest = Scalar(0.1L), shortest = Scalar(1e-3L);
  // direction and period over the angle, by the last two swings; both are even in the angle, with the mode's at zero
  Scalar angle = 0, direction = 0, period = 2 * pi<Scalar> / frequency;
  Scalar turn_slope = 0, period_slope = 0, step = longest;
  for (std::size_t i = 0; i < angles.size();) {
    const bool lands = angle + step >= angles[i];
    const Scalar next = lands ? angles[i] : angle + step;
    space.swing = next;
    const Scalar ahead = next * next - angle * angle, guess = direction + turn_slope * ahead;
    const State<Scalar> start = space.start(guess);
    space.rate = std::max(rate_size(problem, start), frequency / 8);
    const auto closed =
        close_orbit(problem, start, period + period_slope * ahead, space.rate, space, close_enough<Scalar>, 10);
    const Scalar found = closed ? space.direction(closed->start) : Scalar(0);
    const bool near = closed && std::abs(std::remainder(found - guess, 2 * pi<Scalar>)) < Scalar(0.3L) &&
                      std::abs(closed->period / period - 1) < Scalar(0.2L);
    if (!near) {
      step = (next - angle) / 2;
      if (step < shortest) return i;
      continue;
    }
    turn_slope = std::remainder(found - direction, 2 * pi<Scalar>) / ahead;
    period_slope = (closed->period - period) / ahead;
    angle = next;
    direction = found;
    period = closed->period;
    step = std::min(longest, Scalar(1.5L) * step);
    if (lands) orbits[i++] = detail::judged(problem, *closed, space.rate, space, OrbitMethod::continuation);
  }
  return angles.size();
}

/// One swing. Errors: as above; no_convergence.
/// @param angle rad, in (0, pi)
template <Real Scalar>
Result<PeriodicOrbit<Scalar>> swing_orbit(const Problem<Scalar>& problem, int mode, Scalar angle) noexcept {
  PeriodicOrbit<Scalar> orbit;
  const auto found = swing_orbits<Scalar>(problem, mode, {&angle, 1}, {&orbit, 1});
  if (!found) return found.error();
  if (*found == 0) return Errc::no_convergence;
  return orbit;
}

}  // namespace gyrostat::heavy
