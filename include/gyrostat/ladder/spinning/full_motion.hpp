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
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
#include "gyrostat/ladder/spinning/neighbour.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/models/spinning/spin_angle.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a spinning, thrusting gyrostat by Taylor series.
namespace gyrostat::spinning {

template <Real Scalar>
using FullMotionOptions = MotionOptions<Scalar>;

template <Real Scalar>
struct FullMotionAnswer : MotionOutcome<std::size(column_kinds), Scalar> {
  Scalar least_cosine = 1;  ///< a lower bound of cos(psi) on the way
  /// false: phi or theta may be off by a turn, for cos(psi) = 0 is passed on a side that the error of the attitude does not decide
  bool turns_known = true;
  Scalar tilt_error = 0;  ///< of the direction of body axis 3 alone, rad
};

/// The full motion at the given times (s from the start, increasing, the first >= 0). What lies behind a failure is NaN.
///
/// theta is followed turn by turn (spin_angle.hpp); phi stays within pi of its start. The angles tell an attitude as good as that of
/// the quaternion; phi and theta by themselves are as good over cos(psi). Where the motion comes so near to cos(psi) = 0 that the error of
/// the attitude does not decide on which side it passes, or phi so near to the end of its range, turns_known is false.
///
/// The error is estimated by runs of neighbours: data and start differ by a few roundings, and the steps have a tighter tolerance
/// (companions.hpp). Their distance from the answer, watched in every step and kept for some twenty turns, is the error of the answer,
/// and shows what the motion makes of errors: that phases drift, and that all differences grow where it leaves an unstable rotation.
/// A run that misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: not_increasing (times), not_finite (problem or times), not_positive (inertia, mass), out_of_domain (a span of the wrong
/// length).
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {}) noexcept;

namespace detail {

/// One run. That of the answer follows the angles; companions leave them at zero, for their attitude says all. The steps are moved onto the laws that
/// the motion obeys exactly: without them a companion, for all its finer steps, may err as much as the answer, and as it does. One that runs alone does
/// without: they would take back its kick.
template <Real Scalar>
class Course {
 public:
  static constexpr bool goes_on_alike = true;

  Course(const Problem<Scalar>& problem, Scalar span, Scalar tolerance, std::uint64_t step_cap, bool follows,
         bool projected) noexcept
      : problem_(problem),
        system_(problem),
        solver_(system_, 0, system_.start(), options(system_, span, tolerance, step_cap, projected)),
        angle_(problem),
        follows_(follows) {}

  ode::Status step(Scalar t_max) noexcept {
    if (follows_) follow(solver_.time(), sample(solver_.state()));  // before the last step is forgotten
    return solver_.step(t_max);
  }
  Scalar time() const noexcept { return solver_.time(); }

  /// The state at t in the last step; no time before one that was asked for.
  State<Scalar> at(Scalar t) noexcept {
    alignas(32) Scalar x[System::width];
    if (t < time()) solver_.at(t, x);
    else std::copy(solver_.state(), solver_.state() + System::width, x);
    const auto seen = sample(x);
    if (follows_) follow(t, seen);
    return {seen.angular_velocity, follows_ ? angle_.angles() : Angles<Scalar>{},
            seen.attitude,         inertial_momentum<Scalar>(problem_, seen.angular_velocity, seen.attitude),
            system_.velocity(x),   system_.position(t, x)};
  }

  /// Moves the state by about `amount` of itself.
  void kick(Scalar amount) noexcept { solver_.kick(amount); }
  const ode::Counts& counts() const noexcept { return solver_.counts(); }
  /// A lower bound of cos(psi) on the way.
  Scalar least_cosine() const noexcept { return angle_.least_cosine(); }

 private:
  using System = FullSystem<Scalar>;
  using Solver = ode::Taylor<System>;
  using Sample = typename SpinAngle<Scalar>::Sample;

  static auto options(const System& system, Scalar span, Scalar tolerance, std::uint64_t step_cap,
                      bool projected) noexcept {
    typename Solver::Options options;
    options.tolerance = tolerance;
    options.scale = system.scale(span);
    options.step_cap = step_cap;
    options.projected = projected;
    return options;
  }
  Sample sample(const Scalar* x) const noexcept { return {system_.angular_velocity(x), system_.attitude(x), x[3]}; }
  void follow(Scalar t, const Sample& seen) noexcept {
    angle_.follow(t, seen, [this](Scalar between) noexcept {
      alignas(32) Scalar x[System::width];
      solver_.at(between, x, 8);
      return sample(x);
    });
  }

  const Problem<Scalar>& problem_;
  System system_;
  Solver solver_;
  SpinAngle<Scalar> angle_;
  bool follows_;
};

/// The columns as the runs are compared in them: of the 3-1-2 angles, which the attitude judges, in place of them the direction of body axis 3,
/// which does not know of the spin angle.
inline constexpr ColumnKind watched_kinds[] = {
    column_kinds[column::angular_velocity],
    {"axis_3", 3, "1", Frame::inertial, Measure::absolute, "body axis 3, inertial axes"},
    column_kinds[column::attitude],
    column_kinds[column::angular_momentum_inertial],
    column_kinds[column::velocity],
    column_kinds[column::position],
};

template <Real S>
struct WatchedRow {
  using Scalar = S;
  using State = spinning::State<S>;
  static constexpr const auto& columns = watched_kinds;

  ColumnErrors<S> scale{};

  void operator()(const State& state, S* row) const noexcept {
    Row<S>{}(state, row);
    const Vec3<S> axis = rotate<S>(state.attitude, Vec3<S>(0, 0, 1));
    std::copy_n(axis.data(), 3, row + columns[column::angular_velocity].width);
  }
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return Row<S>{}.turning(row);
  }
};

template <Real Scalar>
class FullMotion {
 public:
  FullMotion(const Problem<Scalar>& problem, std::span<const Scalar> times, std::span<State<Scalar>> states,
             const FullMotionOptions<Scalar>& options) noexcept
      : problem_(problem), times_(times), states_(states), options_(options), rate_(problem.rate_size(times.back())) {}

  /// The answer's run and its neighbours' side by side, and their distance.
  FullMotionAnswer<Scalar> run(Scalar step_tolerance, double progress_from, double progress_to) const noexcept {
    constexpr Scalar eps = epsilon<Scalar>;
    FullMotionAnswer<Scalar> answer;
    answer.step_tolerance = step_tolerance;
    const Scalar span = times_.back();
    Course<Scalar> course(problem_, span, step_tolerance, options_.step_cap, true, true);
    const Scalar tight = companion_step(step_tolerance);
    const Vec3<Scalar>&D = problem_.inertia, &w = problem_.angular_velocity;
    const Vec3<Scalar> stiff = D.cwiseProduct(w) + Vec3<Scalar>(0, 0, problem_.gyroscopic());
    const Condition<Scalar> condition{1, start_sensitivity<Scalar>(stiff, w, D.cwiseInverse().asDiagonal())};
    const Scalar change = data_change(step_tolerance, condition);
    const Problem<Scalar> one = neighbour(problem_, rate_, change, Aside::first),
                          two = neighbour(problem_, rate_, change, second_aside(condition));
    const bool both = rounding_rules(step_tolerance, condition);
    Course<Scalar> companion(one, span, tight, options_.step_cap, false, both);
    std::optional<Course<Scalar>> second;
    if (both) second.emplace(two, span, tight, options_.step_cap, false, true);
    const Runs<Course<Scalar>> runs{course, companion, second ? &*second : nullptr};
    const auto walk = walk_beside(WatchedRow<Scalar>{scales(problem_, span)}, runs,
                                  {start_state(problem_), times_, states_, nowhere(), progress_from, progress_to},
                                  options_, not_noted);
    answer.status = walk.status;
    answer.counts = runs.counts();
    const std::uint64_t steps = course.counts().steps;
    if (answer.status != ode::Status::reached) {
      answer.error = ColumnErrors<Scalar>::all(nan<Scalar>);
      return answer;
    }

    // What the runs share: rounding at the asked times.
    const Scalar rounding_walk = eps * std::sqrt(static_cast<Scalar>(steps));
    const Scalar shared = 4 * shared_rounding(rounding_walk);
    ColumnErrors<Scalar> rounding = shared * rounded_in(walk.asked.size());
    // and the force's direction, which the mean acceleration along the spin axis may be a small part of
    const Scalar gain = 2 * eps * (problem_.force.norm() / problem_.mass) * span;
    rounding[column::velocity] += gain;
    rounding[column::position] += gain * span / 2;
    ColumnErrors<Scalar> error = stated_error(walk.error, rounding, !both);
    answer.tilt_error = walk.error[column::euler_312] + shared;
    error[column::euler_312] = angles_error<Scalar>(error[column::attitude], states_);
    answer.least_cosine = course.least_cosine();
    answer.turns_known =
        !loses_turns<Scalar>(states_, problem_.angles.phi, answer.least_cosine, error[column::attitude]);
    answer.error = relative_to_truth(walk.asked.relative(error), column_kinds);
    answer.met = options_.excess(answer) <= 1;
    return answer;
  }

 private:
  /// The sizes of the numbers that a column is made of, some of which may cancel.
  ColumnErrors<Scalar> rounded_in(const ColumnErrors<Scalar>& size) const noexcept {
    const auto& p = problem_;
    const Scalar fastest = std::max(rate_, size[column::angular_velocity]);
    ColumnErrors<Scalar> parts = size;
    parts[column::attitude] = Scalar(honesty::composed_attitude);
    parts[column::angular_velocity] = fastest;
    parts[column::angular_momentum_inertial] = p.inertia.maxCoeff() * fastest + std::abs(p.rotor_momentum);
    parts[column::velocity] += p.velocity.norm();
    parts[column::position] += p.position.norm() + p.velocity.norm() * times_.back();
    return parts;
  }
  static State<Scalar> nowhere() noexcept {
    constexpr Scalar no = nan<Scalar>;
    const Vec3<Scalar> nothing = Vec3<Scalar>::Constant(no);
    return {nothing, {no, no, no}, {no, no, no, no}, nothing, nothing, nothing};
  }

  const Problem<Scalar>& problem_;
  std::span<const Scalar> times_;
  std::span<State<Scalar>> states_;
  const FullMotionOptions<Scalar>& options_;
  Scalar rate_;  ///< how fast the body turns, or is soon made to, rad/s
};

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(column_kinds)); wrong != Errc::ok) return wrong;
  const auto finite = [](const auto& v) noexcept { return (v - v).isZero(0); };
  const auto& a = problem.angles;
  if (!finite(problem.inertia) || !finite(problem.torque) || !finite(problem.force) ||
      !finite(problem.angular_velocity) || !finite(problem.velocity) || !finite(problem.position) ||
      !finite(Vec3<Scalar>(a.psi, a.phi, a.theta)) ||
      !finite(Vec3<Scalar>(problem.mass, problem.rotor_momentum, problem.charge_momentum)))
    return Errc::not_finite;
  if (!(problem.inertia.minCoeff() > 0) || !(problem.mass > 0)) return Errc::not_positive;

  FullMotionAnswer<Scalar> answer;
  answer.met = true;
  if (times.empty()) return answer;

  const detail::FullMotion<Scalar> motion(problem, times, states, options);
  const Scalar first = first_step_tolerance_of_spinner<Scalar>(options.tolerance, problem.phase(times.back()));
  return tightened<Scalar>(options, first, [&](Scalar tolerance, Scalar, double begin, double end) noexcept {
    return motion.run(tolerance, begin, end);
  });
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                                     std::span<State<double>>,
                                                                     const FullMotionOptions<double>&) noexcept;
#endif

}  // namespace gyrostat::spinning
