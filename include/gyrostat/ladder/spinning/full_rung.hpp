// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/ladder/spinning/track.hpp"

namespace gyrostat::spinning {

namespace detail {

inline void warn_of_gimbal_lock(Track& track, double least_cosine) {
  track.warn("gimbal-lock", "the motion passes so near to cos(psi) = 0 that theta is known but for a turn",
             least_cosine);
}

}  // namespace detail

/// Rung `full`: the full equations, by Taylor series or by what the question names.
inline Track full_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  if (question.full_equations) return question.full_equations(scene, monitor);
  Track track;
  track.states.resize(question.times.size());
  FullMotionOptions<double> options;
  options.tolerance = question.tolerance;
  if (monitor) options.progress = &monitor->fraction, options.cancel = &monitor->cancel;
  const auto answer = full_motion<double>(scene.problem(), question.times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), ode::message(answer->status));
  track.error = answer->error;
  track.counts = answer->counts;
  if (!answer->turns_known) detail::warn_of_gimbal_lock(track, answer->least_cosine);
  return track;
}

}  // namespace gyrostat::spinning
