// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/pace.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/rest.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/stiff.hpp"
#include "gyrostat/ode/radau.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// One run of the full equations of a general scene, piece by piece between breakpoints, through the stops that brakes bring.
namespace gyrostat::general {

/// A motion is given up where the body turns so many times faster than its momentum and the torques let foresee, and would turn through
/// this angle, rad, at the rate it has come to: no budget of steps reaches so far.
inline constexpr double outgrown_rate = 1e3, outgrown_angle = 50 * unreachable_angle;
/// Or so many times faster, in steps that would overrun the budget by far.
inline constexpr double outgrown_pace = 30;
inline constexpr const char* why_outgrown =
    "the body turns ever faster, far beyond what its momentum and the torques at the start let foresee: something "
    "drives it, such as a torque about an axis of little inertia or damping with a negative sign; ask for a shorter "
    "span";

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

/// One run of the equations over all pieces. share: the first step of each piece ends at this share of it at
/// the latest, for two runs that took it in one step would take the same polynomial, and err alike.
template <class Method>
class FullCourse {
  using System = typename Method::System;
  using Solver = typename Method::Solver;
  using Numbers = typename Method::Numbers;

 public:
  using Scalar = typename System::Scalar;

  /// spare: the slack of stop_at().
  FullCourse(const Problem<Scalar>& problem, Scalar span, Scalar share, const StepTolerance<Scalar>& tolerance,
             std::uint64_t step_cap, Scalar spare = share_slack<Scalar>) noexcept
      : of_(problem, span),
        cuts_(breakpoints(problem, span)),
        last_(span),
        share_(share),
        spare_(spare),
        options_(Method::options(tolerance.end, tolerance.inside, share, step_cap)) {
    piece_ = Piece<Scalar>::first(problem, of_.wheels, of_.torques, cuts_.empty() ? span : cuts_.front());
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

  /// Begins piece_ at t. lost: of the numbers, by rounding; known: the momentum in the piece before, where the motion goes on from it.
  void enter(Scalar t, const Numbers& numbers, const Numbers& lost = {},
             const KnownMomentum<Scalar>* known = nullptr) noexcept {
    const bool rested = bool(resting_);
    resting_.reset(), leaving_.reset();
    system_.emplace(of_, piece_, numbers, lost, known);
    options_.scale = system_->scale();
    time_ = previous_ = t;
    greatest_ = braked_ = 0;
    bound_ = torque_of_piece();
    // what a brake opposes is a difference of momenta: below its rounding the body is at rest
    const Scalar nothing = 4 * epsilon<Scalar> * of_.sizes.momentum();
    if (system_->has_brake() && !(system_->braked(t, numbers.data()) > nothing))
      return decide_at_stop(t, numbers, rested, t);
    begin(t, numbers);
    solver_->regain(lost.data());
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
    const bool moves = !resting_ && t == solver_->time();
    const Numbers x = moves ? numbers_now() : numbers(t);
    Numbers lost{};
    if (moves) std::copy_n(solver_->lost(), lost.size(), lost.begin());
    const KnownMomentum<Scalar> known = system_->known();
    piece_ = std::move(*next_);
    next_.reset();
    pace_.restart(t);
    enter(t, x, lost, moves ? &known : nullptr);
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
      const Vec3<Scalar> rate = stop.departure.rate * stop.departure.direction;
      leaving_.emplace(Leaving{Rest(of_, piece_, stop, t, numbers), rate, out, t});
      // and so long that what it gains is not lost beside what rotors hold
      const Scalar seen = 16 * epsilon<Scalar> * sizes.momentum();
      for (int trip = 0; trip < 100 && 2 * moment < left && !(leaving_->gained(moment).norm() > seen); ++trip)
        moment *= 2;
      const Scalar until = t + moment < piece_.to ? t + moment : t;
      leaving_->until = until;
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
  std::vector<Scalar> cuts_;
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

}  // namespace detail

}  // namespace gyrostat::general
