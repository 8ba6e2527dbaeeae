// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/heavy/balance.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/quaternion.hpp"

/// The full motion of a heavy body by Taylor series.
namespace gyrostat::heavy {

template <Real Scalar>
struct FullMotionOptions : MotionOptions<Scalar> {
  bool attitude = false;  ///< follow the attitude too; its error is 0 where it is not followed
  bool converted =
      false;  ///< body and start come from conversions: zeros are rounding too, moments err as the greatest
};

template <Real Scalar>
using FullMotionAnswer = MotionOutcome<std::size(column_kinds), Scalar>;

/// The full motion from `start` at t = 0 at the given times (s, increasing, the first >= 0). What lies behind a failure is NaN; an
/// attitude that is not asked for is the identity.
///
/// The error is estimated by runs of neighbours: body and start differ by a few roundings, and the steps have a tighter tolerance
/// (companions.hpp). Their distance from the answer, watched in every step and kept for some twenty turns, is the error of the answer,
/// and shows what the motion makes of errors, chaos included.
/// A run that misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: not_increasing (times), not_finite (start, times or tolerance), zero_vector (down or attitude without length),
/// out_of_domain (the spans differ in length; an attitude whose down is not start.down within 1e-8).
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, const State<Scalar>& start,
                                             std::span<const Scalar> times, std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {}) noexcept;

namespace detail {

/// A problem and a start that differ from the given ones by about `amount`: by what rounding makes of data and
/// arithmetic. What is zero stays so where a symmetry keeps it, unless it comes from a conversion.
template <Real Scalar>
struct Neighbour {
  Problem<Scalar> problem;
  State<Scalar> start;
  Mat3<Scalar> turn =
      Mat3<Scalar>::Identity();  ///< the given axes to those of this body, which a conversion may find elsewhere

  /// leaving: what decides when the motion leaves an unstable balance next to which it begins
  Neighbour(const Problem<Scalar>& of, const State<Scalar>& from, Scalar amount, Aside aside, bool converted = false,
            const Departures<Scalar>& leaving = {}) noexcept
      : problem(of), start(from) {
    const Vec3<Scalar> v = amount * neighbour_direction<Scalar>(aside);
    const auto changed = [](const Vec3<Scalar>& x, Scalar a, Scalar b, Scalar c) noexcept {
      return Vec3<Scalar>(x[0] * (1 + a), x[1] * (1 + b), x[2] * (1 + c));
    };
    // not as down is moved: in a balance both would turn alike
    Vec3<Scalar> centre = changed(of.centre_of_mass(), -v[2], -v[0], -v[1]);
    Vec3<Scalar> inertia = changed(of.inertia(), v[0], v[1], v[2]);
    if (converted) {
      inertia = of.inertia() + of.inertia().maxCoeff() * v;
      turn = misaligned(of.inertia(), v);
      centre = turn * of.centre_of_mass() - of.centre_of_mass().norm() * Vec3<Scalar>(v[2], v[0], v[1]);
    }
    auto made =
        Problem<Scalar>::make(inertia, of.mass(), centre, of.gravity() * (1 + v[0]), of.gradient() * (1 + v[1]));
    // a body of the least extent that is real, of which not all moments can be changed
    if (!made)
      made = Problem<Scalar>::make(of.inertia() * (1 + v[0]), of.mass(), of.centre_of_mass(), of.gravity() * (1 + v[1]),
                                   of.gradient() * (1 + v[1]));
    if (made) problem = *made;
    // arithmetic errs by what the greatest component rounds to, in all of them but where a symmetry keeps the zeros
    const bool kept = !converted && keeps_zeros(of, from);
    const auto moved = [kept](const Vec3<Scalar>& x, const Vec3<Scalar>& by, Scalar size) noexcept {
      const auto one = [&](int k) noexcept { return x[k] == 0 && kept ? x[k] : x[k] + size * by[k]; };
      return Vec3<Scalar>(one(0), one(1), one(2));
    };
    const auto shift = [&](const Vec3<Scalar>& direction) noexcept {
      return leaving_shift<Scalar>(direction, 1, amount, aside, honesty::heavy_leaving_shift);
    };
    const Vec3<Scalar> of_rate = Vec3<Scalar>(v[1], v[2], v[0]) + shift(leaving.of_rate);
    const Vec3<Scalar> of_down = Vec3<Scalar>(v[2], v[0], v[1]) + shift(leaving.of_down);
    start.angular_velocity = moved(from.angular_velocity, of_rate, rate_size(of, from));
    start.down = moved(from.down, of_down, from.down.norm());
    start.down *= from.down.norm() / start.down.norm();
    // the attitude keeps its turn about the vertical but for what brings its down onto the new one
    const Vec3<Scalar> tilt = cross<Scalar>(start.down, from.down) / from.down.squaredNorm();
    start.attitude = normalised(from.attitude * Quat<Scalar>{1, tilt[0] / 2, tilt[1] / 2, tilt[2] / 2});
    if (converted) start = in_turned_axes(turn, start);
  }

  /// A state in other axes: v_new = R v for the body vectors.
  static State<Scalar> in_turned_axes(const Mat3<Scalar>& R, const State<Scalar>& s) noexcept {
    return {R * s.angular_velocity, R * s.down, s.attitude * conjugate(from_matrix(R))};
  }

 private:
  /// The turn of principal axes that the roundings v of a tensor make: about each axis by that of the greatest moment over the difference of
  /// the other two, half a radian at most.
  static Mat3<Scalar> misaligned(const Vec3<Scalar>& inertia, const Vec3<Scalar>& v) noexcept {
    Vec3<Scalar> by;
    for (int k = 0; k < 3; ++k) {
      const Scalar apart = std::abs(inertia[(k + 1) % 3] - inertia[(k + 2) % 3]), error = v[k] * inertia.maxCoeff();
      by[k] = error / std::max(apart, 2 * std::abs(error));
    }
    return to_matrix(normalised(Quat<Scalar>{1, by[0] / 2, by[1] / 2, by[2] / 2}));
  }
  /// Turning about one principal axis that stays vertical or horizontal, the weight in its line or across it.
  static bool keeps_zeros(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    const auto &w = start.angular_velocity, &d = start.down;
    const Vec3<Scalar> m = problem.moment();
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (w[i] != 0 || w[j] != 0) continue;
      if (d[k] == 0 && m[k] == 0) return true;
      if (d[i] == 0 && d[j] == 0 && m[i] == 0 && m[j] == 0) return true;
    }
    return false;
  }
};

template <Real Scalar, bool turning>
class FullMotion {
 public:
  FullMotion(const Problem<Scalar>& problem, const State<Scalar>& start, std::span<const Scalar> times,
             std::span<State<Scalar>> states, const FullMotionOptions<Scalar>& options) noexcept
      : problem_(problem),
        start_(start),
        times_(times),
        states_(states),
        options_(options),
        rate_(rate_size(problem, start)) {}

  /// The answer's run and its neighbours' side by side, and their distance.
  FullMotionAnswer<Scalar> run(Scalar step_tolerance, double progress_from, double progress_to) const noexcept {
    FullMotionAnswer<Scalar> answer;
    answer.step_tolerance = step_tolerance;
    Course course(problem_, start_, step_tolerance, options_.step_cap);
    const Scalar change = data_change(step_tolerance, condition());
    const auto leaving =
        is_next_to_steady() ? departures(problem_, start_.angular_velocity, start_.down) : Departures<Scalar>{};
    const auto beside = [&](Aside aside) noexcept {
      const Neighbour<Scalar> near(problem_, start_, change, aside, options_.converted, leaving);
      return Course(near.problem, near.start, companion_step(step_tolerance), options_.step_cap, near.turn);
    };
    Course companion = beside(Aside::first);
    std::optional<Course> second;
    if (rounding_rules(step_tolerance, condition())) second = beside(second_aside(condition()));
    // rounding at the asked times
    const auto rounding = [&](const ColumnErrors<Scalar>&, Scalar steps) noexcept {
      return 4 * shared_rounding(steps) * ColumnErrors<Scalar>{rate_, 1, Scalar(turning ? 1 : 0)};
    };
    solve_beside(answer, Row<Scalar>{scales(problem_, start_.angular_velocity.norm())},
                 Runs<Course>{course, companion, second ? &*second : nullptr},
                 {start_, times_, states_, nowhere(), progress_from, progress_to}, options_, rounding);
    return answer;
  }

  /// By how much the inverse of the tensor, or the start, magnifies rounding.
  Condition<Scalar> condition() const noexcept {
    const Vec3<Scalar>&I = problem_.inertia(), &w = start_.angular_velocity;
    Scalar of_start = start_sensitivity<Scalar>(I.cwiseProduct(w), w, I.cwiseInverse().asDiagonal());
    // stable or not, how far off it began may rule for long
    if (is_next_to_steady() || is_beside_separatrix(problem_, w, start_.down, Scalar(honesty::next_to_balance)))
      of_start = std::max(of_start, Scalar(honesty::unstable_condition));
    return {options_.converted ? I.maxCoeff() / I.minCoeff() : Scalar(1), of_start};
  }
  /// The angle turned through up to the last time, to its order, rad.
  Scalar phase() const noexcept { return rate_ * times_.back(); }

 private:
  bool is_next_to_steady() const noexcept {
    return is_steady(problem_, start_.angular_velocity, start_.down, Scalar(honesty::next_to_balance));
  }

  using System = FullSystem<Scalar, turning>;
  using Solver = ode::Taylor<System>;

  /// One run.
  class Course {
   public:
    static constexpr bool goes_on_alike = true;

    /// turn: the axes of the states that are given to those of the problem
    Course(const Problem<Scalar>& problem, const State<Scalar>& start, Scalar tolerance, std::uint64_t step_cap,
           const Mat3<Scalar>& turn = Mat3<Scalar>::Identity()) noexcept
        : system_(problem, start),
          solver_(system_, 0, system_.start(), options(system_, tolerance, step_cap)),
          turned_(turn != Mat3<Scalar>::Identity()),
          back_(turn.transpose()) {}

    ode::Status step(Scalar t_max) noexcept { return solver_.step(t_max); }
    Scalar time() const noexcept { return solver_.time(); }
    /// The state at t in the last step.
    State<Scalar> at(Scalar t) const noexcept {
      alignas(32) Scalar x[System::width];
      solver_.at(t, x);
      State<Scalar> state = system_.state(x);
      if (!turned_) return state;
      state = Neighbour<Scalar>::in_turned_axes(back_, state);
      if constexpr (!turning) state.attitude = {};
      return state;
    }
    /// Moves the state by about `amount` of itself.
    void kick(Scalar amount) noexcept { solver_.kick(amount); }
    const ode::Counts& counts() const noexcept { return solver_.counts(); }

   private:
    static auto options(const System& system, Scalar tolerance, std::uint64_t step_cap) noexcept {
      typename Solver::Options options;
      options.tolerance = tolerance;
      options.scale = system.scale();
      options.step_cap = step_cap;
      return options;
    }
    System system_;
    Solver solver_;
    bool turned_;
    Mat3<Scalar> back_;
  };

  static State<Scalar> nowhere() noexcept {
    constexpr Scalar no = nan<Scalar>;
    return {Vec3<Scalar>::Constant(no), Vec3<Scalar>::Constant(no), {no, no, no, no}};
  }

  const Problem<Scalar>& problem_;
  const State<Scalar>& start_;
  std::span<const Scalar> times_;
  std::span<State<Scalar>> states_;
  const FullMotionOptions<Scalar>& options_;
  Scalar rate_;
};

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, const State<Scalar>& start,
                                             std::span<const Scalar> times, std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(column_kinds)); wrong != Errc::ok) return wrong;
  if (!start.angular_velocity.allFinite() || !start.down.allFinite()) return Errc::not_finite;
  if (!(start.down.squaredNorm() > 0)) return Errc::zero_vector;
  State<Scalar> from = start;
  from.attitude = {};
  if (options.attitude) {
    const Scalar length = norm(start.attitude);
    if (!(length < infinity<Scalar>)) return Errc::not_finite;
    if (!(length > 0)) return Errc::zero_vector;
    from.attitude = as_unit(start.attitude);
    const Vec3<Scalar> seen = rotate<Scalar>(conjugate(from.attitude), Vec3<Scalar>(0, 0, -1));
    const Scalar slack = std::max(Scalar(1e-8L), 8 * epsilon<Scalar>);
    if (!((seen - start.down).norm() <= slack)) return Errc::out_of_domain;
  }
  if (times.empty()) {
    FullMotionAnswer<Scalar> answer;
    answer.met = true;
    return answer;
  }
  const auto solve = [&](const auto& motion) noexcept {
    const Scalar first = first_step_tolerance<Scalar>(options.tolerance, motion.phase(), Scalar(honesty::loosest_step));
    return tightened<Scalar>(options, first, [&](Scalar step_tolerance, Scalar, double begin, double end) noexcept {
      return motion.run(step_tolerance, begin, end);
    });
  };
  if (options.attitude) return solve(detail::FullMotion<Scalar, true>(problem, from, times, states, options));
  return solve(detail::FullMotion<Scalar, false>(problem, from, times, states, options));
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, const State<double>&,
                                                                     std::span<const double>, std::span<State<double>>,
                                                                     const FullMotionOptions<double>&) noexcept;
#endif

}  // namespace gyrostat::heavy
