// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/spinning/full_rung.hpp"

namespace gyrostat::spinning {

GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  const auto goal = scene.goal();
  if (phase_too_long(scene.problem().phase(question.times.back()), goal.tightest))
    return refused<Track>(Errc::step_limit, phase_lost);
  if (scene.full_equations) return scene.full_equations(scene, monitor);
  Track track;
  track.states.resize(question.times.size());
  FullMotionOptions<double> options;
  options.tolerance = goal.tightest;
  options.wanted = goal.columns.of;
  options.monitor = monitor;
  const auto answer = full_motion<double>(scene.problem(), question.times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  track.error = answer->error;
  track.tilt_error = answer->tilt_error;
  track.counts = answer->counts;
  if (!answer->turns_known) detail::warn_of_gimbal_lock(track, answer->least_cosine);
  return track;
}

}  // namespace gyrostat::spinning
