// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include "gyrostat/ladder/spinning/picard_rung.hpp"

namespace gyrostat::spinning {

GYROSTAT_COMPILED_ONCE Track picard_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  if (question.rung != rung::picard)
    return refused<Track>(Errc::not_applicable, "the full equations cost less; ask for it by name");
  Track track;
  track.states.resize(question.times.size());
  const auto scale = scales(scene.problem(), question.times.back());
  bool converges = false;
  for (const int sweeps : {2, 4, 8}) {
    if (monitor && monitor->cancelled()) return refused<Track>(Errc::cancelled, message(Errc::cancelled));
    const auto made = picard_motion<double>(scene.problem(), question.times, track.states, {sweeps, 100'000});
    if (!made) {
      switch (made.error()) {
        case Errc::not_applicable: return refused<Track>(Errc::not_applicable, "a torque acts about the spin axis");
        case Errc::step_limit:
          return refused<Track>(Errc::step_limit,
                                "more than 100 000 panels of three radians: too many turns for sweeps");
        case Errc::no_convergence: return refused<Track>(Errc::no_convergence, "the axis tilts beyond a right angle");
        default: return refused<Track>(made.error(), message(made.error()));
      }
    }
    track.counts.rhs += made->nodes;
    converges = made->converges;
    if (!converges) continue;  // a linear motion with a small error by chance looks so to two sweeps
    const auto error = made->error.all(), size = made->size.all();
    for (std::size_t i = 0; i < error.size(); ++i) track.error[i] = over(error[i], std::max(size[i], scale[i]));
    track.error[column::euler_312] = angles_error<double>(track.error[column::attitude], track.states);
    if (scene.goal().excess(track.error) <= 1) break;
  }
  if (!converges)
    return refused<Track>(Errc::no_convergence, "the sweeps do not converge: the tilt is too large for so many turns");
  return track;
}

}  // namespace gyrostat::spinning
