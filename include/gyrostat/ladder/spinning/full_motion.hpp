// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
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
  /// false: phi or theta may be off by a turn, for cos(psi) = 0 is passed on a side that the error of the attitude leaves open
  bool turns_known = true;
};

/// The full motion at the given times (s from the start, increasing, the first >= 0). What lies behind a failure is NaN.
///
/// theta is followed turn by turn (spin_angle.hpp); phi stays within pi of its start. The angles tell an attitude as good as that of
/// the quaternion; phi and theta by themselves are as good over cos(psi). Where the motion comes so near to cos(psi) = 0 that the error of
/// the attitude leaves open on which side it passes, or phi so near to the end of its range, turns_known is false.
///
/// The error is estimated by a second run with a step tolerance 64 times looser and data changed by a few roundings, whose distance
/// from the answer is some ten to a hundred times the error of the answer, plus what rounding does that no second run can show.
/// So the estimate is safe rather than sharp. A run that misses the tolerance is repeated with a tighter step tolerance, at most twice.
///
/// Errors: not_increasing (times), not_finite (problem or times), not_positive (inertia, mass), out_of_domain (a span of the wrong
/// length).
template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options = {}) noexcept;

namespace detail {

/// One run: hands (index, state) of every time to the sink, in order.
template <Real Scalar>
class FullRun {
 public:
  using System = FullSystem<Scalar>;
  using Solver = ode::Taylor<System>;
  static constexpr int width = System::width;

  FullRun(const Problem<Scalar>& problem, Scalar step_tolerance, const FullMotionOptions<Scalar>& options,
          double progress_from, double progress_to) noexcept
      : problem_(problem),
        system_(problem),
        angle_(problem),
        step_tolerance_(step_tolerance),
        options_(options),
        progress_from_(progress_from),
        progress_to_(progress_to) {}

  template <class Sink>
  ode::Status operator()(std::span<const Scalar> times, Sink&& sink) noexcept {
    using ode::Status;
    const Scalar end = times.empty() ? Scalar(0) : times.back();
    ode::TaylorOptions<Scalar, width> how;
    how.tolerance = step_tolerance_;
    how.step_cap = options_.step_cap;
    how.scale = system_.scale(end);
    Solver solver(system_, 0, system_.start(), how);

    alignas(32) Scalar x[width];
    const auto sample = [&](const Scalar* numbers) noexcept {
      return
          typename SpinAngle<Scalar>::Sample{system_.angular_velocity(numbers), system_.attitude(numbers), numbers[3]};
    };
    const auto between = [&](Scalar t) noexcept {
      solver.at(t, x, 8);
      return sample(x);
    };
    std::copy(system_.start().begin(), system_.start().end(), x);
    std::size_t next = 0;
    for (; next < times.size() && times[next] <= 0; ++next) hand(next, 0, sample(x), x, sink);

    const Scalar stiffness = std::abs(problem_.gyroscopic()) / std::min(problem_.inertia[0], problem_.inertia[1]);
    Status status = Status::reached;
    std::uint32_t trips = 0;
    while (next < times.size()) {
      const Scalar before = solver.time();
      status = solver.step(end);
      if (status != Status::reached) break;
      const Scalar now = solver.time();
      for (; next < times.size() && times[next] < now; ++next) {
        alignas(32) Scalar y[width];
        solver.at(times[next], y);
        const auto seen = sample(y);
        angle_.follow(times[next], seen, between);
        hand(next, times[next], seen, y, sink);
      }
      const auto seen = sample(solver.state());
      angle_.follow(now, seen, between);
      for (; next < times.size() && times[next] <= now; ++next) hand(next, now, seen, solver.state(), sink);
      phase_ += (now - before) * (2 * seen.angular_velocity.norm() + stiffness);
      swing_ += (now - before) * angular_acceleration<Scalar>(problem_, seen.angular_velocity).norm();
      if ((++trips & 255U) == 0) {
        if (options_.cancelled()) {
          status = Status::cancelled;
          break;
        }
        report(static_cast<double>(now / end));
      }
    }
    counts_ = solver.counts();
    constexpr Scalar none = nan<Scalar>;
    const Vec3<Scalar> nothing = Vec3<Scalar>::Constant(none);
    for (; next < times.size(); ++next)
      sink(next, State<Scalar>{nothing, {none, none, none}, {none, none, none, none}, nothing, nothing, nothing});
    report(1);
    return status;
  }

  const ode::Counts& counts() const noexcept { return counts_; }
  /// Bound of the angle turned through by the body and its nutation up to the last time, rad.
  Scalar phase() const noexcept { return phase_; }
  /// The integral of |omega'|, rad/s.
  Scalar swing() const noexcept { return swing_; }
  /// The angles at the time last handed out, and how near they came to where they jump.
  const SpinAngle<Scalar>& angle() const noexcept { return angle_; }

 private:
  template <class Sink>
  void hand(std::size_t i, Scalar t, const typename SpinAngle<Scalar>::Sample& seen, const Scalar* x,
            Sink& sink) noexcept {
    sink(i, State<Scalar>{seen.angular_velocity, angle_.angles(), seen.attitude,
                          inertial_momentum<Scalar>(problem_, seen.angular_velocity, seen.attitude),
                          system_.velocity(x), system_.position(t, x)});
  }

  void report(double done) const noexcept {
    options_.report(progress_from_ + std::clamp(done, 0.0, 1.0) * (progress_to_ - progress_from_));
  }

  const Problem<Scalar>& problem_;
  System system_;
  SpinAngle<Scalar> angle_;
  Scalar step_tolerance_;
  const FullMotionOptions<Scalar>& options_;
  double progress_from_, progress_to_;
  Scalar phase_ = 0, swing_ = 0;
  ode::Counts counts_;
};

/// The answer's run, the companion's run, and their distance.
template <Real Scalar>
FullMotionAnswer<Scalar> full_motion_with_error(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                                std::span<State<Scalar>> states,
                                                const FullMotionOptions<Scalar>& options, Scalar step_tolerance,
                                                double progress_from, double progress_to) noexcept {
  constexpr Scalar eps = epsilon<Scalar>;
  constexpr auto& how = honesty::spinning_run;
  constexpr Scalar data = Scalar(how.data_change) * eps;
  FullMotionAnswer<Scalar> answer;
  answer.step_tolerance = step_tolerance;
  const double middle = progress_from + 0.55 * (progress_to - progress_from);

  Scalar momentum_size = 0;
  AngleLever<Scalar> lever;
  FullRun<Scalar> run(problem, step_tolerance, options, progress_from, middle);
  answer.status = run(times, [&](std::size_t i, const State<Scalar>& state) noexcept {
    states[i] = state;
    lever.look(run.angle());
    momentum_size = std::max(momentum_size, problem.inertia.cwiseProduct(state.angular_velocity).norm());
  });
  answer.counts = run.counts();
  if (answer.status != ode::Status::reached) return answer;

  // a few roundings away, so that a motion that amplifies the rounding of its data shows it
  Problem<Scalar> near = problem;
  for (const int axis : {0, 1}) {
    const Scalar change = axis == 0 ? 1 + data : 1 - data;
    near.angular_velocity[axis] *= change;
    near.torque[axis] *= change;
  }
  // the stiffness is a difference of terms that may nearly cancel
  near.rotor_momentum *= 1 + data;
  near.charge_momentum *= 1 - data;
  FullRun<Scalar> companion(near, std::max(step_tolerance * Scalar(how.looser), Scalar(how.least_loose) * eps), options,
                            middle, progress_to);
  Comparison comparison(Row<Scalar>{});
  const auto status =
      companion(times, [&](std::size_t i, const State<Scalar>& state) noexcept { comparison.add(states[i], state); });
  answer.counts += companion.counts();
  if (status != ode::Status::reached) {
    answer.status = status;
    return answer;
  }

  constexpr Scalar margin = Scalar(how.margin);
  // Rounding in every step adds up like a random walk, which the second run may miss by chance.
  const Scalar walk = 2 * eps * std::sqrt(static_cast<Scalar>(run.counts().steps));
  // What both runs share: the polynomial of a step that both take, good to the step tolerance; and the rounding of the data on their
  // way into the recurrences, a relative change of all rates by about a rounding, which turns the phase.
  const Scalar rounding = 8 * eps + walk + 2 * step_tolerance;
  const auto& apart = comparison.difference();
  const auto& size = comparison.size();
  // what a column is rounded in, and what the phase adds
  ColumnErrors<Scalar> parts = size, turned;
  parts[column::attitude] = 4;
  parts[column::angular_momentum_inertial] = momentum_size + std::abs(problem.rotor_momentum);
  parts[column::position] += problem.position.norm();
  turned[column::angular_velocity] = run.swing();
  turned[column::attitude] = run.phase();
  turned[column::angular_momentum_inertial] =
      run.phase() * size[column::angular_momentum_inertial] + run.swing() * problem.inertia.maxCoeff();
  ColumnErrors<Scalar> error = margin * apart + rounding * parts + eps * turned;
  const Scalar attitude = error[column::attitude];
  error[column::euler_312] = angles_error<Scalar>(attitude, states);
  answer.least_cosine = lever.least_cosine();
  answer.turns_known = !lever.loses_turns(attitude);
  answer.error = comparison.relative(error);
  answer.met = answer.error.greatest() <= options.tolerance;
  return answer;
}

}  // namespace detail

template <Real Scalar>
Result<FullMotionAnswer<Scalar>> full_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                             std::span<State<Scalar>> states,
                                             const FullMotionOptions<Scalar>& options) noexcept {
  if (states.size() != times.size()) return Errc::out_of_domain;
  if (const Errc wrong = check_span(times); wrong != Errc::ok) return wrong;
  const auto finite = [](const auto& v) noexcept { return (v - v).isZero(0); };
  const auto& a = problem.angles;
  if (!finite(problem.inertia) || !finite(problem.torque) || !finite(problem.force) ||
      !finite(problem.angular_velocity) || !finite(problem.velocity) || !finite(problem.position) ||
      !finite(Vec3<Scalar>(a.psi, a.phi, a.theta)) ||
      !finite(Vec3<Scalar>(problem.mass, problem.rotor_momentum, problem.charge_momentum)) ||
      !(options.tolerance == options.tolerance))
    return Errc::not_finite;
  if (!(problem.inertia.minCoeff() > 0) || !(problem.mass > 0)) return Errc::not_positive;

  // First guess of the step tolerance. The error of the rates grows with the number of turns, that of the phase with its square.
  const Scalar span = times.empty() ? Scalar(0) : times.back();
  const Scalar phase = span * (problem.angular_velocity.norm() +
                               std::abs(problem.gyroscopic()) / std::min(problem.inertia[0], problem.inertia[1]));
  constexpr Scalar finest = finest_step_tolerance<Scalar>;
  Scalar step_tolerance = options.tolerance / 64 / (4 + Scalar(2e-4L) * phase * phase);
  step_tolerance = std::clamp(step_tolerance, finest, Scalar(1e-8L));
  if (!(step_tolerance >= finest)) step_tolerance = finest;

  return tightened<Scalar>(options, step_tolerance, [&](Scalar tolerance, Scalar, double begin, double end) noexcept {
    return detail::full_motion_with_error<Scalar>(problem, times, states, options, tolerance, begin, end);
  });
}

#if defined(GYROSTAT_COMPILED)
extern template Result<FullMotionAnswer<double>> full_motion<double>(const Problem<double>&, std::span<const double>,
                                                                     std::span<State<double>>,
                                                                     const FullMotionOptions<double>&) noexcept;
#endif

}  // namespace gyrostat::spinning
