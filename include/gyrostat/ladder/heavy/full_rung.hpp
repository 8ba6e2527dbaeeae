// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/track.hpp"

namespace gyrostat::heavy {

/// Rung `full`: the full equations, by Taylor series or by what the question names.
inline Track full_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  if (question.full_equations) return question.full_equations(scene, monitor);
  Track track;
  track.states.resize(question.times.size());
  FullMotionOptions<double> options;
  options.tolerance = question.tolerance;
  options.attitude = question.wants_attitude;
  if (monitor) options.progress = &monitor->fraction, options.cancel = &monitor->cancel;
  const auto answer = full_motion<double>(scene.problem(), scene.start(), question.times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status == ode::Status::cancelled) return refused<Track>(Errc::cancelled, message(Errc::cancelled));
  if (answer->status != ode::Status::reached)
    return refused<Track>(answer->status == ode::Status::step_limit ? Errc::step_limit : Errc::no_convergence,
                          ode::message(answer->status));
  track.error = answer->error;
  track.counts = answer->counts;
  return track;
}

}  // namespace gyrostat::heavy
