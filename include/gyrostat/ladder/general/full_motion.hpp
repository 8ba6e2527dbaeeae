// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/general/full_course.hpp"
#include "gyrostat/ladder/general/neighbour.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/general/balances.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/rest.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a body with any wheels under any torques, by Taylor series, or by collocation where wheels settle fast, and its error.
namespace gyrostat::general {

/// Places in full_columns.
namespace full_column {
enum : std::size_t {
  attitude,
  angular_velocity,
  angular_momentum,
  rotor_rate,
  rotor_angle,
  velocity,
  position,
  impulse,
  gain,
  work
};
}

/// What the full equations are compared by.
inline constexpr ColumnKind full_columns[] = {
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity, body axes",
     "what the momenta of body and wheels at t = 0, or else what the torques build up, would turn the whole with"},
    {"angular_momentum", 3, "N m s", Frame::body, Measure::relative, "total angular momentum, body axes",
     "the momenta of body and wheels at t = 0, which may cancel, or else what the torques build up"},
    {"rotor_rate", int(most_wheels), "rad/s", Frame::none, Measure::relative, "rates of the wheels in the body",
     "a thousandth of the greatest rate of body and wheels at t = 0"},
    {"rotor_angle", int(most_wheels), "rad", Frame::none, Measure::relative, "angles of the wheels in the body",
     "0.001 rad"},
    {"velocity", 3, "m/s", Frame::inertial, Measure::relative, "velocity of the mass centre, inertial axes",
     "the velocity at t = 0, and what the force adds while the body turns by a radian"},
    {"position", 3, "m", Frame::inertial, Measure::relative, "position of the mass centre, inertial axes",
     "the position at t = 0, the way at the velocity of t = 0, and what the force adds while the body turns by a "
     "radian"},
    {"impulse", 3, "N m s", Frame::inertial, Measure::relative, "impulse of the external torques, inertial axes",
     "that of angular_momentum"},
    {"gain", 1, "N m s", Frame::none, Measure::relative, "by how much the total angular momentum has grown",
     "that of angular_momentum"},
    {"work", 1, "J", Frame::none, Measure::relative, "work of all torques, those of motors and bearings among them",
     "what the momentum of that scale would have about the axis of least moment"},
};

template <Real Scalar>
using FullErrors = Errors<std::size(full_columns), Scalar>;

/// Writes full_columns of a state, one behind the other.
template <Real S>
struct FullRow {
  using Scalar = S;
  using State = general::State<S>;
  static constexpr const auto& columns = full_columns;

  FullErrors<S> scale{};
  FullErrors<S> foreseen{};  ///< how large a column may become

  /// The scales that a problem sets for the times up to its span. asked: of columns that a scene is asked for, which may be small beside what is
  /// foreseen; a thousandth of it is their scale.
  explicit FullRow(const Prepared<S>& of, bool asked = false) noexcept {
    using std::abs;
    const auto& sizes = of.sizes;
    S rate = of.problem.angular_velocity.norm();
    for (std::size_t i = 0; i < of.wheels.count; ++i) rate = std::max(rate, abs(of.wheels.laws[i].rate));
    const S M = sizes.momentum();
    if (rate == 0) rate = M / sizes.greatest;
    scale[full_column::angular_velocity] = M / sizes.greatest;
    scale[full_column::angular_momentum] = M;
    scale[full_column::rotor_rate] = share * rate;
    scale[full_column::rotor_angle] = share;
    const S time = sizes.turning > 0 ? std::min(of.span, 1 / sizes.turning) : of.span;
    const S gain = (sizes.force / of.problem.mass + abs(of.problem.field.gravity)) * time,
            v = of.problem.velocity.norm();
    scale[full_column::velocity] = v + gain;
    scale[full_column::position] = of.problem.position.norm() + v * of.span + gain * time;
    scale[full_column::impulse] = scale[full_column::gain] = M;
    scale[full_column::work] = M / sizes.least * M;
    foreseen = scale;
    if (!asked) return;
    for (const auto column : {full_column::angular_momentum, full_column::velocity, full_column::position})
      scale[column] *= share;
  }

  void operator()(const State& state, S* row) const noexcept {
    const auto& q = state.attitude;
    for (const S value : {q.x, q.y, q.z, q.w}) *row++ = value;
    const auto put = [&](const auto& values) noexcept {
      for (const S value : values) *row++ = value;
    };
    put(state.angular_velocity), put(state.angular_momentum);
    put(state.rotor_rate), put(state.rotor_angle);
    put(state.velocity), put(state.position), put(state.impulse);
    // |L| - |L - impulse|, without the difference
    const Vec3<S> L = rotate<S>(state.attitude, state.angular_momentum), before = L - state.impulse;
    const S both = L.norm() + before.norm();
    *row++ = both > 0 ? state.impulse.dot(L + before) / both : S(0);
    *row = state.work;
  }

  /// |angular_velocity|.
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return std::hypot(row[4], row[5], row[6]);
  }
  /// Attitudes further apart than honesty::parted_attitude.
  template <class Numbers>
  bool has_parted(const Numbers& a, const Numbers& b) const noexcept {
    const S half_cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    return std::abs(half_cosine) < std::cos(S(honesty::parted_attitude) / 2);
  }

 private:
  static constexpr S share = S(1e-3L);
};

template <Real Scalar>
struct FullMotionAnswer : MotionOutcome<std::size(full_columns), Scalar> {
  Integrator used = Integrator::taylor;
  /// Distance of the attitudes of neighbours at the last time, over what errors of their data and steps give in proportion to the angle that the body
  /// turns through.
  Scalar growth = 0;
  /// When a brake has first brought what it opposes to zero and held it there, s, and the error of that, s: infinite where neighbours do not
  /// come to the same stops. Status::event: when one has brought it to a stop, or all but, that the equations do not go through.
  Scalar stop = nan<Scalar>, stop_off = nan<Scalar>;
  AtStop at_stop = AtStop::rests;            ///< Status::event: why not
  std::vector<std::array<Scalar, 2>> rests;  ///< from when to when a brake holds the body, s
  Scalar rest_off = 0;                       ///< to which each of their begins is known, s
  /// Status::step_limit: the body turns far faster than foreseen, and would go on through an angle that no run reaches.
  bool outgrown = false;
  Scalar excess_judged = 0;  ///< as FullMotionOptions::judge says
};

template <Real Scalar>
struct FullMotionOptions : MotionOptions<Scalar> {
  Integrator integrator = Integrator::any;
  /// One run, as the tolerance lets begin, without neighbours: its errors are not known, and told as 0.
  bool alone = false;
  /// Error over tolerance of what the caller makes of the states, which are in place; nullptr: it makes nothing.
  Scalar (*judge)(void* caller, const FullMotionAnswer<Scalar>&) noexcept = nullptr;
  void* caller = nullptr;

  /// The greatest error over its tolerance; NaN if one is.
  Scalar excess(const FullMotionAnswer<Scalar>& answer) const noexcept {
    return greater(MotionOptions<Scalar>::excess(answer), answer.excess_judged);
  }
};

inline constexpr const char* why_stopped_by_brake =
    "a brake brings the momentum that it opposes to zero, and this integrator does not follow what becomes of the body "
    "then: leave it to the Taylor series, integrator = \"auto\"";

/// Angle, rad, that waves, fields and the orbit may go through: their phases are not known behind it.
inline constexpr double most_forcing = 1e8;

/// The full motion at the given times (s, increasing, the first >= 0). What lies behind a failure is NaN. At a breakpoint, where a law of
/// torques or wheels changes, the state is that by the law that holds from there on.
///
/// The error is estimated by runs of neighbours: body, wheels, torques and start differ by a few roundings, and the steps have a tighter
/// tolerance (companions.hpp). Their distance from the answer, watched in every step and kept for some twenty turns, is the error of the
/// answer, and shows what the motion makes of errors: that phases drift, and that all differences grow where it is chaotic. A run that
/// misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: out_of_domain (the spans differ in length; waves, fields or the orbit go through more than most_forcing), not_increasing (times), not_finite (times or tolerance), and those of check().
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {}) noexcept;

namespace detail {

/// What an evaluation of the columns loses, in their units, where the state is known to `relative`, and what one rounding of the tensor
/// makes of the angles in the span: the companions may be blind to it.
template <Real Scalar>
FullErrors<Scalar> rounding_of_columns(const Prepared<Scalar>& of, const FullRow<Scalar>& row,
                                       const FullErrors<Scalar>& size, Scalar relative) noexcept {
  const auto& wheels = of.wheels;
  Scalar carried = 0, lightest = infinity<Scalar>;  // what wheels hold, at most, and the least of them that have a p
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    if (law.follows != Follows::body) carried += law.axial_inertia * size[full_column::rotor_rate];
    if (law.turns_by_itself()) lightest = std::min(lightest, law.axial_inertia);
  }
  const Scalar momenta =
      size[full_column::angular_momentum] + std::max(row.foreseen[full_column::angular_momentum], carried);
  const Scalar fastest = momenta / of.sizes.least;
  // of w = J*^-1 (M - ...), from the start on
  const Scalar blur = epsilon<Scalar> * condition_of(wheels) * size[full_column::angular_velocity];
  FullErrors<Scalar> error;
  constexpr Scalar small = 1 / Scalar(16);
  // where w is a small difference of momenta, its rounding may stay the same for long
  const Scalar drift =
      size[full_column::angular_velocity] < small * fastest ? epsilon<Scalar> * fastest * of.span : Scalar(0);
  error[full_column::attitude] = 4 * relative + blur * of.span + drift;
  // of what turns in body axes: not in a steady rotation
  const Vec3<Scalar>&M = of.momentum, &w = of.problem.angular_velocity;
  const Scalar whole = M.norm() * w.norm();
  const Scalar swung = whole > 0 ? blur * of.span * (cross<Scalar>(M, w).norm() / whole) : Scalar(0);
  error[full_column::angular_momentum] = 4 * relative * momenta + swung * size[full_column::angular_momentum];
  error[full_column::angular_velocity] =
      2 * relative * fastest + 4 * blur + swung * size[full_column::angular_velocity];
  if (wheels.count > 0) {
    error[full_column::rotor_rate] = 4 * relative * size[full_column::rotor_rate];
    if (lightest < infinity<Scalar>) error[full_column::rotor_rate] += error[full_column::angular_velocity];
    error[full_column::rotor_angle] = 4 * relative * size[full_column::rotor_angle] + drift;
    // of the polynomial of one step, too
    if (of.sizes.turning > 0) error[full_column::rotor_angle] += error[full_column::rotor_rate] / of.sizes.turning;
  }
  for (const auto column : {full_column::velocity, full_column::position})
    error[column] = 2 * relative * (size[column] + row.foreseen[column]);
  error[full_column::impulse] = error[full_column::gain] = 4 * relative * momenta;
  const Scalar rate = size[full_column::angular_velocity];
  Scalar& work = error[full_column::work];
  // w . dM, and what the evaluation of w and of the energy loses; a phase takes no work
  const Scalar evaluated = 2 * relative * fastest + 4 * blur;
  work = rate * (relative * momenta + of.sizes.greatest * (4 * blur + 2 * relative * rate));
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    const Scalar turning = size[full_column::rotor_rate] + rate;
    const Scalar its = error[full_column::rotor_rate] + evaluated + 4 * relative * turning;
    if (law.turns_by_itself()) work += law.axial_inertia * turning * its;
  }
  return error;
}

/// The state behind a failure.
template <Real Scalar>
State<Scalar> nowhere() noexcept {
  constexpr Scalar no = nan<Scalar>;
  const Vec3<Scalar> nothing(no, no, no);
  State<Scalar> made{{no, no, no, no}, nothing, nothing, {}, {}, nothing, nothing, no, nothing};
  made.rotor_rate.fill(no), made.rotor_angle.fill(no);
  return made;
}

template <class Method>
class FullMotion {
 public:
  using Scalar = typename Method::System::Scalar;

  FullMotion(const Problem<Scalar>& problem, std::span<const Scalar> times, std::span<State<Scalar>> states,
             const FullMotionOptions<Scalar>& options) noexcept
      : problem_(problem), times_(times), states_(states), options_(options) {}

  /// The answer's run and its neighbours' side by side, and their distance.
  FullMotionAnswer<Scalar> run(const StepTolerance<Scalar>& tolerance, double progress_from,
                               double progress_to) const noexcept {
    FullMotionAnswer<Scalar> answer;
    answer.used = Method::integrator;
    answer.step_tolerance = tolerance.end;
    const StepTolerance<Scalar> tight{companion_step(tolerance.end), companion_step(tolerance.inside)};
    const Scalar span = times_.back();
    Scalar spare = share_slack<Scalar>;
    // courses are large, and live on the heap
    const auto begin = [&](const Problem<Scalar>& problem, int share, const StepTolerance<Scalar>& its) noexcept {
      return std::make_unique<Course>(problem, span, 1 / Scalar(share), its, options_.step_cap, spare);
    };
    const auto course = begin(problem_, 1, tolerance);
    const auto& of = course->prepared();
    const Condition<Scalar> condition = condition_of(of, course->at(0));
    const Scalar change = data_change(tolerance.end, condition);
    // what the answer's brakes hold those of neighbours must hold, too
    spare += 8 * change;
    const auto one = beside(problem_, change, Aside::first), two = beside(problem_, change, second_aside(condition));
    const auto companion = begin(one, 2, tight);
    std::unique_ptr<Course> second;
    if (rounding_rules(tolerance.end, condition)) second = begin(two, 3, tight);
    const double stride = of.sizes.forcing > 0 ? honesty::forced_stride : honesty::companion_stride;
    const FullRow<Scalar> row(of, !options_.wanted.empty());
    // rounding at the asked times, and between steps
    FullErrors<Scalar> between;
    const auto rounding = [&](const FullErrors<Scalar>& size, Scalar steps) noexcept {
      auto error =
          rounding_of_columns(of, row, size, shared_rounding(steps)) + Scalar(honesty::margin_between) * between;
      add_slip(error, *course);
      if constexpr (Method::integrator == Integrator::radau) {
        // where the roundings of the steps leave the momentum off, which all runs may be alike, the body turns on
        const Scalar turned = steps / 2 * of.sizes.turning * span;
        error[full_column::attitude] += turned;
        error[full_column::impulse] += turned * size[full_column::angular_momentum];
      }
      return error;
    };
    const Comparison<FullRow<Scalar>> rows(row);
    const auto note = [&]([[maybe_unused]] std::size_t i, const auto&) noexcept {
      if constexpr (Method::integrator == Integrator::radau)
        between.raise(rows.apart(rows.row(companion->inside(times_[i])), rows.row(companion->beside(times_[i]))));
    };
    solve_beside(answer, row, Runs<Course>{*course, *companion, second.get(), stride},
                 {course->at(0), times_, states_, nowhere<Scalar>(), progress_from, progress_to}, options_, rounding,
                 note);
    tell_stops(answer, *course, *companion, second.get());
    if (answer.status == ode::Status::reached && span > 0) {
      const Course& other = second ? *second : *course;
      const auto off = rows.apart(rows.row(companion->at(span)), rows.row(other.at(span)));
      const Scalar phase = of.sizes.turning * span, steps = second ? tight.end : tolerance.end;
      answer.growth = off[full_column::attitude] / ((change + steps * (1 + phase / 16)) * (1 + phase));
    }
    answer.outgrown = course->outgrown() || companion->outgrown() || (second && second->outgrown());
    return answer;
  }

  /// One run by itself.
  FullMotionAnswer<Scalar> alone(const StepTolerance<Scalar>& tolerance) const noexcept {
    FullMotionAnswer<Scalar> answer;
    answer.used = Method::integrator;
    answer.step_tolerance = tolerance.end;
    const Scalar span = times_.back();
    const auto course = std::make_unique<Course>(problem_, span, Scalar(1), tolerance, options_.step_cap);
    std::ranges::fill(states_, nowhere<Scalar>());
    std::uint64_t trips = 0;
    for (std::size_t i = 0; i < times_.size() && answer.status == ode::Status::reached; ++i) {
      while (answer.status == ode::Status::reached && course->time() < times_[i]) {
        answer.status = course->step(span);
        if ((trips++ & 255U) == 0 && options_.cancelled()) answer.status = ode::Status::cancelled;
      }
      if (answer.status == ode::Status::reached) states_[i] = course->at(times_[i]);
    }
    answer.counts = course->counts();
    answer.met = answer.status == ode::Status::reached;
    if (answer.status == ode::Status::event) answer.stop = course->time(), answer.at_stop = course->at_stop();
    answer.rests = course->rests();
    if (answer.met && !answer.rests.empty()) answer.stop = answer.rests[0][0], answer.stop_off = 0;
    answer.outgrown = course->outgrown();
    return answer;
  }

 private:
  using Course = FullCourse<Method>;

  /// Adds what a torque that brakes hold only to rounding may have done.
  static void add_slip(FullErrors<Scalar>& error, const Course& course) noexcept {
    constexpr auto margin = Scalar(honesty::slip_margin);
    const auto& sizes = course.prepared().sizes;
    const Scalar slip = margin * course.slipped(), rate = slip / sizes.least, angle = margin * course.slipped_angle();
    error[full_column::attitude] += angle;
    error[full_column::angular_momentum] += slip;
    error[full_column::angular_velocity] += rate;
    error[full_column::impulse] += slip + sizes.momentum() * angle;
    error[full_column::gain] += slip;
    error[full_column::work] += slip * (sizes.turning + rate);
    if (course.prepared().wheels.count == 0) return;
    error[full_column::rotor_rate] += rate;
    error[full_column::rotor_angle] += angle;
  }

  static void tell_stops(FullMotionAnswer<Scalar>& answer, const Course& course, const Course& one,
                         const Course* two) noexcept {
    if (answer.status == ode::Status::event) {
      answer.stop = course.time();
      for (const Course* each : {&course, &one, two})
        if (each != nullptr && answer.at_stop == AtStop::rests) answer.at_stop = each->at_stop();
      return;
    }
    answer.rests = course.rests();
    if (answer.rests.empty() || answer.status != ode::Status::reached) return;
    const std::size_t count = answer.rests.size();
    const bool alike = one.rests().size() == count && (two == nullptr || two->rests().size() == count);
    answer.stop = answer.rests[0][0];
    answer.stop_off = answer.rest_off = alike ? Scalar(0) : infinity<Scalar>;
    for (std::size_t i = 0; alike && i < count; ++i) {
      using std::abs;
      const Scalar stop = answer.rests[i][0], first = one.rests()[i][0];
      const Scalar last = two != nullptr ? two->rests()[i][0] : first;
      const Scalar apart = error_of_distances(std::max(abs(first - stop), abs(last - stop)), abs(first - last));
      const Scalar found = 2 * course.precision() + Scalar(honesty::brake_steps) * answer.step_tolerance;
      const Scalar off = Scalar(honesty::stop_margin) * apart + found * stop;
      if (i == 0) answer.stop_off = off;
      answer.rest_off = std::max(answer.rest_off, off);
    }
  }

  const Problem<Scalar>& problem_;
  std::span<const Scalar> times_;
  std::span<State<Scalar>> states_;
  const FullMotionOptions<Scalar>& options_;
};

template <class Method, Real Scalar>
FullMotionAnswer<Scalar> full_motion_of(const Prepared<Scalar>& of, std::span<const Scalar> times,
                                        std::span<State<Scalar>> states,
                                        const FullMotionOptions<Scalar>& options) noexcept {
  const FullMotion<Method> motion(of.problem, times, states, options);
  const Scalar phase = of.sizes.turning * times.back();
  // energy, momentum in space and path hardly know the phase
  const auto of_phase = options.wanted.first(std::min(options.wanted.size(), std::size_t{full_column::velocity}));
  const bool turns = std::ranges::any_of(of_phase, [](double off) { return off < infinity<double>; });
  const auto guess =
      turns || options.wanted.empty() ? first_step_tolerance_of_phase<Scalar> : first_step_tolerance<Scalar>;
  const Scalar loosest = Scalar(options.alone ? honesty::loosest_alone : honesty::loosest_step);
  const Scalar first = guess(options.tolerance, phase, loosest);
  Scalar inside = options.tolerance / 512;
  if (options.alone) return motion.alone({first, std::max(first, inside)});
  return tightened<Scalar>(options, first, [&](Scalar step_tolerance, Scalar by, double begin, double end) noexcept {
    inside = std::max(step_tolerance, inside / by);
    auto answer = motion.run({step_tolerance, inside}, begin, end);
    if (answer.status == ode::Status::reached && options.judge != nullptr) {
      answer.excess_judged = options.judge(options.caller, answer);
      answer.met = answer.met && answer.excess_judged <= 1;
    }
    return answer;
  });
}

/// Calls with the method that suits a problem.
template <Real Scalar, class Call>
auto by_method(const Prepared<Scalar>& of, Integrator integrator, const Call& call) noexcept {
  const bool collocates = integrator == Integrator::any ? of.is_stiff() : integrator == Integrator::radau;
  if (collocates && of.settling.count <= few_wheels) return call(Collocation<Scalar, few_wheels>{});
  if (collocates) return call(Collocation<Scalar, int(most_wheels)>{});
  if (of.is_large()) return call(Series<Scalar, true>{});
  return call(Series<Scalar, false>{});
}

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(full_columns)); wrong != Errc::ok) return wrong;
  if (const Fault wrong = check(problem)) return wrong.code;
  FullMotionAnswer<Scalar> answer;
  answer.met = true;
  if (times.empty()) return answer;

  Problem<Scalar> from = problem;
  from.attitude = as_unit(problem.attitude);
  const Prepared<Scalar> of(from, times.back());
  if (!(of.sizes.turning < infinity<Scalar>)) return Errc::not_finite;
  if (!(of.sizes.forcing * times.back() <= Scalar(most_forcing))) return Errc::out_of_domain;
  return detail::by_method(of, options.integrator, [&](auto method) noexcept {
    return detail::full_motion_of<decltype(method)>(of, times, states, options);
  });
}

/// What torques and motors do to a motion, and how well energy and momentum agree with it; NaN where it cannot be followed.
template <Real Scalar>
struct BalanceAnswer {
  Scalar energy = nan<Scalar>, momentum = nan<Scalar>;            ///< residuals, as of Balances
  Power<Scalar> work{nan<Scalar>, nan<Scalar>}, work_off = work;  ///< J, and by how much it may be off
  Scalar size = nan<Scalar>;                                      ///< of all work and energy, J
};

/// The balances of a motion up to `span` in steps of a tolerance; of a problem that check() finds right. with_errors: of the works, too, by two
/// neighbours in looser steps.
template <Real Scalar>
BalanceAnswer<Scalar> balance(const Problem<Scalar>& problem, Scalar span, Scalar step_tolerance, bool with_errors,
                              std::uint64_t step_cap = step_budget) noexcept {
  const Prepared<Scalar> of(problem, span);
  return detail::by_method(of, Integrator::any, [&](auto method) noexcept -> BalanceAnswer<Scalar> {
    using Course = detail::FullCourse<decltype(method)>;
    const auto run = [&](const Problem<Scalar>& its, int share, Scalar steps) noexcept {
      BalanceAnswer<Scalar> made;
      Course course(its, span, 1 / Scalar(share), {steps, steps}, step_cap);
      Balances<Scalar> sum(its, course.prepared().wheels);
      while (course.time() < span) {
        if (course.step(span) != ode::Status::reached) return made;
        sum.add(course.previous_time(), course.time(), [&](Scalar t) noexcept { return course.inside(t); });
      }
      made.energy = sum.energy(), made.momentum = sum.momentum(), made.work = sum.work(), made.size = sum.size();
      // rounding, and their part of what their sum is off by
      const auto off = [&](Scalar all) noexcept {
        return all > 0 ? all * (4 * epsilon<Scalar> + sum.energy() * sum.size() / sum.all_work().whole()) : Scalar(0);
      };
      made.work_off = {off(sum.all_work().torques), off(sum.all_work().motors)};
      // an energy that is kept is known to a rounding of what is in it, a potential among it
      if (made.work_off.torques > 0)
        made.work_off.torques += 4 * epsilon<Scalar> * (of.sizes.external + of.sizes.forcing * of.sizes.momentum());
      return made;
    };
    BalanceAnswer<Scalar> made = run(problem, 1, companion_step(step_tolerance));
    if (!with_errors || !(made.energy < infinity<Scalar>)) return made;
    const auto condition = detail::condition_of(of, Course(problem, span, Scalar(1), {}, step_cap).at(0));
    const Scalar change = data_change(step_tolerance, condition);
    const auto one = run(detail::beside(problem, change, Aside::first), 2, step_tolerance);
    const auto two = run(detail::beside(problem, change, second_aside(condition)), 3, step_tolerance);
    const auto raise = [](Scalar& off, Scalar a, Scalar b, Scalar c) noexcept {
      using std::abs;
      off = std::max(off, error_of_distances(std::max(abs(a - b), abs(a - c)), abs(b - c)));
    };
    raise(made.work_off.torques, made.work.torques, one.work.torques, two.work.torques);
    raise(made.work_off.motors, made.work.motors, one.work.motors, two.work.motors);
    return made;
  });
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                                     std::span<State<double>>,
                                                                     const FullMotionOptions<double>&) noexcept;
extern template BalanceAnswer<double> balance<double>(const Problem<double>&, double, double, bool,
                                                      std::uint64_t) noexcept;
#endif

}  // namespace gyrostat::general
