// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/general/balances.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/rest.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/stiff.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/ode/radau.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The full motion of a body with any wheels under any torques, piece by piece between breakpoints: by Taylor series, or by collocation where
/// wheels settle fast.
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

/// A motion is given up where the body turns so many times faster than its momentum and the torques let foresee, and would turn through
/// this angle, rad, at the rate it has come to: no budget of steps reaches so far.
inline constexpr double outgrown_rate = 1e3, outgrown_angle = 50 * unreachable_angle;
/// Or so many times faster, in steps that would overrun the budget by far.
inline constexpr double outgrown_pace = 30;
inline constexpr const char* why_outgrown =
    "the body turns ever faster, far beyond what its momentum and the torques at the start let foresee: something "
    "drives it, such as a torque about an axis of little inertia or damping with a negative sign; ask for a shorter "
    "span";

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

/// So many wheels that settle fast have equations of their own size; most scenes have no more.
inline constexpr int few_wheels = 4;

/// The equations by Taylor series.
template <Real Scalar, bool large>
struct Series {
  static constexpr Integrator integrator = Integrator::taylor;
  static constexpr bool is_large = large;
  using System = FullSystem<Scalar, large>;
  using Solver = ode::Taylor<System>;
  using Numbers = typename System::Numbers;
  static typename Solver::Options options(Scalar tolerance, Scalar, Scalar, std::uint64_t step_cap) noexcept {
    typename Solver::Options made;
    made.tolerance = tolerance, made.step_cap = step_cap;
    return made;
  }
};

/// The same by collocation, with up to `most` wheels that settle.
template <Real Scalar, int most>
struct Collocation {
  static constexpr Integrator integrator = Integrator::radau;
  static constexpr bool is_large = true;
  using System = StiffSystem<Scalar, most>;
  using Solver = ode::Radau<System>;
  using Numbers = typename System::Numbers;
  static typename Solver::Options options(Scalar tolerance, Scalar inside, Scalar share,
                                          std::uint64_t step_cap) noexcept {
    typename Solver::Options made;
    made.tolerance = tolerance, made.inside = inside, made.step_cap = step_cap;
    made.blur = 4;
    made.pace = share < 1 ? Scalar(honesty::companion_pace) : Scalar(1);
    return made;
  }
};

/// What the steps of a run may err.
template <Real Scalar>
struct StepTolerance {
  Scalar end;     ///< at their ends: these errors add up
  Scalar inside;  ///< between them; of collocation alone
};

/// One run of the equations over all pieces. cuts: the breakpoints. share: the first step of each piece ends at this share of it at
/// the latest, for two runs that took it in one step would take the same polynomial, and err alike.
template <class Method>
class FullCourse {
  using System = typename Method::System;
  using Solver = typename Method::Solver;
  using Numbers = typename Method::Numbers;

 public:
  using Scalar = typename System::Scalar;

  /// spare: the slack of stop_at().
  FullCourse(const Problem<Scalar>& problem, Scalar span, std::span<const Scalar> cuts, Scalar share,
             const StepTolerance<Scalar>& tolerance, std::uint64_t step_cap,
             Scalar spare = share_slack<Scalar>) noexcept
      : of_(problem, span),
        cuts_(cuts),
        last_(span),
        share_(share),
        spare_(spare),
        options_(Method::options(tolerance.end, tolerance.inside, share, step_cap)) {
    piece_ = Piece<Scalar>::first(problem, of_.wheels, of_.torques, cuts.empty() ? span : cuts.front());
    enter(0, System::first_numbers(of_));
  }
  FullCourse(const FullCourse&) = delete;
  FullCourse& operator=(const FullCourse&) = delete;

  /// One step, at most up to t_max, and to the end of the piece; where a brake holds the body, all the way.
  ode::Status step(Scalar t_max) noexcept {
    if (next_) pass();
    if (at_stop_ != AtStop::rests) return ode::Status::event;
    if (!(t_max > time_)) return ode::Status::reached;
    if (resting_) {
      previous_ = time_;
      time_ = rests_.back()[1] = std::min(t_max, piece_.to);
      look_ahead();
      return ode::Status::reached;
    }
    const ode::Status status = move(t_max);
    if (status == ode::Status::reached) look_ahead();
    return status;
  }

  Scalar time() const noexcept { return time_; }

  /// The state at t in the last step; where the piece ends with it, by the laws of the next.
  State<Scalar> at(Scalar t) const noexcept {
    alignas(32) const Numbers x = numbers(t);
    return system_->state(next_ && t >= piece_.to ? *next_ : piece_, t, x.data());
  }

  /// The same by the laws of the piece that the last step is in, to its end.
  State<Scalar> inside(Scalar t) const noexcept {
    alignas(32) const Numbers x = numbers(t);
    return system_->state(piece_, t, x.data());
  }
  Scalar previous_time() const noexcept { return previous_; }

  /// Of collocation alone: inside() with the error that its last coefficients suggest.
  State<Scalar> beside(Scalar t) const noexcept {
    alignas(32) Numbers x;
    solver_->beside(t, x.data());
    return system_->state(piece_, t, x.data());
  }

  /// From when to when brakes have held the body so far, s.
  const std::vector<std::array<Scalar, 2>>& rests() const noexcept { return rests_; }
  /// Momentum, N m s, and turn, rad, that a torque which the brakes may not quite have held can have given the body.
  Scalar slipped() const noexcept { return slipped_; }
  Scalar slipped_angle() const noexcept { return slipped_angle_; }
  /// Share of its time to which a stop is found.
  static constexpr Scalar precision() noexcept { return precision_; }
  /// Behind Status::event: why the stop is not gone through.
  AtStop at_stop() const noexcept { return at_stop_; }

  ode::Counts counts() const noexcept {
    ode::Counts all = counts_;
    if (solver_) all += solver_->counts();
    return all;
  }
  const Prepared<Scalar>& prepared() const noexcept { return of_; }
  /// Whether the motion has been given up because it grows without end.
  bool outgrown() const noexcept { return outgrown_; }

 private:
  static constexpr bool goes_through_stops = Method::integrator == Integrator::taylor;
  using Rest = std::conditional_t<goes_through_stops, Resting<Scalar, Method::is_large>, Numbers>;

  /// How a body leaves its rest, from the numbers of `rest` on, up to `until`: what brakes oppose grows by `rate`, N m, or by the outgrowth.
  struct Leaving {
    Rest rest;
    Vec3<Scalar> rate;
    Outgrowth<Scalar> outgrowth;
    Scalar until;

    Vec3<Scalar> gained(Scalar s) const noexcept { return s * (rate + s * (outgrowth.second + s * outgrowth.third)); }
  };

  ode::Status move(Scalar t_max) noexcept {
    Scalar until = std::min(t_max, piece_.to);
    if (const Scalar part = piece_.from + share_ * (piece_.to - piece_.from); !(time_ > piece_.from) && part > time_)
      until = std::min(until, part);
    const Scalar before = system_->has_brake() ? system_->braked(time_, solver_->state()) : infinity<Scalar>;
    // a step must not jump over a stop: so far that no torque takes away more than half of what a brake opposes
    const Scalar sound =
        before < infinity<Scalar>
            ? time_ + (1 + share_) * before / (4 * std::min(bound_, system_->torque(time_, solver_->state())))
            : infinity<Scalar>;
    // and where the time cannot tell the rest of it
    if (!(std::min(until, sound) > time_)) return come_to_stop(time_);
    const Scalar bold = std::max(sound, time_ + std::min(doubling(before), steady_ * (sound - time_)));
    greatest_ = before < infinity<Scalar> ? std::max(greatest_, before) : greatest_;
    braked_ = before;
    const Vec3<Scalar> heading = System::turned(solver_->state());
    Numbers from;
    if (bold > sound) from = numbers_now();
    ode::Status status = solver_->step(std::min(until, bold));
    if constexpr (goes_through_stops)
      if (status == ode::Status::reached && solver_->time() > sound && !keeps_on(from)) {
        solver_->restart(time_, from);
        status = solver_->step(std::min(until, sound));
      }
    if (status != ode::Status::reached) return status;
    previous_ = solver_->previous_time(), time_ = solver_->time();
    const Scalar rate = (System::turned(solver_->state()) - heading).norm() / (time_ - previous_);
    outgrown_ = rate > Scalar(outgrown_rate) * of_.sizes.turning && rate * (last_ - previous_) > Scalar(outgrown_angle);
    const bool hopeless = is_hopeless();
    outgrown_ = outgrown_ || (hopeless && rate > Scalar(outgrown_pace) * of_.sizes.turning);
    if (outgrown_ || hopeless) return ode::Status::step_limit;
    if (before < infinity<Scalar>)
      if (const Scalar stop = stop_time(before); stop < infinity<Scalar>) return come_to_stop(stop);
    return ode::Status::reached;
  }

  /// Time in which what brakes oppose, `now`, doubles if it goes on growing as in the last step; 0 if it does not grow. Only Taylor series step so far.
  Scalar doubling(Scalar now) const noexcept {
    if (!goes_through_stops || !(now < infinity<Scalar> && braked_ > 0 && now > braked_)) return 0;
    return (1 + share_) / 2 * now * ((time_ - previous_) / (now - braked_));
  }
  /// Whether what brakes oppose has kept its direction in inertial axes, to 60 degrees, since these numbers: it has not passed through zero.
  bool keeps_on(const Numbers& from) const noexcept {
    const State<Scalar> old = system_->state(time_, from.data());
    const State<Scalar> now = system_->state(solver_->time(), solver_->state());
    const auto alike = [&](const Vec3<Scalar>& u, const Vec3<Scalar>& v) noexcept {
      const Scalar along = rotate<Scalar>(old.attitude, u).dot(rotate<Scalar>(now.attitude, v));
      return 2 * along > u.norm() * v.norm();
    };
    const Mat3<Scalar>& J = of_.wheels.whole;
    return alike(old.angular_momentum, now.angular_momentum) &&
           alike(J * old.angular_velocity, J * now.angular_velocity);
  }
  Numbers numbers_now() const noexcept {
    Numbers x;
    std::copy_n(solver_->state(), x.size(), x.begin());
    return x;
  }

  /// The piece behind this one, where it ends with the last step.
  void look_ahead() noexcept {
    if (!(time_ >= piece_.to && (parted_ || cut_ < cuts_.size()))) return;
    if (!parted_) ++cut_;
    parted_ = false;
    const Scalar to = cut_ < cuts_.size() ? cuts_[cut_] : last_;
    next_ = Piece<Scalar>::behind(piece_, of_.problem, of_.wheels, of_.torques, to);
  }

  Numbers numbers(Scalar t) const noexcept {
    alignas(32) Numbers x;
    if constexpr (goes_through_stops) {
      if (resting_ && t >= resting_->from()) return resting_->at(t);
      if (leaving_ && t < leaving_->until) return numbers_leaving(t);
    }
    solver_->at(t, x.data());
    return x;
  }
  /// A moment after a rest.
  Numbers numbers_leaving(Scalar t) const noexcept {
    using At = typename System::At;
    const Scalar s = t - leaving_->rest.from();
    const Vec3<Scalar> gained = leaving_->gained(s);
    Numbers x = leaving_->rest.at(t);
    for (std::size_t i = 0; i < 3; ++i) x[At::momentum + i] += gained[int(i)];
    if (const auto& [second, third, time] = leaving_->outgrowth; time > 0) {
      const Vec3<Scalar> turn = of_.wheels.inverse * Vec3<Scalar>(s * s * s * (second / 3 + s * third / 4));
      const Quat<Scalar> q = Quat<Scalar>{x[0], x[1], x[2], x[3]} * quaternion_from_vector<Scalar>(turn);
      x[0] = q.w, x[1] = q.x, x[2] = q.y, x[3] = q.z;
      for (std::size_t i = 0; i < 3; ++i) x[At::turned + i] += turn[int(i)];
    }
    return x;
  }

  /// Begins piece_ at t.
  void enter(Scalar t, const Numbers& numbers) noexcept {
    const bool rested = bool(resting_);
    resting_.reset(), leaving_.reset();
    system_.emplace(of_, piece_, numbers);
    options_.scale = system_->scale();
    time_ = previous_ = t;
    greatest_ = braked_ = 0;
    bound_ = torque_of_piece();
    // what a brake opposes is a difference of momenta: below its rounding the body is at rest
    const Scalar nothing = 4 * epsilon<Scalar> * of_.sizes.momentum();
    if (system_->has_brake() && !(system_->braked(t, numbers.data()) > nothing)) decide_at_stop(t, numbers, rested, t);
    else begin(t, numbers);
  }
  /// A bound of the torques in the piece; infinite where wheels add theirs.
  Scalar torque_of_piece() const noexcept {
    using std::abs;
    if (!system_->has_brake() || stoppable(of_, piece_) == AtStop::turning) return infinity<Scalar>;
    const Scalar length = piece_.to - piece_.from;
    const auto size = [&](const Terms<Scalar>& terms) noexcept {
      return torque_size(of_.problem, terms, of_.sizes.greatest);
    };
    Scalar sum = 0, power = 1;
    for (std::size_t k = 0; k < 4; ++k, power *= length) {
      sum += power * size(piece_.power[k]);
      for (const auto& wave : piece_.waves) sum += power * abs(wave.cubic.about(piece_.from).c[k]) * size(wave.terms);
    }
    return sum;
  }
  void begin(Scalar t, const Numbers& numbers) noexcept {
    if (solver_) {
      counts_ += solver_->counts();
      options_.step_cap -= std::min(options_.step_cap, solver_->counts().steps);
    }
    solver_.emplace(*system_, t, numbers, options_);
    time_ = t;
  }
  /// Goes on to the next piece.
  void pass() noexcept {
    const Scalar t = time_;
    const Numbers x = numbers(t);
    piece_ = std::move(*next_);
    next_.reset();
    pace_.restart(t);
    enter(t, x);
  }

  /// What a brake opposes is zero from t on, at these numbers. rested: it was already. when: exactly, for a body that leaves at once.
  void decide_at_stop(Scalar t, const Numbers& numbers, bool rested, Scalar when) noexcept {
    if constexpr (!goes_through_stops) {
      at_stop_ = AtStop::turning;
    } else {
      const auto q = normalised(Quat<Scalar>{numbers[0], numbers[1], numbers[2], numbers[3]});
      const Stop<Scalar> made = stop_at(of_, piece_, q, t, spare_);
      if (made.what == AtStop::leaves) return begin_departure(made, when, numbers);
      if (made.what == AtStop::rests) return begin_rest(made, t, numbers, rested);
      at_stop_ = made.what;
    }
    if (at_stop_ != AtStop::rests && !solver_) begin(t, numbers);
  }
  void begin_rest(const Stop<Scalar>& made, Scalar t, const Numbers& numbers, bool rested) noexcept {
    if constexpr (goes_through_stops) {
      resting_.emplace(of_, piece_, made, t, numbers);
      if (!rested) rests_.push_back({t, t});
      parted_ = made.until < piece_.to;
      piece_.to = std::min(made.until, piece_.to);
      take_slip(made.slip * (piece_.to - t), last_ - t);
    }
  }
  /// Momentum, N m s, that a run may have taken wrongly, and that turns the body for so long.
  void take_slip(Scalar momentum, Scalar time) noexcept {
    slipped_ += momentum, slipped_angle_ += momentum / of_.sizes.least * time;
  }
  void begin_departure(const Stop<Scalar>& stop, Scalar t, const Numbers& numbers) noexcept {
    if constexpr (goes_through_stops) {
      using std::cbrt, std::sqrt;
      const auto& sizes = of_.sizes;
      const auto& out = stop.outgrowth;
      const Scalar left = piece_.to - t;
      Scalar moment;
      if (out.time > 0) {
        // so short that what the series leaves out is a millionth of it; behind it steps are the shorter the less has been gained
        const Scalar pace = 1 / out.time + sizes.damping + magnitude(stop.turning) +
                            magnitude(piece_.momentum[0]) / sizes.least + cbrt(magnitude(out.second) / sizes.least);
        moment = std::min(Scalar(1e-3L) * (1 + share_) / pace, left / 2);
      } else {
        // so short that what the direction and the torque have changed is lost in rounding
        const Scalar pace =
            sizes.turning + sizes.damping + sizes.forcing + 1 / left + sqrt(stop.departure.rate / sizes.least);
        moment = Scalar(1e-9L) * (1 + share_) / pace;
      }
      // all runs know when to some roundings alone
      const Scalar late = Scalar(honesty::release_roundings) * epsilon<Scalar> * t;
      take_slip((std::abs(stop.departure.rate) + 2 * magnitude(out.second) * left) * late, last_ - t);
      moment = std::max(moment, 64 * epsilon<Scalar> * t);
      const Scalar until = t + moment < piece_.to ? t + moment : t;
      const Vec3<Scalar> rate = stop.departure.rate * stop.departure.direction;
      leaving_.emplace(Leaving{Rest(of_, piece_, stop, t, numbers), rate, out, until});
      Numbers x = numbers_leaving(until);
      if (!(until > t))
        for (std::size_t i = 0; i < 3; ++i) x[System::At::momentum + i] += leaving_->gained(moment)[int(i)];
      previous_ = t;
      begin(until, x);
    }
  }
  /// The motion has come to a stop, but for what no step can tell.
  ode::Status come_to_stop(Scalar when) noexcept {
    const Numbers x = numbers_now();
    at_stop_ = stoppable(of_, piece_);
    if (at_stop_ == AtStop::rests) {
      leaving_.reset();
      const std::size_t before = rests_.size();
      decide_at_stop(time_, x, false, std::min(when, piece_.to));
      if (rests_.size() > before) rests_.back()[0] = when;
    }
    return at_stop_ == AtStop::rests ? ode::Status::reached : ode::Status::event;
  }
  /// When what a brake opposes vanishes, if it is all but gone, `before` being its size where the last step began; infinite otherwise.
  Scalar stop_time(Scalar before) const noexcept {
    const Scalar now = system_->braked(time_, solver_->state());
    if (!(now > 0)) return time_;
    if (!(now < before && now < nearly_ * std::max(greatest_, now))) return infinity<Scalar>;
    if (!goes_through_stops || stoppable(of_, piece_) != AtStop::rests) return time_;
    const State<Scalar> at = system_->state(time_, solver_->state());
    const Vec3<Scalar>&M = at.angular_momentum, &w = at.angular_velocity, Jw = of_.wheels.whole * w;
    const Pose<Scalar> pose{at.attitude, w, M};
    const Vec3<Scalar> torque = load_at(of_.problem, pose, time_, piece_.inside()).torque;
    const bool of_carrier = std::abs(Jw.norm() - now) < std::abs(M.norm() - now);
    const Vec3<Scalar> rate = cross<Scalar>(M, w) + torque, U = of_carrier ? Jw : M;
    const Scalar fall = -U.dot(rate) / now;
    // where U is a difference of greater momenta
    const Scalar blur = Vec3<Scalar>(M - U).norm();
    const Scalar gone = std::max(precision_ * time_ * fall, 16 * epsilon<Scalar> * blur);
    return fall > 0 && now <= gone ? time_ + now / fall : infinity<Scalar>;
  }
  /// Whether steps would overrun the budget (Pace), where no law changes any more.
  bool is_hopeless() noexcept {
    if (next_ || cut_ < cuts_.size()) return false;
    return pace_.is_hopeless(solver_->counts().steps, time(), last_, options_.step_cap);
  }
  static constexpr Scalar nearly_ = Scalar(1e-6L);
  /// By how much steps may be longer than what excludes a stop: what lies across the direction of a departure decays with brake over momentum,
  /// and a step over more than some 8 of its times would let it grow.
  static constexpr Scalar steady_ = 24;
  /// Share of its time to which a stop is found; float cannot resolve 1e-13.
  static constexpr Scalar precision_ = Scalar(1e-13L) * std::max(Scalar(1), epsilon<Scalar> / Scalar(1e-15L));
  Prepared<Scalar> of_;
  std::span<const Scalar> cuts_;
  Scalar last_, share_, spare_, time_ = 0, previous_ = 0;
  Pace<Scalar> pace_;
  bool outgrown_ = false;
  std::size_t cut_ = 0;
  Piece<Scalar> piece_;
  std::optional<Piece<Scalar>> next_;
  typename Solver::Options options_;
  std::optional<System> system_;
  std::optional<Solver> solver_;
  ode::Counts counts_;
  Scalar greatest_ = 0, bound_ = infinity<Scalar>, slipped_ = 0, slipped_angle_ = 0;
  bool parted_ = false;  ///< the piece ends before its breakpoint, where a torque outgrows the brakes
  Scalar braked_ = 0;    ///< what brakes opposed where the last step began, in the same piece
  AtStop at_stop_ = AtStop::rests;
  std::optional<Rest> resting_;
  std::optional<Leaving> leaving_;
  std::vector<std::array<Scalar, 2>> rests_;
};

/// By how much the inverse of the tensor without its wheels magnifies its rounding; 1 where it is diagonal.
template <Real Scalar>
Scalar condition_of(const Wheels<Scalar>& wheels) noexcept {
  if (wheels.reduced.isDiagonal(0)) return 1;
  return wheels.whole.cwiseAbs().maxCoeff() * wheels.inverse.cwiseAbs().maxCoeff();
}

/// The same, or by how much the start magnifies errors where that is more.
template <Real Scalar>
Scalar condition_of(const Wheels<Scalar>& wheels, const State<Scalar>& start) noexcept {
  return std::max(condition_of(wheels),
                  start_sensitivity<Scalar>(start.angular_momentum, start.angular_velocity, wheels.inverse));
}

/// Arbitrary numbers of about 1, the same sequence every time.
template <Real Scalar>
class Shifts {
 public:
  explicit Shifts(int which) noexcept : turn_(which) {}
  Scalar operator()() noexcept {
    constexpr long double of[] = {0.9L, -0.6L, 0.7L, -0.8L, 0.5L, -0.7L, 0.8L, -0.9L, 0.6L, -0.5L, 1.0L};
    turn_ = (turn_ + 1) % 11;
    return static_cast<Scalar>(of[turn_]);
  }
  Vec3<Scalar> vector() noexcept { return {(*this)(), (*this)(), (*this)()}; }

 private:
  int turn_;
};

/// Whether zeros of the data stay zero by a symmetry: rotation about one axis of a diagonal tensor, along which all wheels and torques
/// are.
template <Real Scalar>
bool keeps_axis(const Problem<Scalar>& of) noexcept {
  if (!of.inertia.isDiagonal(0)) return false;
  const auto along = [](const Vec3<Scalar>& v, int k) noexcept { return v[(k + 1) % 3] == 0 && v[(k + 2) % 3] == 0; };
  for (int k = 0; k < 3; ++k) {
    bool kept = along(of.angular_velocity, k) && along(of.rotor_momentum, k);
    for (const auto& wheel : of.wheels) kept = kept && along(wheel.axis, k);
    for (const auto& torque : of.torques) {
      const bool fixed = torque.type == TorqueType::constant || torque.type == TorqueType::charge;
      const bool diagonal = torque.type == TorqueType::damping || torque.type == TorqueType::brake;
      kept = kept && ((fixed && torque.axes == Axes::body && along(torque.vector, k)) ||
                      (diagonal && torque.matrix.isDiagonal(0)));
    }
    if (kept) return true;
  }
  return false;
}

/// A problem that differs from the given one by about `amount`: by what rounding makes of data and arithmetic. What is exactly zero of a
/// wheel or torque stays so, and so do a body at rest and zeros that a symmetry keeps. which: 0 or 1, in another direction.
template <Real Scalar>
Problem<Scalar> beside(const Problem<Scalar>& of, Scalar amount, int which) noexcept {
  Shifts<Scalar> shift(5 * which + 3);
  Problem<Scalar> near = of;
  const bool kept = keeps_axis(of);
  const auto scale = [&](Scalar& x) noexcept { x *= 1 + amount * shift(); };
  const auto scale_vector = [&](Vec3<Scalar>& v) noexcept {
    for (int i = 0; i < 3; ++i) scale(v[i]);
  };
  const auto move = [&](Vec3<Scalar>& v) noexcept {
    const Scalar by = amount * v.cwiseAbs().maxCoeff();
    for (int i = 0; i < 3; ++i)
      if (const Scalar s = shift(); v[i] != 0 || !kept) v[i] += by * s;
  };
  Mat3<Scalar> change = moment_shifts<Scalar>(which).asDiagonal();
  if (of.inertia.isDiagonal(0)) {
    near.inertia += amount * of.inertia * change;
  } else {
    for (int i = 0; i < 3; ++i) change(i, (i + 1) % 3) = change((i + 1) % 3, i) = shift();
    near.inertia += amount * of.inertia.cwiseAbs().maxCoeff() * change;
  }
  move(near.rotor_momentum), move(near.angular_velocity);
  for (auto& wheel : near.wheels) {
    if (!kept) {
      Vec3<Scalar> axis = wheel.axis + amount * cross<Scalar>(shift.vector(), wheel.axis);
      wheel.axis = axis.normalized();
    }
    scale(wheel.axial_inertia), scale(wheel.rate), scale(wheel.torque), scale(wheel.friction);
    scale(wheel.slope), scale(wheel.no_load_rate);
    for (Scalar& v : wheel.table.values) scale(v);
  }
  for (auto& torque : near.torques) {
    scale_vector(torque.vector), scale_vector(torque.point);
    for (int i = 0; i < 9; ++i) scale(torque.matrix(i));
    if (torque.gradient) scale(*torque.gradient);
    for (Scalar& v : torque.table.values) scale(v);
    for (Scalar& v : torque.factor.table.values) scale(v);
    scale(torque.factor.mean), scale(torque.factor.amplitude), scale(torque.factor.rate), scale(torque.factor.phase);
  }
  scale_vector(near.centre_of_mass), scale_vector(near.field.flux_density);
  scale(near.field.gravity), scale(near.field.rate), scale(near.field.strength), scale(near.mass);
  scale_vector(near.velocity), scale_vector(near.position);
  if (near.orbit) {
    scale(near.orbit->radius), scale(near.orbit->mu), scale(near.orbit->true_anomaly);
    if (Scalar e = of.orbit->eccentricity; scale(e), e < 1) near.orbit->eccentricity = e;
  }
  if (of.clock != 0) {
    // what went on before by rates that are known to rounding
    const auto late = [&]() noexcept { return amount / 2 * shift() * of.clock; };
    if (near.orbit) near.orbit = orbit_from(*near.orbit, late());
    for (auto& torque : near.torques)
      if (torque.factor.amplitude != 0) torque.factor.phase += torque.factor.rate * late();
    if (near.field.magnetic == MagneticField::rotating)
      near.field.flux_density = field_at<Scalar>(near, late()).flux_density;
  }
  return near;
}

/// What an evaluation of the columns loses, in their units, where the state is known to `relative`.
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
  error[full_column::angular_momentum] = 4 * relative * momenta;
  error[full_column::angular_velocity] = 2 * relative * fastest + 4 * blur;
  if (wheels.count > 0) {
    error[full_column::rotor_rate] = 4 * relative * size[full_column::rotor_rate];
    if (lightest < infinity<Scalar>) error[full_column::rotor_rate] += error[full_column::angular_velocity];
    error[full_column::rotor_angle] = 4 * relative * size[full_column::rotor_angle] + drift;
    // of the polynomial of one step, too
    if (of.sizes.turning > 0) error[full_column::rotor_angle] += error[full_column::rotor_rate] / of.sizes.turning;
  }
  for (const auto column : {full_column::velocity, full_column::position})
    error[column] = 4 * relative * (size[column] + row.foreseen[column]);
  error[full_column::impulse] = error[full_column::gain] = 4 * relative * momenta;
  const Scalar rate = size[full_column::angular_velocity];
  Scalar& work = error[full_column::work];
  work = of.sizes.greatest * rate * (error[full_column::angular_velocity] + 4 * relative * rate);
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    const Scalar turning = size[full_column::rotor_rate] + rate;
    const Scalar its = error[full_column::rotor_rate] + error[full_column::angular_velocity] + 4 * relative * turning;
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
      : problem_(problem),
        times_(times),
        states_(states),
        options_(options),
        cuts_(breakpoints(problem, times.back())) {}

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
      return std::make_unique<Course>(problem, span, cuts_, 1 / Scalar(share), its, options_.step_cap, spare);
    };
    const auto course = begin(problem_, 1, tolerance);
    const auto& of = course->prepared();
    const Scalar condition = condition_of(of.wheels, course->at(0)), change = data_change(tolerance.end, condition);
    // what the answer's brakes hold those of neighbours must hold, too
    spare += 8 * change;
    const auto one = beside(problem_, change, 0), two = beside(problem_, change, 1);
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
                 {course->at(0), of.sizes.turning, times_, states_, nowhere<Scalar>(), progress_from, progress_to},
                 options_, rounding, note);
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

 private:
  using Course = FullCourse<Method>;

  /// Adds what a torque that brakes hold only to rounding may have done.
  static void add_slip(FullErrors<Scalar>& error, const Course& course) noexcept {
    const Scalar rate = course.slipped() / course.prepared().sizes.least, angle = course.slipped_angle();
    const auto& sizes = course.prepared().sizes;
    error[full_column::attitude] += angle;
    error[full_column::angular_momentum] += course.slipped();
    error[full_column::angular_velocity] += rate;
    error[full_column::impulse] += course.slipped() + sizes.momentum() * angle;
    error[full_column::gain] += course.slipped();
    error[full_column::work] += course.slipped() * (sizes.turning + rate);
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
  std::vector<Scalar> cuts_;
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
  const Scalar first = guess(options.tolerance, phase, Scalar(honesty::loosest_step));
  Scalar inside = options.tolerance / 512;
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
  if (states.size() != times.size()) return Errc::out_of_domain;
  if (const Errc wrong = check_span(times); wrong != Errc::ok) return wrong;
  if (!(options.tolerance == options.tolerance)) return Errc::not_finite;
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

/// How well energy and momentum of a motion up to `span` agree with what torques and motors have done.
template <Real Scalar>
struct BalanceResiduals {
  Scalar energy = nan<Scalar>, momentum = nan<Scalar>;  ///< as of Balances; NaN where the motion cannot be followed
};

/// The balances of a motion in steps of a tolerance; of a problem that check() finds right.
template <Real Scalar>
BalanceResiduals<Scalar> balance_residuals(const Problem<Scalar>& problem, Scalar span, Scalar step_tolerance,
                                           std::uint64_t step_cap = step_budget) noexcept {
  const auto cuts = breakpoints(problem, span);
  const Prepared<Scalar> of(problem, span);
  return detail::by_method(of, Integrator::any, [&](auto method) noexcept -> BalanceResiduals<Scalar> {
    const detail::StepTolerance<Scalar> tolerance{step_tolerance, step_tolerance};
    const auto course =
        std::make_unique<detail::FullCourse<decltype(method)>>(problem, span, cuts, Scalar(1), tolerance, step_cap);
    Balances<Scalar> balances(problem, course->prepared().wheels);
    while (course->time() < span) {
      if (course->step(span) != ode::Status::reached) return {};
      balances.add(course->previous_time(), course->time(), [&](Scalar t) noexcept { return course->inside(t); });
    }
    return {balances.energy(), balances.momentum()};
  });
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                                     std::span<State<double>>,
                                                                     const FullMotionOptions<double>&) noexcept;
extern template BalanceResiduals<double> balance_residuals<double>(const Problem<double>&, double, double,
                                                                   std::uint64_t) noexcept;
#endif

}  // namespace gyrostat::general
