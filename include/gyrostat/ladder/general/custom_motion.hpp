// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/pace.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a body under a torque of the caller's own, which has no Taylor series: by DOP853, piece by piece between breakpoints.
namespace gyrostat::general {

/// What of a law ends a motion.
enum class LawFault : std::uint8_t {
  none,
  no_value,        ///< it gives NaN, or an infinite torque
  not_repeatable,  ///< asked twice with the same numbers, it gives two torques
};

/// How a motion under a torque of the caller's own came out, the estimated errors of its columns, and what of the law ended it.
template <Real Scalar>
struct CustomMotionAnswer : MotionOutcome<std::size(full_columns), Scalar> {
  LawFault fault = LawFault::none;
  Scalar fault_time = nan<Scalar>;  ///< s
  Scalar stop = nan<Scalar>;  ///< Status::event: when a brake has brought what it opposes to a stop, or all but, s
};

namespace detail {

/// The times in (0, span) at which a problem or a law changes, increasing.
template <Real Scalar>
std::vector<Scalar> breakpoints_with(const Problem<Scalar>& problem, std::span<const Scalar> named,
                                     Scalar span) noexcept {
  auto all = breakpoints(problem, span);
  for (const Scalar t : named)
    if (t > 0 && t < span) all.push_back(t);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The size of each number of a Flow, not zero: what steps measure errors against.
template <Real Scalar>
std::array<Scalar, Flow<Scalar>::width> number_sizes(const Prepared<Scalar>& of) noexcept {
  using std::abs;
  using At = Flow<Scalar>;
  const auto& sizes = of.sizes;
  const FullRow<Scalar> row(of);
  // of a body at rest that nothing pushes yet: what turns it by a radian
  const Scalar known = std::max(sizes.momenta, sizes.built / 64), M = known > 0 ? known : sizes.greatest / of.span;
  auto made = ode::uniform<Scalar, At::width>(1);
  std::fill_n(made.begin() + At::momentum, 3, M);
  for (std::size_t i = 0; i < of.wheels.count; ++i) {
    const auto& law = of.wheels.laws[i];
    if (law.turns_by_itself())
      made[At::wheel + i] = abs(law.momentum) + std::min(M, law.axial_inertia * M / sizes.least);
  }
  const auto path = [&](std::size_t place, Scalar size) noexcept {
    if (size > 0) std::fill_n(made.begin() + std::ptrdiff_t(place), 3, size);
  };
  path(At::velocity, row.foreseen[full_column::velocity]), path(At::position, row.foreseen[full_column::position]);
  return made;
}

/// The least |U| of the brakes that act just before t, by this state; infinite where none acts.
template <Real Scalar>
Scalar braked(const Problem<Scalar>& problem, const State<Scalar>& state, Scalar t) noexcept {
  Scalar least = infinity<Scalar>;
  for (const auto& torque : problem.torques) {
    if (torque.type != TorqueType::brake || factor_at(torque.factor, t, t) == 0) continue;
    const Vec3<Scalar> U = torque.opposed == Opposed::momentum ? state.angular_momentum
                                                               : Vec3<Scalar>(problem.inertia * state.angular_velocity);
    least = std::min(least, U.norm());
  }
  return least;
}

/// Watches a run by a method that does not go through the stop of a brake.
template <Real Scalar>
class BrakeWatch {
 public:
  /// Whether what a brake opposes has all but vanished; inside: a time in the piece that was integrated to this state.
  bool stopped(const Problem<Scalar>& problem, const State<Scalar>& state, Scalar inside) noexcept {
    const Scalar now = braked(problem, state, inside);
    if (!(now < infinity<Scalar>)) return false;
    greatest_ = std::max(greatest_, now);
    return !(now > nearly_ * greatest_);
  }

 private:
  static constexpr Scalar nearly_ = Scalar(1e-6L);
  Scalar greatest_ = 0;
};

/// One run over all pieces, as FullCourse is by Taylor series. law and of (whose wheels are those of another problem) must outlive it.
template <Real Scalar, TorqueLaw<Scalar> Law>
class CustomCourse {
  using Equations = DrivenFlow<Scalar, Law>;
  using Solver = ode::RungeKutta<Scalar, Equations::width, Equations>;
  using Control = ode::StepControl<Scalar, Equations::width>;

 public:
  /// law_share: what the law's torque is multiplied by; share: as of FullCourse; sizes: number_sizes().
  CustomCourse(const Problem<Scalar>& problem, const Law& law, const Vec3<Scalar>& law_share,
               const typename Equations::Numbers& sizes, Scalar span, std::vector<Scalar> cuts, Scalar share,
               Scalar tolerance, std::uint64_t step_cap) noexcept
      : problem_(problem),
        wheels_(Wheels<Scalar>::of(problem_)),
        cuts_(std::move(cuts)),
        last_(span),
        share_(share),
        step_cap_(step_cap),
        to_(end_of(0)),
        next_(problem_, wheels_, law, law_share),
        solver_(entered(next_, 0, to_), 0, next_.start(), control(sizes, tolerance, step_cap, share * span)) {}
  CustomCourse(const CustomCourse&) = delete;
  CustomCourse& operator=(const CustomCourse&) = delete;

  /// One step, at most up to t_max, and to the end of the piece.
  ode::Status step(Scalar t_max) noexcept {
    if (passes_) pass();
    ode::Status status = solver_.step(std::min(t_max, limit()));
    if (status == ode::Status::step_underflow && hops_ < most_hops_) status = hop(t_max);
    if (status != ode::Status::reached) return status;
    if (pace_.is_hopeless(counts().steps, time(), to_, step_cap_)) return ode::Status::step_limit;
    // a law that jumps with the state holds the motion at its jump in steps of which many are rejected: soon seen, as a law may cost much
    if (quick_.is_hopeless(counts().steps, time(), to_, step_cap_) && 4 * counts().rejected > counts().steps)
      return ode::Status::step_limit;
    const auto& equations = solver_.rhs();
    if (brakes_.stopped(problem_, equations.state(time(), solver_.state()), equations.inside()))
      return ode::Status::event;
    if (time() >= to_ && cut_ < cuts_.size()) {
      passes_ = true;
      next_.enter(to_, end_of(cut_ + 1));
    }
    return status;
  }

  Scalar time() const noexcept { return solver_.time(); }
  /// The state at t in the last step; where the piece ends with it, by the laws of the next.
  State<Scalar> at(Scalar t) noexcept { return (passes_ && t >= to_ ? next_ : solver_.rhs()).state(t, solver_.at(t)); }
  const ode::Counts& counts() const noexcept { return solver_.counts(); }
  /// When the law had no value and the motion could not go on; NaN otherwise.
  Scalar lost_at() const noexcept {
    const Scalar when = solver_.rhs().lost_at();
    return solver_.status() == ode::Status::not_finite && when >= time() ? when : nan<Scalar>;
  }

 private:
  /// How far the next step may go. A companion must not go in the steps of the answer, for then it would err alike: where not the tolerance
  /// but the end of the piece, or the growth from step to step, limits a step, its own is shorter.
  Scalar limit() noexcept {
    const Scalar t = time(), left = to_ - t, next = solver_.next_step();
    if (share_ == 1) return to_;
    const Scalar part = t + share_ * left;
    if (!(part > t)) return to_;
    if (!(t > from_)) return part;
    if (t + next >= to_ && !parted_) {
      parted_ = true;
      return part;
    }
    const bool grows = next > grown_ * (t - solver_.previous_time());
    return grows ? std::min(to_, t + share_ * next) : to_;
  }
  /// Steps some roundings of the time over an unnamed jump of the law, where no step is short enough for the tolerance.
  ode::Status hop(Scalar t_max) noexcept {
    ++hops_;
    const Scalar t = time(), to = std::min({t_max, to_, t + 32 * epsilon<Scalar> * t});
    auto y = solver_.state();
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += (to - t) * solver_.derivative()[i];
    solver_.restart(to, y);
    return solver_.status();
  }
  Scalar end_of(std::size_t cut) const noexcept { return cut < cuts_.size() ? cuts_[cut] : last_; }
  static Equations entered(Equations equations, Scalar from, Scalar to) noexcept {
    equations.enter(from, to);
    return equations;
  }
  /// span: that of the motion, or a share of it.
  static Control control(const typename Equations::Numbers& sizes, Scalar tolerance, std::uint64_t step_cap,
                         Scalar span) noexcept {
    Control made;
    made.relative = tolerance, made.step_cap = step_cap;
    if constexpr (!std::is_same_v<Law, NoTorque>) made.longest_step = span * Scalar(honesty::law_longest);
    for (std::size_t i = 0; i < sizes.size(); ++i) made.absolute[i] = tolerance * sizes[i];
    return made;
  }
  /// Goes on to the next piece.
  void pass() noexcept {
    from_ = to_, to_ = end_of(++cut_);
    solver_.rhs().enter(from_, to_);
    solver_.go_on();
    pace_.restart(time()), quick_.restart(time());
    passes_ = parted_ = false;
  }

  static constexpr Scalar grown_ = 5;
  static constexpr int most_hops_ = 1000;
  Problem<Scalar> problem_;
  Wheels<Scalar> wheels_;
  std::vector<Scalar> cuts_;
  Scalar last_, share_;
  std::uint64_t step_cap_;
  std::size_t cut_ = 0;
  int hops_ = 0;
  Scalar from_ = 0, to_;
  bool passes_ = false;
  bool parted_ = false;  ///< the way to the end of the piece
  Equations next_;       ///< of the next piece, where the last step ends this one
  Solver solver_;
  BrakeWatch<Scalar> brakes_;
  Pace<Scalar> pace_;
  Pace<Scalar, 4096> quick_;
};

/// The tightest step tolerance of an answer by DOP853: what its companions take is 64 times as tight, and no step can be held to less.
template <Real Scalar>
inline constexpr Scalar finest_dop853 = 8 * epsilon<Scalar>;

template <Real Scalar, TorqueLaw<Scalar> Law>
class CustomMotion {
 public:
  /// of: of the problem with the torque that the law gives at the start beside its own, for sizes.
  CustomMotion(const Problem<Scalar>& problem, const Prepared<Scalar>& of, const Law& law,
               std::span<const Scalar> named, std::span<const Scalar> times, std::span<State<Scalar>> states,
               const MotionOptions<Scalar>& options) noexcept
      : problem_(problem),
        of_(of),
        law_(law),
        times_(times),
        states_(states),
        options_(options),
        named_(named),
        sizes_(number_sizes(of)) {}

  /// The answer's run and its neighbours' side by side, and their distance.
  CustomMotionAnswer<Scalar> run(Scalar wanted, double progress_from, double progress_to) const noexcept {
    constexpr Scalar eps = epsilon<Scalar>;
    const Scalar tolerance = std::max(wanted, finest_dop853<Scalar>);
    CustomMotionAnswer<Scalar> answer;
    answer.step_tolerance = tolerance;
    const Scalar tight = companion_step(tolerance);
    const auto course = begin(problem_, {1, 1, 1}, 1, tolerance), companion = neighbour(Aside::first, 2, tight);
    std::unique_ptr<Course> second;
    // over a jump that is not named one companion may err as the answer does, by chance
    constexpr bool may_jump = !std::is_same_v<Law, NoTorque>;
    const Condition<Scalar> condition = condition_of(of_, course->at(0));
    if (may_jump || rounding_rules(tolerance, condition)) second = neighbour(second_aside(condition), 3, tight);
    const FullRow<Scalar> row(of_, !options_.wanted.empty());
    // a step over a jump that is not named may err by its tolerance and show nothing of it
    const Scalar unseen = may_jump && named_.empty() ? tolerance / 4 : Scalar(0);
    const auto rounding = [&](const FullErrors<Scalar>& size, Scalar steps) noexcept {
      return rounding_of_columns(of_, row, size, 4 * eps + steps + unseen);
    };
    solve_beside(answer, row, Runs<Course>{*course, *companion, second.get()},
                 {course->at(0), times_, states_, nowhere<Scalar>(), progress_from, progress_to}, options_, rounding);
    for (const Course* each : {course.get(), companion.get(), second.get()})
      if (each != nullptr && each->lost_at() == each->lost_at())
        answer.fault = LawFault::no_value, answer.fault_time = each->lost_at();
    if (answer.status == ode::Status::event) answer.stop = course->time();
    return answer;
  }

 private:
  using Course = CustomCourse<Scalar, Law>;

  std::unique_ptr<Course> begin(const Problem<Scalar>& problem, const Vec3<Scalar>& law_share, int share,
                                Scalar tolerance) const noexcept {
    return std::make_unique<Course>(problem, law_, law_share, sizes_, times_.back(),
                                    breakpoints_with(problem, named_, times_.back()), 1 / Scalar(share), tolerance,
                                    options_.step_cap);
  }
  std::unique_ptr<Course> neighbour(Aside aside, int share, Scalar tolerance) const noexcept {
    constexpr Scalar change = Scalar(honesty::side_by_side.data_change) * epsilon<Scalar>;
    const Vec3<Scalar> law_share = Vec3<Scalar>(1, 1, 1) + change * Shifts<Scalar>(aside).vector();
    return begin(beside(problem_, change, aside), law_share, share, tolerance);
  }

  const Problem<Scalar>& problem_;
  const Prepared<Scalar>& of_;
  const Law& law_;
  std::span<const Scalar> times_;
  std::span<State<Scalar>> states_;
  const MotionOptions<Scalar>& options_;
  std::span<const Scalar> named_;  ///< times at which the law jumps
  std::array<Scalar, Flow<Scalar>::width> sizes_;
};

/// A problem whose sizes count what a law gives at the start, N m.
template <Real Scalar>
Problem<Scalar> pushed_by(const Problem<Scalar>& problem, const Vec3<Scalar>& torque) noexcept {
  Problem<Scalar> made = problem;
  made.torques.emplace_back().vector = torque;
  return made;
}

/// The torque that a law gives at the start, asked twice, or what is wrong with it.
template <Real Scalar, TorqueLaw<Scalar> Law>
LawFault ask_at_start(const Problem<Scalar>& problem, const Law& law, Vec3<Scalar>& torque) noexcept {
  const auto wheels = Wheels<Scalar>::of(problem);
  const Flow<Scalar> flow(problem, wheels);
  const auto seen = seen_of(flow.state(0, flow.start()));
  torque = law(Scalar(0), seen);
  const Vec3<Scalar> again = law(Scalar(0), seen);
  if (!torque.allFinite() || !again.allFinite()) return LawFault::no_value;
  return torque == again ? LawFault::none : LawFault::not_repeatable;
}

}  // namespace detail

/// The full motion under the torques of a problem and a law beside them, at the given times (s, increasing, the first >= 0). What lies behind a
/// failure is NaN. named: the times at which the law or its derivatives jump, s, in any order; a step ends there, and the law is asked just
/// before it and, for what comes behind, at it. Between them the law is taken to be smooth: a jump that is not named costs steps, and is
/// told from the motion by the error estimate alone.
///
/// The error is estimated as by full_motion(): by runs of neighbours, whose data and whose law differ by a few roundings, in tighter steps. A
/// law that is not known to a few roundings has errors of its own, of which nothing here knows.
///
/// A law that gives NaN where no shorter step gets around it ends the motion with Status::not_finite, and the answer says when; one that gives two
/// torques for the same numbers at the start is not asked any further. Errors: those of full_motion(); not_finite (named).
template <Real Scalar, TorqueLaw<Scalar> Law>
Result<CustomMotionAnswer<Scalar>> custom_motion(const Problem<Scalar>& problem, const Law& law,
                                                 std::span<const Scalar> named, std::span<const Scalar> times,
                                                 std::span<State<Scalar>> states,
                                                 const MotionOptions<Scalar>& options = {}) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(full_columns)); wrong != Errc::ok) return wrong;
  if (!std::all_of(named.begin(), named.end(), [](Scalar t) { return std::isfinite(t); })) return Errc::not_finite;
  if (const Fault wrong = check(problem)) return wrong.code;
  CustomMotionAnswer<Scalar> answer;
  answer.met = true;
  if (times.empty()) return answer;

  Problem<Scalar> from = problem;
  from.attitude = as_unit(problem.attitude);
  Vec3<Scalar> at_start;
  answer.fault = detail::ask_at_start(from, law, at_start);
  if (answer.fault != LawFault::none) {
    answer.status = ode::Status::not_finite, answer.met = false, answer.fault_time = 0;
    answer.error = decltype(answer.error)::all(nan<Scalar>);
    std::fill(states.begin(), states.end(), detail::nowhere<Scalar>());
    return answer;
  }
  const auto sized = detail::pushed_by(from, at_start);
  const Prepared<Scalar> of(sized, times.back());
  if (!(of.sizes.turning < infinity<Scalar>)) return Errc::not_finite;
  if (!(of.sizes.forcing * times.back() <= Scalar(most_forcing))) return Errc::out_of_domain;
  const detail::CustomMotion<Scalar, Law> motion(from, of, law, named, times, states, options);
  const Scalar phase = of.sizes.turning * times.back();
  const Scalar first = first_step_tolerance<Scalar>(Scalar(honesty::dop853_share) * options.tolerance, phase,
                                                    Scalar(honesty::loosest_step));
  return tightened<Scalar>(options, first, [&](Scalar tolerance, Scalar, double begin, double end) noexcept {
    return motion.run(tolerance, begin, end);
  });
}

}  // namespace gyrostat::general
