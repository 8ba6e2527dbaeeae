// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/math/least_squares.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"

/// Periodic motions by shooting: what closes after one run of the full equations (docs/heavy.md, section 4). No heap.
namespace gyrostat::heavy {

/// A run of the full equations, and what a small change of its start makes of its end.
template <Real Scalar>
struct Shot {
  State<Scalar> end;  ///< without attitude
  Eigen::Matrix<Scalar, 6, 6> derivative =
      Eigen::Matrix<Scalar, 6, 6>::Zero();  ///< of (w, down) at the end by (w, down) at the start, SI
  ode::Status status = ode::Status::reached;
  ode::Counts counts;
};

template <Real Scalar>
Shot<Scalar> shoot(const Problem<Scalar>& problem, const State<Scalar>& start, Scalar time,
                   Scalar step_tolerance = epsilon<Scalar> / 8) noexcept {
  using System = VariationalSystem<Scalar>;
  const System system(problem, start);
  typename ode::Taylor<System>::Options options;
  options.tolerance = step_tolerance;
  options.scale = system.scale();
  options.step_cap = 20'000;
  ode::Taylor<System> solver(system, 0, system.start(), options);
  Shot<Scalar> shot;
  shot.status = solver.advance(time);
  shot.counts = solver.counts();
  shot.end = system.state(solver.state());
  shot.derivative = system.derivative(solver.state());
  return shot;
}

/// Which starts and periods are tried: `unknowns` numbers x, all zero at the present trial, and `conditions` beside the closure.
/// * `basis(start)`: the derivative of (w/rate, down, rate T) by x.
/// * `move(start, period, x)`: the trial at x.
/// * `condition(start, period)`: what should vanish, followed by its derivative by x.
template <class Space, class Scalar>
concept OrbitSpace = requires(const Space& space, State<Scalar>& start, Scalar& period,
                              const Eigen::Matrix<Scalar, Space::unknowns, 1>& x) {
  { Space::conditions } -> std::convertible_to<int>;
  { space.basis(start) } noexcept -> std::same_as<Eigen::Matrix<Scalar, 7, Space::unknowns>>;
  { space.move(start, period, x) } noexcept;
};

/// The closure that a periodic motion must have: for one that is not unstable it is a few roundings.
template <Real Scalar>
inline constexpr Scalar close_enough = Scalar(1e-9L) + 64 * epsilon<Scalar>;

/// A motion that returns to its start.
template <Real Scalar>
struct Closed {
  State<Scalar> start;
  Scalar period = 0;                  ///< s
  Scalar closure = infinity<Scalar>;  ///< greatest of |w(T) - w(0)|/rate and |down(T) - down(0)|
  Scalar left = infinity<Scalar>;     ///< closure, or a condition where that is larger
  Shot<Scalar> shot;
  int shots = 0;
  ode::Counts counts;
};

namespace detail {

template <Real Scalar, class Space>
class Shooting {
 public:
  static constexpr int unknowns = Space::unknowns, rows = 6 + Space::conditions;
  using Unknowns = Eigen::Matrix<Scalar, unknowns, 1>;
  using Rows = Eigen::Matrix<Scalar, rows, 1>;
  using Jacobian = Eigen::Matrix<Scalar, rows, unknowns>;

  Shooting(const Space& space, Scalar rate) noexcept : space_(space), rate_(rate) {}

  /// What does not vanish, and its derivative.
  void equations(const Problem<Scalar>& problem, const State<Scalar>& start, Scalar period, const Shot<Scalar>& shot,
                 Rows& residual, Jacobian& jacobian) const noexcept {
    const Vec3<Scalar> w = (shot.end.angular_velocity - start.angular_velocity) / rate_, d = shot.end.down - start.down;
    const Vec3<Scalar> w_rate =
        angular_acceleration<Scalar>(problem, shot.end.angular_velocity, shot.end.down) / (rate_ * rate_);
    const Vec3<Scalar> d_rate = fixed_vector_rate<Scalar>(shot.end.down, shot.end.angular_velocity) / rate_;
    const auto basis = space_.basis(start);
    for (int i = 0; i < 6; ++i) {
      residual[i] = i < 3 ? w[i] : d[i - 3];
      const Scalar later = i < 3 ? w_rate[i] : d_rate[i - 3];
      for (int j = 0; j < unknowns; ++j) {
        Scalar sum = later * basis(6, j);
        for (int k = 0; k < 6; ++k) {
          const Scalar units = (i < 3) == (k < 3) ? Scalar(1) : i < 3 ? 1 / rate_ : rate_;
          sum += (units * shot.derivative(i, k) - Scalar(i == k ? 1 : 0)) * basis(k, j);
        }
        jacobian(i, j) = sum;
      }
    }
    if constexpr (Space::conditions > 0) {
      const auto condition = space_.condition(start, period);
      for (int i = 6; i < rows; ++i) {
        residual[i] = condition(i - 6, 0);
        for (int j = 0; j < unknowns; ++j) jacobian(i, j) = condition(i - 6, j + 1);
      }
    }
  }

  /// The change that does away with the residual as far as can be, without the unknowns that have hardly an effect of their own.
  static Unknowns change(const Jacobian& jacobian, const Rows& residual,
                         Scalar threshold = 4 * epsilon<Scalar>) noexcept {
    std::array<std::array<Scalar, std::size_t(rows)>, std::size_t(unknowns)> columns;
    std::array<Scalar, std::size_t(rows)> right;
    for (int i = 0; i < rows; ++i) {
      right[std::size_t(i)] = -residual[i];
      for (int j = 0; j < unknowns; ++j) columns[std::size_t(j)][std::size_t(i)] = jacobian(i, j);
    }
    const auto x = math::least_squares(columns, right, threshold);
    Unknowns made;
    for (int j = 0; j < unknowns; ++j) made[j] = x[std::size_t(j)];
    return made;
  }

  static Scalar closure(const Rows& residual) noexcept {
    const Scalar w = std::hypot(residual[0], residual[1], residual[2]);
    const Scalar d = std::hypot(residual[3], residual[4], residual[5]);
    return w > d ? w : d + 0 * w;
  }

 private:
  const Space& space_;
  Scalar rate_;
};

}  // namespace detail

/// The nearest motion of the space that closes, by Gauss and Newton's iteration with variational equations. Ends where a further shot no
/// longer improves it. Errors: no_convergence (what is left exceeds `accept`), step_limit, step_underflow, not_finite.
/// @param rate of which w is measured, rad/s   @param accept greatest closure and condition   @param most shots
/// @param threshold of least_squares: unknowns without an effect of their own above it stay
/// @param spent to which the work is added, whether it closes or not
template <Real Scalar, OrbitSpace<Scalar> Space>
Result<Closed<Scalar>> close_orbit(const Problem<Scalar>& problem, const State<Scalar>& from, Scalar guess, Scalar rate,
                                   const Space& space, Scalar accept = close_enough<Scalar>, int most = 16,
                                   Scalar threshold = 4 * epsilon<Scalar>, ode::Counts* spent = nullptr) noexcept {
  using Method = detail::Shooting<Scalar, Space>;
  const Method method(space, rate);
  State<Scalar> start = from;
  Scalar period = guess;
  Closed<Scalar> best;
  int idle = 0;
  typename Method::Rows residual;
  typename Method::Jacobian jacobian;
  for (int trip = 0; trip < most; ++trip) {
    if (!(period > 0 && period < infinity<Scalar>) || !start.angular_velocity.allFinite()) break;
    const Shot<Scalar> shot = shoot(problem, start, period);
    best.counts += shot.counts;
    if (spent != nullptr) *spent += shot.counts;
    ++best.shots;
    if (shot.status != ode::Status::reached) {
      if (trip > 0) break;
      return shot.status == ode::Status::step_limit       ? Errc::step_limit
             : shot.status == ode::Status::step_underflow ? Errc::step_underflow
                                                          : Errc::not_finite;
    }
    method.equations(problem, start, period, shot, residual, jacobian);
    Scalar left = Method::closure(residual);
    for (int i = 6; i < Method::rows; ++i) left = std::abs(residual[i]) > left ? std::abs(residual[i]) : left;
    if (!(left < infinity<Scalar>)) break;
    const bool better = left < best.left / 2;
    if (left < best.left) {
      best.start = start;
      best.period = period;
      best.closure = Method::closure(residual);
      best.left = left;
      best.shot = shot;
    }
    idle = better ? 0 : idle + 1;
    if (left <= 4 * epsilon<Scalar> || (idle > 0 && best.left < accept) || idle > 6) break;
    typename Method::Unknowns x = Method::change(jacobian, residual, threshold);
    const auto basis = space.basis(start);
    Scalar size = 0, later = 0;
    for (int i = 0; i < 7; ++i) {
      Scalar sum = 0;
      for (int j = 0; j < Space::unknowns; ++j) sum += basis(i, j) * x[j];
      (i < 6 ? size : later) = std::max(i < 6 ? size : later, std::abs(sum) + 0 * sum);
    }
    later /= rate * period;
    const Scalar excess = std::max(size / Scalar(0.3L), later * 5);
    if (!(excess < infinity<Scalar>)) break;
    if (excess > 1) x /= excess;
    space.move(start, period, x);
  }
  if (!(best.left <= accept)) return Errc::no_convergence;
  return best;
}

/// Errors of a periodic motion.
template <Real Scalar>
struct OrbitError {
  Scalar start = 0;   ///< greatest of the changes of w/rate and down at the start
  Scalar period = 0;  ///< relative
  Scalar trace = 0;
};

/// What rounding and the steps make of a motion that closes, judged by two neighbours (honesty::orbit_change, orbit_margin, orbit_start_margin): bodies and
/// starts that differ by roundings, integrated with looser steps, closed by one correction. Two shots each. And at least what a closure of a few roundings
/// leaves open: where one direction is weakly held, two neighbours may both happen to lie near.
template <Real Scalar, OrbitSpace<Scalar> Space>
OrbitError<Scalar> orbit_error(const Problem<Scalar>& problem, const Closed<Scalar>& closed, Scalar rate,
                               const Space& space, ode::Counts& counts) noexcept {
  using Method = detail::Shooting<Scalar, Space>;
  constexpr Scalar eps = epsilon<Scalar>, looser = 8 * eps, change = Scalar(honesty::orbit_change) * eps,
                   margin = Scalar(honesty::orbit_margin);
  const Method method(space, rate);
  OrbitError<Scalar> error;
  typename Method::Rows residual;
  typename Method::Jacobian jacobian;
  const Scalar trace = closed.shot.derivative.trace();
  const auto moved = [&](const State<Scalar>& start) noexcept {
    return std::max((start.angular_velocity - closed.start.angular_velocity).norm() / rate,
                    (start.down - closed.start.down).norm());
  };
  for (const Aside aside : {Aside::first, Aside::second}) {
    const detail::Neighbour<Scalar> near(problem, closed.start, change, aside);
    State<Scalar> start = near.start;
    Scalar period = closed.period;
    Shot<Scalar> shot = shoot(near.problem, start, period, looser);
    counts += shot.counts;
    method.equations(near.problem, start, period, shot, residual, jacobian);
    const typename Method::Unknowns x = Method::change(jacobian, residual, Scalar(0));
    space.move(start, period, x);
    shot = shoot(near.problem, start, period, looser);
    counts += shot.counts;
    const Scalar failed = shot.status == ode::Status::reached ? Scalar(0) : nan<Scalar>;
    const auto take = [failed](Scalar& most, Scalar now) noexcept {
      most = now + failed > most ? now : most + 0 * (now + failed);
    };
    take(error.start, Scalar(honesty::orbit_start_margin) * moved(start));
    take(error.period, margin * std::abs(period / closed.period - 1));
    take(error.trace, margin * std::abs(shot.derivative.trace() - trace));
  }
  // a part that both neighbours happen to leave alone has the rounding of its parts nevertheless
  error.period += change;
  error.trace += change * (closed.shot.derivative.diagonal().cwiseAbs().sum());
  error.start += 8 * eps;
  method.equations(problem, closed.start, closed.period, closed.shot, residual, jacobian);
  Scalar open = 0, late = 0;
  for (int i = 0; i < Method::rows; ++i) {
    typename Method::Rows left = Method::Rows::Zero();
    left[i] = 32 * eps;
    State<Scalar> start = closed.start;
    Scalar period = closed.period;
    space.move(start, period, Method::change(jacobian, left, Scalar(0)));
    open += moved(start) * moved(start);
    late += (period / closed.period - 1) * (period / closed.period - 1);
  }
  open = std::sqrt(open);
  if (open > error.start) {
    error.trace *= open / error.start;
    error.start = open;
  }
  // the corrections are linear, and the period is off by the square of what the start is (both relative); 4: of three bodies next to spheres, whose start is
  // hardly held, one had its start off by five times the estimate, and the period by 2.6 times the square
  error.period = std::max(error.period, std::sqrt(late)) + 4 * error.start * error.start;
  return error;
}

}  // namespace gyrostat::heavy
