// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "gyrostat/ladder/general/custom_rung.hpp"

namespace gyrostat::general {

namespace detail {

/// Whether the steps of an explicit method, some 6 over the rate of what settles, are too many.
inline bool settles_too_fast(const Scene& scene) noexcept {
  const double rate = std::max(scene.settling_rate(), scene.sizes().damping);
  return rate * scene.question().times.back() / 6 > double(step_budget);
}

/// The row by which custom_motion() compares what is asked.
inline FullRow<double> driven_row(const Scene& scene) noexcept {
  const Flow<double> flow(scene.problem(), scene.wheels());
  const auto sized = pushed_by(scene.problem(), scene.own_torque()(0, seen_of(flow.state(0, flow.start()))));
  return FullRow<double>(Prepared<double>(sized, scene.question().times.back()), true);
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track full_by_dop853(const Scene& scene, Monitor* monitor) {
  const auto& times = scene.question().times;
  const auto goal = scene.goal();
  Track track = detail::unless_lost(scene);
  if (track.failure != Errc::ok) return track;
  if (detail::settles_too_fast(scene)) return refused<Track>(Errc::step_limit, too_fast_for_dop853);
  const auto row = detail::driven_row(scene);
  const auto wanted = detail::wanted_of(scene, goal, row, false);
  track.states.resize(times.size());
  MotionOptions<double> options;
  options.tolerance = goal.tightest;
  options.wanted = wanted.of;
  options.monitor = monitor;
  const auto& law = scene.own_torque();
  const auto answer = law.any()
                          ? custom_motion<double>(scene.problem(), law, law.breakpoints, times, track.states, options)
                          : custom_motion<double>(scene.problem(), NoTorque{}, {}, times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->fault == LawFault::no_value && law.lost_at != nullptr) *law.lost_at = answer->fault_time;
  if (answer->fault != LawFault::none)
    return refused<Track>(Errc::not_applicable, detail::why_law_failed(answer->fault));
  if (answer->status == ode::Status::event) return refused<Track>(Errc::not_applicable, why_stopped_by_brake);
  if (answer->status == ode::Status::step_limit && law.any()) return refused<Track>(Errc::step_limit, steps_of_law);
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  track.counts = answer->counts;
  track.off = detail::off_of(track, answer->error, row, scene);
  track.compared = detail::compared_of(track, answer->error, row);
  detail::warn_of_law(track, scene);
  return track;
}

GYROSTAT_COMPILED_ONCE Track full_by_any(const Scene& scene, Monitor* monitor) {
  const bool custom = scene.own_torque().any();
  if (custom && scene.question().integrator != Integrator::any) return refused<Track>(Errc::not_applicable, no_series);
  if (scene.full_equations) return scene.full_equations(scene, monitor);
  return custom ? full_by_dop853(scene, monitor) : full_track(scene, monitor);
}

}  // namespace gyrostat::general
