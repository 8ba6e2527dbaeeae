// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/rotor/full_rung.hpp"

namespace gyrostat::rotor {

GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  const auto goal = scene.goal();
  if (scene.full_equations) return scene.full_equations(scene, monitor);
  if (phase_too_long(turning_rate(scene.gyrostat(), scene.start()) * question.times.back(), goal.tightest))
    return refused<Track>(Errc::step_limit, phase_lost);
  Track track;
  track.states.resize(question.times.size());
  FullMotionOptions<double> options;
  options.tolerance = goal.tightest;
  options.wanted = goal.columns.of;
  options.integrator = question.integrator;
  options.monitor = monitor;
  const auto answer = full_motion<double>(scene.gyrostat(), scene.start(), question.times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  track.error = answer->error;
  track.counts = answer->counts;
  return track;
}

}  // namespace gyrostat::rotor
