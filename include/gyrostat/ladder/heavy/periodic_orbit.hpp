// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/orbit_walk.hpp"
#include "gyrostat/ladder/heavy/shooting.hpp"
#include "gyrostat/models/heavy/attitude.hpp"
#include "gyrostat/models/heavy/multipliers.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

/// The periodic motion of a spinning heavy body without smallness of c/r0 (docs/heavy.md, section 4).
namespace gyrostat::heavy {

/// How a periodic motion was found.
enum class OrbitMethod : std::uint8_t {
  shooting,      ///< from a guess
  continuation,  ///< along a family
  collocation    ///< as a Fourier sum
};

/// A motion whose rates and down return after the period.
template <Real Scalar>
struct PeriodicOrbit {
  State<Scalar> start;       ///< with psi = 0
  Scalar period = 0;         ///< s
  Scalar closure = 0;        ///< greatest of |w(T) - w(0)|/rate_size and |down(T) - down(0)|
  Scalar trace_minus_4 = 0;  ///< of the monodromy: the sum of the two multipliers
  Multipliers<Scalar> multipliers;
  OrbitStability stability = OrbitStability::undecided;
  OrbitError<Scalar> error;  ///< of start, period, trace: estimates, several times too large
  OrbitMethod method = OrbitMethod::shooting;
  int shots = 0;       ///< runs with variational equations until it closed
  ode::Counts counts;  ///< of all runs
};

/// The periodic motion with spin r0 and the inclination acos(G0) of axis 3 to down, where down passes the plane of axes 1 and 3:
/// r = r0, down = (M3, 0, G0) at t = 0. One call is one to two dozen runs over a period; no heap.
///
/// It is the one that a fast spin tends to: where the first order is a good guess (r0 > 2.4 c) by shooting, else by following the family
/// from such a spin, past folds, to the first member with this spin.
///
/// Errors: those of Scaled; not_applicable (1 - a, 1 - b or a + b - 1 vanishes and what it divides does not); no_convergence (the family
/// does not reach this spin, or the motion is too unstable to close within 1e-9); step_limit (nor within the budget of the walk).
/// @param spin r0, rad/s, of either sign   @param cos_inclination G0, in (-1, 1)
template <Real Scalar>
Result<PeriodicOrbit<Scalar>> periodic_orbit(const Problem<Scalar>& problem, Scalar spin,
                                             Scalar cos_inclination) noexcept;

namespace detail {

/// What a closed motion is worth, as one of a space.
template <Real Scalar, OrbitSpace<Scalar> Space>
PeriodicOrbit<Scalar> judged(const Problem<Scalar>& problem, const Closed<Scalar>& closed, Scalar rate,
                             const Space& space, OrbitMethod method) noexcept {
  const Vec3<Scalar>& down = closed.start.down;
  PeriodicOrbit<Scalar> orbit;
  orbit.start = closed.start;
  orbit.start.attitude = attitude_from_angles<Scalar>(0, std::atan2(down[0], down[1]), down);
  orbit.period = closed.period;
  orbit.closure = closed.closure;
  orbit.trace_minus_4 = closed.shot.derivative.trace() - 4;
  orbit.method = method;
  orbit.shots = closed.shots;
  orbit.counts = closed.counts;
  orbit.error = orbit_error(problem, closed, rate, space, orbit.counts);
  orbit.multipliers = multipliers(orbit.trace_minus_4);
  orbit.stability = orbit_stability(orbit.trace_minus_4, orbit.error.trace);
  return orbit;
}

/// As the one at its spin.
template <Real Scalar>
PeriodicOrbit<Scalar> judged(const Problem<Scalar>& problem, const Closed<Scalar>& closed,
                             OrbitMethod method) noexcept {
  const Scalar rate = rate_size(problem, closed.start);
  return judged(problem, closed, rate, AtSpin<Scalar>{rate}, method);
}

/// Where the first order starts, with a nutation of p0, q0 (over the spin) beside it.
template <Real Scalar>
State<Scalar> first_start(const Scaled<Scalar>& s, const FirstOrder<Scalar>& first, Scalar p, Scalar q) noexcept {
  State<Scalar> start;
  start.angular_velocity = {s.spin * (first.X + first.chi * s.M3 + p), s.spin * (first.Y + q), s.spin};
  start.down = {s.M3, 0, s.G0};
  return start;
}

/// By shooting from the first order; refused where the answer is not the motion that was guessed.
template <Real Scalar>
Result<Closed<Scalar>> shot_orbit(const Problem<Scalar>& problem, const Scaled<Scalar>& s) noexcept {
  const FirstOrder<Scalar> first(s);
  const State<Scalar> guessed = first_start<Scalar>(s, first, 0, 0);
  const Scalar guess = 2 * pi<Scalar> / std::abs(s.spin * (1 + first.rate));
  if (!guessed.angular_velocity.allFinite() || !(guess < infinity<Scalar>)) return Errc::not_applicable;
  const Scalar rate = rate_size(problem, guessed);
  const AtSpin<Scalar> space{rate};
  constexpr Scalar most = Scalar(0.25L);
  const auto from = [&](const State<Scalar>& start) noexcept -> Result<Closed<Scalar>> {
    const auto closed = close_orbit(problem, start, guess, rate, space);
    if (!closed) return closed.error();
    const Scalar moved = (closed->start.angular_velocity - guessed.angular_velocity).norm() / std::abs(s.spin);
    if (!(moved < most) || !(std::abs(closed->period / guess - 1) < most)) return Errc::no_convergence;
    return closed;
  };
  const auto closed = from(guessed);
  const bool keeps_step = s.flatness < s.torque() && s.flatness < Scalar(1e-6L);
  if (!keeps_step || (!closed && closed.error() != Errc::no_convergence)) return closed;

  // Of a lamina across axis 3 the nutation keeps step with the spin. What forces it there, of the order eps^4, only its own amplitude
  // holds, by the change of its frequency: p/c is of the order eps^(1/3), and a small closure says little. The nearest is sought.
  const auto held = [&](const Result<Closed<Scalar>>& trial) noexcept {
    if (!trial || !(trial->closure < 512 * epsilon<Scalar>)) return false;
    ode::Counts counts;
    return orbit_error(problem, *trial, rate, space, counts).start < Scalar(1e-5L) + 256 * epsilon<Scalar>;
  };
  if (held(closed)) return closed;
  const Scalar size = std::pow(s.torque(), Scalar(2) / 3), across = std::sqrt(std::abs(s.B1 / s.A1));
  constexpr int phases = 8;
  Result<Closed<Scalar>> nearest = closed;
  Scalar least = infinity<Scalar>;
  for (Scalar wide = size / 4; wide < 5 * size; wide *= 2)
    for (int i = 0; i < phases; ++i) {
      const Scalar phase = 2 * pi<Scalar> * Scalar(i) / phases;
      const auto trial = from(first_start<Scalar>(s, first, wide * std::cos(phase), across * wide * std::sin(phase)));
      if (!trial) continue;
      const Scalar moved = (trial->start.angular_velocity - guessed.angular_velocity).norm();
      if (!(moved < least * Scalar(0.999L)) || !held(trial)) continue;
      least = moved;
      nearest = trial;
    }
  return nearest;
}

/// Of the order of the slow motions, rad/s; the spin where there is no torque.
template <Real Scalar>
Scalar slow_rate(const Problem<Scalar>& problem, Scalar spin) noexcept {
  const Scalar c = problem.pendulum_rate(), slow = std::max(c, std::sqrt(problem.gradient()));
  return slow > 0 ? slow : std::abs(spin);
}

/// How many times faster a spin must be, at least one, for the first order to be a good guess.
template <Real Scalar>
Scalar fast_over(const Scaled<Scalar>& s) noexcept {
  return s.torque() <= Scalar(0.18L) ? Scalar(1) : 3 * std::sqrt(s.torque());
}

/// The first member with this spin that a step of the walk passes, sought on the cubic with its ends' tangents: also inside of a fold.
/// Errors: not_applicable (none is passed); no_convergence (what is found is no member of this step).
template <Real Scalar>
Result<Closed<Scalar>> member_passed(const Problem<Scalar>& problem, const OrbitWalk<Scalar>& from,
                                     const OrbitWalk<Scalar>& to, Scalar unit, Scalar spin) noexcept {
  using Space = AlongFamily<Scalar>;
  using Point = typename Space::Point;
  const Point start = Space::point(from.member().start, from.member().period, unit);
  const Point step = Space::point(to.member().start, to.member().period, unit) - start;
  const Scalar length = step.norm();
  const auto on_cubic = [&](Scalar x) noexcept {
    const Scalar rest = 1 - x;
    return Point(start + x * x * (3 - 2 * x) * step + x * rest * length * (rest * from.tangent() - x * to.tangent()));
  };
  const auto beyond = [&](Scalar x) noexcept { return on_cubic(x)[2] * unit / spin <= 1; };
  constexpr int parts = 32;
  int first = 1;
  while (first <= parts && !beyond(Scalar(first) / parts)) ++first;
  if (first > parts) return Errc::not_applicable;
  Scalar low = Scalar(first - 1) / parts, high = Scalar(first) / parts;
  for (int i = 0; i < 24; ++i) (beyond((low + high) / 2) ? high : low) = (low + high) / 2;
  const Point guess = on_cubic(high);
  State<Scalar> trial = from.member().start;
  trial.angular_velocity = unit * guess.template head<3>();
  trial.angular_velocity[2] = spin;
  const Scalar rate = rate_size(problem, trial);
  const auto closed = close_orbit(problem, trial, guess[3] / unit, rate, AtSpin<Scalar>{rate});
  if (!closed) return closed.error();
  const Point found = Space::point(closed->start, closed->period, unit);
  if (!((found - guess).norm() < length / 4)) return Errc::no_convergence;
  return closed;
}

/// |trace - 4| beyond which rounding leaves no more than a few digits of the closure.
template <Real Scalar>
inline constexpr Scalar greatest_trace = Scalar(1e6L);

/// Steps that the walk along a family may take in all, less than a second; the longest walk that was seen to arrive took 33 thousand.
inline constexpr std::uint64_t walk_budget = 50'000;

template <Real Scalar>
struct FoundOrbit {
  Closed<Scalar> closed;
  OrbitMethod method = OrbitMethod::shooting;
  typename OrbitWalk<Scalar>::Point tangent = {0, 0, 0, 0};  ///< of the family, towards slower spins
};

/// By shooting, and where that fails along the family.
template <Real Scalar>
Result<FoundOrbit<Scalar>> closed_orbit(const Problem<Scalar>& problem, const Scaled<Scalar>& scaled) noexcept {
  const Scalar spin = scaled.spin;
  Scalar factor = fast_over(scaled);
  Result<Closed<Scalar>> closed = Errc::no_convergence;
  // a guess that is far off is improved by a faster spin, up to 64 times
  for (int trial = 0; trial < 4; ++trial, factor *= 4) {
    const auto faster = Scaled<Scalar>::make(problem, factor * spin, scaled.G0);
    if (!faster) return faster.error();
    closed = shot_orbit(problem, *faster);
    if (closed || closed.error() != Errc::no_convergence) break;
  }
  if (!closed) return closed.error();
  FoundOrbit<Scalar> found;
  found.closed = *closed;
  found.tangent[2] = spin < 0 ? Scalar(1) : Scalar(-1);
  if (factor == 1) return found;

  found.method = OrbitMethod::continuation;
  const Scalar unit = slow_rate(problem, spin);
  OrbitWalk<Scalar> walk(problem, *closed, unit, found.tangent);
  Scalar longest = Scalar(0.25L);
  for (int member = 0; member < 400; ++member) {
    const OrbitWalk<Scalar> before = walk;
    if (!walk.advance()) return Errc::no_convergence;
    if (walk.counts().steps > walk_budget) return Errc::step_limit;
    const Scalar now = walk.member().start.angular_velocity[2] / spin;
    const Scalar trace = walk.member().shot.derivative.trace();
    const auto at = member_passed(problem, before, walk, unit, spin);
    if (at) {
      found.closed = *at;
      found.closed.shots += closed->shots + walk.shots();
      found.closed.counts += closed->counts;
      found.closed.counts += walk.counts();
      found.tangent = walk.tangent();
      return found;
    }
    if (now <= 1) {
      walk = before;
      walk.limit(longest /= 4);
      continue;
    }
    if (!(now > 0) || !(std::abs(trace) < greatest_trace<Scalar>)) return Errc::no_convergence;
  }
  return Errc::no_convergence;
}

}  // namespace detail

template <Real Scalar>
Result<PeriodicOrbit<Scalar>> periodic_orbit(const Problem<Scalar>& problem, Scalar spin,
                                             Scalar cos_inclination) noexcept {
  const auto scaled = Scaled<Scalar>::make(problem, spin, cos_inclination);
  if (!scaled) return scaled.error();
  const auto found = detail::closed_orbit(problem, *scaled);
  if (!found) return found.error();
  return detail::judged(problem, found->closed, found->method);
}

#if defined(GYROSTAT_COMPILED)
extern template Result<PeriodicOrbit<double>> periodic_orbit<double>(const Problem<double>&, double, double) noexcept;
#endif

}  // namespace gyrostat::heavy
