// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/rotor/track.hpp"

namespace gyrostat::rotor {

/// Rung `full`: the full equations, by the library's own integrators or by those that the scene brings.
inline Track full_track(const Scene& scene, Monitor* monitor) {
  const auto& data = scene.data();
  if (data.full_equations) return data.full_equations(scene, monitor);
  Track track;
  track.states.resize(data.times.size());
  FullMotionOptions<double> options;
  options.tolerance = data.tolerance;
  options.integrator = data.integrator;
  if (monitor) options.progress = &monitor->fraction, options.cancel = &monitor->cancel;
  const auto answer = full_motion<double>(scene.gyrostat(), scene.start(), data.times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), ode::message(answer->status));
  track.error = answer->error;
  track.counts = answer->counts;
  return track;
}

}  // namespace gyrostat::rotor
