// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"

namespace gyrostat::deceleration {

namespace detail {

GYROSTAT_COMPILED_ONCE State<double> state_on_orbit(const Problem<double>& problem, const Vec3<double>& M) noexcept {
  State<double> state = state_of(problem, M, {});
  const OrbitKind kind = orbit_kind(problem, M);
  state.k2 = kind.k2;
  state.regime = kind.regime;
  return state;
}

/// Error of the modulus, where |M| and the energy are known to the track's errors, or to these in each part of k2_stride points, which tell of
/// orbit_place, too. It is greatest where |M| is least: at the begin of a part, if it grows, at its end, or just before the stop.
inline double k2_error(const Track& track, const Problem<double>& problem,
                       std::span<const ColumnErrors<double>> errors) noexcept {
  double most = 0;
  const auto& states = track.states;
  const std::size_t n = states.size(), stride = k2_stride(n);
  std::size_t moving = n;  // states behind it are that of rest
  while (moving > 1 && states[moving - 1].momentum == states[n - 1].momentum) --moving;
  const auto look = [&](std::size_t i) noexcept {
    const ColumnErrors<double>& error = errors.empty() ? track.error : errors[i / stride];
    const double place = errors.empty() ? infinity<double> : error[column::modulus_squared];
    most = std::max(most, k2_uncertainty(problem, states[i].momentum, {states[i].regime, states[i].k2},
                                         error[column::angular_momentum_norm], error[column::energy], place));
  };
  for (std::size_t first = 0; first < n; first += stride) {
    const std::size_t last = std::min(first + stride, n) - 1;
    look(first);
    if (last > first) look(last);
    if (moving > first && moving - 1 < last && moving - 1 > first) look(moving - 1);
  }
  return most;
}

/// By how much the modulus may change at the stop: a body that turns about a principal axis to the last digit does so until then, others may do
/// anything on the way.
inline double k2_before_rest(const Track& track, const Problem<double>& problem) noexcept {
  const bool on_axis =
      problem.exact_moments && problem.rotor_momentum.isZero(0) && (problem.momentum.array() != 0).count() == 1;
  double most = track.error[column::modulus_squared];
  for (const auto& state : track.states) most = std::max(most, state.k2);
  return on_axis ? most : 1;
}

GYROSTAT_COMPILED_ONCE bool doubt_modulus_at_stop(Track& track, const Problem<double>& problem,
                                                  std::span<const double> times) noexcept {
  const bool any = std::any_of(times.begin(), times.end(), [&](double t) { return track.may_be_at_stop(t); });
  if (any) track.error[column::modulus_squared] = k2_before_rest(track, problem);
  return any;
}

GYROSTAT_COMPILED_ONCE Track track_of(const Problem<double>& problem, std::vector<State<double>> states,
                                      bool knows_attitude, const ColumnErrors<double>& error,
                                      std::span<const ColumnErrors<double>> errors) {
  Track track;
  track.knows_momentum = true;
  track.knows_attitude = knows_attitude;
  track.states = std::move(states);
  Comparison sizes(Row<double>{problem});
  for (State<double>& state : track.states) {
    const OrbitKind kind = orbit_kind(problem, state.momentum);
    state.k2 = kind.k2;
    state.regime = kind.regime;
    sizes.add(state);
  }
  track.error = sizes.absolute(error);
  track.error[column::modulus_squared] = k2_error(track, problem, errors);
  return track;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track full_motion_track(const Problem<double>& problem, std::span<const double> times,
                                               double tolerance, std::span<const double> wanted, bool find_stop,
                                               const Quat<double>* attitude, Monitor* monitor) {
  std::vector<State<double>> states(times.size());
  FullMotionOptions<double> options;
  options.tolerance = tolerance;
  options.wanted = wanted;
  options.find_stop = find_stop;
  std::array<ColumnErrors<double>, detail::k2_looks + 1> errors{};
  options.errors = errors;
  options.stride = detail::k2_stride(times.size());
  options.monitor = monitor;
  const auto answer = full_motion<double>(problem, times, states, options, attitude);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  Track track = detail::track_of(problem, std::move(states), attitude != nullptr, answer->error, errors);
  track.counts = answer->counts;
  track.stop_time = answer->stop_time;
  track.stop_error = answer->stop_error;
  if (std::isnan(track.stop_error) && std::isfinite(track.stop_time)) track.stop_error = infinity<double>;
  if (find_stop && std::isnan(track.stop_time)) track.warn(warning::stop_unknown);
  detail::doubt_modulus_at_stop(track, problem, times);
  return track;
}

namespace detail {

GYROSTAT_COMPILED_ONCE void warn_of_stop_withheld(Track& track, const Scene& scene, const char* text) {
  const auto& problem = scene.problem();
  const bool alone = scene.greatest_control() > 0 && !(Hold<double>(problem).weakest > 0);
  if (alone)
    text =
        AxesLeftAlone<double>(problem).any()
            ? "the control leaves an axis alone, about which the body may turn on for ever; ask for stop_time by name "
              "to have the stop looked for"
            : "the control leaves an axis alone, about which the body may turn on for ever: no stop is looked for";
  track.warn(warning::stop_withheld, nan<double>, text);
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE double turned_angle(const Scene& scene, bool to_stop) noexcept {
  const auto& problem = scene.problem();
  const FullCoefficients<double> f(problem);
  const double size = (problem.momentum - f.offset).norm(), b = scene.greatest_control();
  const double stop = EqualTorqueLaw(b, problem.drag, size).stop_time();
  const double last = scene.question().times.back();
  const double span = to_stop && stop < infinity<double> ? stop : std::min(last, stop);
  const double mean = size / (1 + problem.drag * span);
  const double own = scene.question().wants_attitude ? problem.inverse_inertia[0] : f.quadratic.cwiseAbs().maxCoeff();
  return span * (own * mean + problem.gyro_rate().norm()) / 2;
}

GYROSTAT_COMPILED_ONCE bool goes_to_stop(const Scene& scene) noexcept {
  if (!scene.asks_for_stop()) return false;
  if (scene.needs_stop()) return true;
  const auto& problem = scene.problem();
  const double longest = scene.opposed().norm() / scene.least_control();
  // what the greatest control holds still is stiff to the end, where the least alone brakes, but in the plainest case
  constexpr double stiff = 1e3;
  if (scene.greatest_control() > stiff * scene.least_control() && (scene.has_rotor() || !problem.control.isDiagonal(0)))
    return false;
  return (longest <= 20 * scene.question().times.back() && turned_angle(scene, true) <= unreachable_angle) ||
         longest * problem.inverse_inertia[2] * problem.momentum.norm() < 1e4;
}

GYROSTAT_COMPILED_ONCE const char* not_worth(const Scene& scene, const Goal<std::size(column_kinds)>& goal) noexcept {
  const double phase = goal.tightest_of(fast_columns);
  if (phase < infinity<double> && phase_too_long(turned_angle(scene, false), phase)) return phase_lost;
  return turned_angle(scene, goes_to_stop(scene)) > unreachable_angle
             ? "the body turns so often that the budget of 10 million steps would end before the last time: ask for a "
               "shorter span"
             : nullptr;
}

GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor) {
  if (scene.full_equations) return scene.full_equations(scene, monitor);
  const auto& question = scene.question();
  const auto& problem = scene.problem();
  const auto goal = scene.goal();
  if (const char* why = not_worth(scene, goal)) return refused<Track>(Errc::step_limit, why);
  const bool find_stop = goes_to_stop(scene);
  const Quat<double> q_IP = scene.attitude();
  const auto at_tolerance = [&](double tolerance) {
    return full_motion_track(problem, question.times, tolerance, goal.columns.of, find_stop,
                             question.wants_attitude ? &q_IP : nullptr, monitor);
  };
  double tolerance = goal.tightest;
  Track track = at_tolerance(tolerance);
  // The modulus and the stop may need more digits of M than M itself was asked for.
  const bool stop_counts = scene.needs_stop() || (scene.asks_for_stop() && track.stop_time <= question.times.back());
  for (int trial = 0; trial < 3 && track.failure == Errc::ok; ++trial) {
    const double of_modulus = track.error[column::modulus_squared] / goal.columns[column::modulus_squared];
    const double excess = 4 * std::max(of_modulus, stop_counts ? track.stop_error / goal.tightest : 0.0);
    if (!(excess > 4) || excess > honesty::retry_excess || tolerance <= 1e-13) break;
    tolerance = std::max(1e-13, tolerance / excess);
    Track finer = at_tolerance(tolerance);
    finer.counts += track.counts;
    track = std::move(finer);
  }
  if (!find_stop && scene.asks_for_stop() && std::isnan(track.stop_time))
    detail::warn_of_stop_withheld(
        track, scene,
        "the stop lies far behind the times asked for, and the full equations are not followed to it; ask for "
        "times up to it, or for stop_time by name");
  return track;
}

}  // namespace gyrostat::deceleration
