// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/models/rotor/relaxing.hpp"
#include "gyrostat/ode/radau.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/ode/taylor.hpp"

/// The full motion of a gyrostat with a motor of limited power: Taylor series, or collocation where the motor is stiff.
namespace gyrostat::rotor {

template <Real Scalar>
struct FullMotionOptions : MotionOptions<Scalar> {
  Integrator integrator = Integrator::any;
};

template <Real Scalar>
struct FullMotionAnswer : MotionOutcome<std::size(column_kinds), Scalar> {
  Integrator used = Integrator::taylor;  ///< radau: but for the first moments, while the motor comes to its balance
};

/// How fast the body turns or could soon turn, a bound of the order of |Omega|, rad/s.
template <Real Scalar>
Scalar turning_rate(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& state) noexcept {
  const Scalar wheel = std::max(std::abs(state.axial_momentum), std::abs(gyrostat.target_momentum()));
  return state.momentum.norm() / gyrostat.free_principal()[0] +
         wheel * (gyrostat.free_inverse() * gyrostat.axis()).norm();
}

/// Whether the motor relaxes so much faster than the body turns that Taylor steps, which cannot be longer than about 8 over the
/// relaxation rate, cost more than collocation.
template <Real Scalar>
bool is_stiff(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& state) noexcept {
  const Scalar turning = turning_rate(gyrostat, state);
  return turning > 0 && gyrostat.relaxation_rate() > 30 * turning;
}

/// The full motion from `start` at t = 0 at the given times (s, increasing, the first >= 0). What lies behind a failure is NaN.
///
/// The error is estimated by runs of neighbours: body and start differ by a few roundings, and the steps have a tighter tolerance
/// (companions.hpp). Their distance from the answer, watched in every step and kept for some twenty turns, is the error of the answer,
/// and shows what the motion makes of errors: that phases drift, and that all differences grow where it leaves an unstable rotation. A run
/// that misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: not_increasing (times), not_finite (start, times or tolerance), out_of_domain (the spans differ in length), zero_vector
/// (an attitude without length).
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start,
                                             std::span<const Scalar> times, std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {}) noexcept;

namespace detail {

/// One run of the equations, by Taylor series up to the time `layer` and by collocation behind it.
template <Real Scalar>
class Course {
  using Series = ode::Taylor<FullSystem<Scalar>>;
  using Collocation = ode::Radau<RelaxingRotor<Scalar>>;

 public:
  static constexpr bool goes_on_alike = true;

  /// inside: what collocation may err between its steps. pace: RadauOptions::pace.
  Course(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, Scalar layer, Scalar tolerance, Scalar inside,
         std::uint64_t step_cap, Scalar pace) noexcept
      : layer_(layer),
        full_(gyrostat, start),
        relaxing_(gyrostat, start),
        series_(full_, 0, full_.start(), series_options(full_, tolerance, step_cap)),
        collocation_options_(collocation_options(gyrostat, start, tolerance, inside, step_cap, pace)),
        collocation_(relaxing_, 0, relaxing_.components(start), collocation_options_),
        collocates_(!(layer > 0)) {}

  /// One step, at most up to t_max.
  ode::Status step(Scalar t_max) noexcept {
    if (!collocates_ && series_.time() >= layer_) {
      collocates_ = true;
      const State<Scalar> now = full_.state(series_.time(), series_.state());
      std::construct_at(&collocation_, relaxing_, series_.time(), relaxing_.components(now), collocation_options_);
    }
    return collocates_ ? collocation_.step(t_max) : series_.step(std::min(t_max, layer_));
  }

  Scalar time() const noexcept { return collocates_ ? collocation_.time() : series_.time(); }

  /// The state at t in the last step.
  State<Scalar> at(Scalar t) const noexcept {
    alignas(32) Scalar x[FullSystem<Scalar>::width];
    if (collocates_) {
      collocation_.at(t, x);
      return relaxing_.state(x);
    }
    series_.at(t, x);
    return full_.state(t, x);
  }
  /// at(t) with the error between steps of collocation that its last coefficients let suspect.
  State<Scalar> beside(Scalar t) const noexcept {
    if (!collocates_) return at(t);
    alignas(32) Scalar x[FullSystem<Scalar>::width];
    collocation_.beside(t, x);
    return relaxing_.state(x);
  }

  /// Moves the state by about `amount` of itself; by collocation not.
  void kick(Scalar amount) noexcept { series_.kick(amount); }

  ode::Counts counts() const noexcept {
    ode::Counts both = series_.counts();
    both += collocation_.counts();
    return both;
  }

 private:
  static auto series_options(const FullSystem<Scalar>& system, Scalar tolerance, std::uint64_t step_cap) noexcept {
    typename Series::Options options;
    options.tolerance = tolerance;
    options.scale = system.scale();
    options.step_cap = step_cap;
    return options;
  }
  static auto collocation_options(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, Scalar tolerance,
                                  Scalar inside, std::uint64_t step_cap, Scalar pace) noexcept {
    typename Collocation::Options options;
    options.tolerance = tolerance;
    options.inside = inside;
    options.pace = pace;
    options.scale = RelaxingRotor<Scalar>::scale(gyrostat, start);
    options.step_cap = step_cap;
    return options;
  }

  Scalar layer_;
  FullSystem<Scalar> full_;
  RelaxingRotor<Scalar> relaxing_;
  Series series_;
  typename Collocation::Options collocation_options_;
  Collocation collocation_;
  bool collocates_;
};

/// A body and a start that differ from the given ones by about `amount`: by what rounding makes of the data.
template <Real Scalar>
struct Neighbour {
  Gyrostat<Scalar> gyrostat;
  State<Scalar> start;

  Neighbour(const Gyrostat<Scalar>& of, const State<Scalar>& from, Scalar amount, Aside aside) noexcept
      : gyrostat(of), start(from) {
    const Mat3<Scalar> inertia = of.inertia() + amount * of.principal()[2] * tensor_shifts<Scalar>(aside);
    const Vec3<Scalar> shift = amount * neighbour_direction<Scalar>(aside);
    const Scalar by = aside == Aside::first ? amount : -amount;
    const auto moved =
        Gyrostat<Scalar>::make(inertia, of.axis() + cross<Scalar>(shift, of.axis()), of.axial_inertia() * (1 + by),
                               of.slope() * (1 - by), of.no_load_rate() * (1 + by));
    if (moved) gyrostat = *moved;

    const Vec3<Scalar> Omega = of.angular_velocity(from.momentum, from.axial_momentum);
    const Scalar omega = of.rotor_rate(from.axial_momentum, Omega);
    const Scalar lambda = of.axial_inertia();
    // what cancels in H, and in the product with the tensor of a slim body; a momentum that is exactly 0 stays so
    const Scalar parts = (of.inertia().cwiseAbs() * Omega.cwiseAbs()).norm() + lambda * std::abs(omega);
    if (!from.momentum.isZero(0)) {
      const auto leaving = leaving_direction<Scalar>(from.momentum, Omega, of.free_inverse());
      start.momentum += parts * shift + leaving_shift(leaving, parts, amount, aside);
    }
    start.axial_momentum += by * lambda * (std::abs(omega) + Omega.norm());
  }
};

/// Factor by which a change of the start counts more where it is next to a steady rotation, or less near to one that is unstable with its wheel free or
/// locked: the motion may linger, and how far off it began decides when it leaves. 1 elsewhere.
template <Real Scalar>
Scalar start_sensitivity(const Gyrostat<Scalar>& body, const State<Scalar>& start) noexcept {
  const Vec3<Scalar> Omega = body.angular_velocity(start.momentum, start.axial_momentum);
  const Scalar whole = Omega.norm() * start.momentum.norm(), across = cross<Scalar>(Omega, start.momentum).norm();
  const auto unstable = [&](const Mat3<Scalar>& inverse) noexcept {
    return gyrostat::start_sensitivity<Scalar>(start.momentum, Omega, inverse);
  };
  const Scalar steady =
      across < Scalar(honesty::next_to_steady) * whole ? Scalar(honesty::steady_condition) : Scalar(1);
  return std::max({steady, unstable(body.free_inverse()), unstable(body.inertia().inverse())});
}

/// What errors leave unknown where the runs have parted (honesty::parted_lyapunov, parted_margin).
template <Real Scalar>
void forget_parted(ColumnErrors<Scalar>& error) noexcept {
  if (!(error[column::angular_velocity] >= 1)) return;
  if (error[column::lyapunov] > Scalar(honesty::parted_lyapunov)) error[column::lyapunov] = infinity<Scalar>;
  for (const auto c : {column::rotor_rate, column::rotor_angle, column::lyapunov})
    error[c] *= Scalar(honesty::parted_margin);
}

/// How far the states have gone from a steady rotation in which the motion starts, but for some roundings, and which lasts while the motor works: the
/// greatest change of the momentum in body axes over its size; 0 where it does not start in one.
template <Real Scalar>
Scalar departure_from_steady(const Gyrostat<Scalar>& body, const State<Scalar>& start,
                             std::span<const State<Scalar>> states) noexcept {
  const Vec3<Scalar>& M = start.momentum;
  const Vec3<Scalar> Omega = body.angular_velocity(M, start.axial_momentum), pull = body.free_inverse() * body.axis();
  const Scalar rounding = Scalar(honesty::steady_roundings) * epsilon<Scalar> * body.condition(), size = M.norm();
  const auto is_along = [&](const Vec3<Scalar>& v) noexcept {
    return cross<Scalar>(v, M).norm() <= rounding * v.norm() * size;
  };
  const Scalar slip = body.no_load_rate() - body.rotor_rate(start.axial_momentum, Omega);
  const bool lasts = is_along(pull) || body.slope() * slip == 0;
  if (!lasts || !is_along(Omega)) return 0;
  Scalar most = 0;
  for (const State<Scalar>& s : states) most = greater(most, over((s.momentum - M).norm(), size));
  return most;
}

/// What such a departure makes of the errors. It is an error itself, as only digits behind those of the data say when the motion leaves, if ever; the other
/// columns err in proportion. Where it has grown nothing is known: all runs leave by their roundings, and where they settle they are near each other.
template <Real Scalar>
void count_departure(ColumnErrors<Scalar>& error, Scalar departure) noexcept {
  if (departure > Scalar(honesty::left_steady)) error = ColumnErrors<Scalar>::all(infinity<Scalar>);
  const Scalar known = error[column::angular_momentum];
  if (2 * departure > known && known > 0) error *= 2 * departure / known;
}

/// What an evaluation of the columns loses, in their units, where the state is known to `relative`, and what one rounding of the tensor
/// makes of the angles in `span`, s: the companions may be blind to it.
template <Real Scalar>
ColumnErrors<Scalar> rounding_of_columns(const Row<Scalar>& row, const State<Scalar>& start,
                                         const ColumnErrors<Scalar>& size, Scalar relative, Scalar span) noexcept {
  const Gyrostat<Scalar>& gyrostat = row.body;
  const Scalar lambda = gyrostat.axial_inertia(), k = gyrostat.coupling();
  const Scalar H = start.momentum.norm(), wheel = std::abs(start.axial_momentum) + std::abs(gyrostat.target_momentum());
  const Scalar fastest = 1 / gyrostat.free_principal()[0];
  const Scalar p = relative * (wheel + std::min(H, lambda * fastest * H));
  const Scalar pull = (gyrostat.free_inverse() * gyrostat.axis()).norm();
  ColumnErrors<Scalar> error;
  const Vec3<Scalar> Omega = gyrostat.angular_velocity(start.momentum, start.axial_momentum);
  const Scalar turned = epsilon<Scalar> * gyrostat.condition() * size[column::angular_velocity] * span;
  const Scalar whole = H * Omega.norm(), across = cross<Scalar>(start.momentum, Omega).norm();
  const Scalar swung =
      whole > 0 ? turned * (across / whole) : Scalar(0);  // of H in body axes: not in a steady rotation
  // a momentum that cancels to rounding was taken for none, and turns the body for ever
  const Scalar left =
      H > 0 ? Scalar(0)
            : gyrostat.lost_momentum(gyrostat.inertia() * Omega, gyrostat.rotor_rate(start.axial_momentum, Omega));
  error[column::attitude] = 4 * relative + turned + left * fastest * span;
  error[column::angular_momentum] =
      (4 * relative + swung) * H + 4 * relative * row.scale[column::angular_momentum] + left;
  error[column::angular_velocity] =
      2 * relative * H * fastest + 2 * p * pull + swung * size[column::angular_velocity] + left * fastest;
  error[column::rotor_rate] = 2 * relative * H * pull + 2 * p / (lambda * k);
  error[column::rotor_angle] = 4 * relative * size[column::rotor_angle];
  // put together from two terms that may cancel while the motor is far from no load
  if (size[column::rotor_angle] > 0)
    error[column::rotor_angle] += turned + epsilon<Scalar> * std::abs(gyrostat.no_load_rate()) * span;
  // of the polynomial of one step, too; an angle that never left zero has not been integrated
  const Scalar turning = turning_rate(gyrostat, start);
  if (turning > 0 && size[column::rotor_angle] > 0) error[column::rotor_angle] += error[column::rotor_rate] / turning;
  // V is a sum of squares
  const Scalar root = 2 * relative * (H + wheel) / std::sqrt(gyrostat.principal()[0]) +
                      std::sqrt(lambda * k / 2) * error[column::rotor_rate];
  error[column::lyapunov] = std::sqrt(2 * size[column::lyapunov]) * root + root * root;
  if (const Scalar condition = gyrostat.condition(); condition > 1) {
    const Scalar blur = 4 * epsilon<Scalar> * condition;
    error[column::angular_momentum] += 4 * epsilon<Scalar> * gyrostat.momentum_blur(Omega);
    error[column::angular_velocity] += blur * size[column::angular_velocity];
    error[column::rotor_rate] += blur * size[column::angular_velocity];
    error[column::lyapunov] += blur * size[column::lyapunov];
  }
  return error;
}

template <Real Scalar>
class FullMotion {
 public:
  FullMotion(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, std::span<const Scalar> times,
             std::span<State<Scalar>> states, const FullMotionOptions<Scalar>& options) noexcept
      : gyrostat_(gyrostat),
        start_(start),
        times_(times),
        states_(states),
        options_(options),
        turning_(turning_rate(gyrostat, start)),
        condition_{gyrostat.condition(), start_sensitivity(gyrostat, start)} {
    const bool stiff = is_stiff(gyrostat, start);
    const bool collocates = options.integrator == Integrator::radau || (options.integrator == Integrator::any && stiff);
    // behind 40 relaxation times the motor has forgotten where it began
    layer_ = !collocates ? infinity<Scalar> : stiff ? 40 / gyrostat.relaxation_rate() : Scalar(0);
  }

  /// The answer's run and its neighbours' side by side, and their distance. inside: what collocation may err between its steps.
  FullMotionAnswer<Scalar> run(Scalar step_tolerance, Scalar inside, double progress_from,
                               double progress_to) const noexcept {
    FullMotionAnswer<Scalar> answer;
    answer.step_tolerance = step_tolerance;
    answer.used = layer_ < times_.back() ? Integrator::radau : Integrator::taylor;
    Course<Scalar> course(gyrostat_, start_, layer_, step_tolerance, inside, options_.step_cap, Scalar(1));
    const Scalar change = data_change(step_tolerance, condition_);
    const auto beside = [&](Aside aside) noexcept {
      const Neighbour<Scalar> neighbour(gyrostat_, start_, change, aside);
      return Course<Scalar>(neighbour.gyrostat, neighbour.start, layer_, companion_step(step_tolerance),
                            companion_step(inside), options_.step_cap, Scalar(honesty::companion_pace));
    };
    Course<Scalar> companion = beside(Aside::first);
    std::optional<Course<Scalar>> second;
    if (rounding_rules(step_tolerance, condition_)) second = beside(second_aside(condition_));
    // rounding at the asked times, and between steps
    const Row<Scalar> row(gyrostat_, start_);
    ColumnErrors<Scalar> between;
    const auto rounding = [&](const ColumnErrors<Scalar>& size, Scalar steps) noexcept {
      return rounding_of_columns(row, start_, size, shared_rounding(steps), times_.back()) +
             Scalar(honesty::margin_between) * between;
    };
    const Comparison<Row<Scalar>> rows(row);
    const auto note = [&](std::size_t i, const auto&) noexcept {
      if (answer.used == Integrator::radau)
        between.raise(rows.apart(rows.row(companion.at(times_[i])), rows.row(companion.beside(times_[i]))));
    };
    solve_beside(answer, row, Runs<Course<Scalar>>{course, companion, second ? &*second : nullptr},
                 {start_, times_, states_, nowhere(), progress_from, progress_to}, options_, rounding, note);
    forget_parted(answer.error);
    count_departure(answer.error, departure_from_steady<Scalar>(gyrostat_, start_, states_));
    answer.met = answer.met && options_.excess(answer) <= 1;
    return answer;
  }

  /// The angle turned through up to the last time, to its order, rad.
  Scalar phase() const noexcept { return turning_ * times_.back(); }

 private:
  static State<Scalar> nowhere() noexcept {
    constexpr Scalar no = nan<Scalar>;
    return {{no, no, no, no}, {no, no, no}, no, no};
  }

  const Gyrostat<Scalar>& gyrostat_;
  State<Scalar> start_;
  std::span<const Scalar> times_;
  std::span<State<Scalar>> states_;
  const FullMotionOptions<Scalar>& options_;
  Scalar turning_, layer_;
  Condition<Scalar> condition_;
};

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start,
                                             std::span<const Scalar> times, std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options) noexcept {
  if (const Errc wrong = options.check(times, states.size(), std::size(column_kinds)); wrong != Errc::ok) return wrong;
  const Scalar length = norm(start.attitude);
  if (!(length < infinity<Scalar>) || !start.momentum.allFinite() || !std::isfinite(start.axial_momentum) ||
      !std::isfinite(start.rotor_angle))
    return Errc::not_finite;
  if (!(length > 0)) return Errc::zero_vector;
  FullMotionAnswer<Scalar> answer;
  answer.met = true;
  if (times.empty()) return answer;

  State<Scalar> from = start;
  from.attitude = as_unit(start.attitude);
  const detail::FullMotion<Scalar> motion(gyrostat, from, times, states, options);
  const Scalar first =
      first_step_tolerance_of_phase<Scalar>(options.tolerance, motion.phase(), Scalar(honesty::loosest_step));
  Scalar inside = options.tolerance / 512;
  return tightened<Scalar>(options, first, [&](Scalar step_tolerance, Scalar by, double begin, double end) noexcept {
    inside = std::max(step_tolerance, inside / by);
    return motion.run(step_tolerance, inside, begin, end);
  });
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Gyrostat<double>&, const State<double>&,
                                                                     std::span<const double>, std::span<State<double>>,
                                                                     const FullMotionOptions<double>&) noexcept;
#endif

}  // namespace gyrostat::rotor
