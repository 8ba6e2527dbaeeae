// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/periodic_motion.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/track.hpp"

namespace gyrostat::heavy {

namespace detail {

/// The full equations from the scene's start, by Taylor series or by those that the scene brings.
/// @param converted body and start come from conversions
GYROSTAT_COMPILED_ONCE Track full_from_start(const Scene& scene, bool converted, Monitor* monitor);

/// From the start that shooting finds, over one period and on.
GYROSTAT_COMPILED_ONCE Track periodic_full(const Scene& scene, Monitor* monitor);

}  // namespace detail

/// Rung `full`: the full equations, by Taylor series or by those that the scene brings; of a periodic motion from the start that shooting finds.
inline Track full_track(const Scene& scene, Monitor* monitor) {
  if (scene.periodic()) return detail::periodic_full(scene, monitor);
  Track track = detail::full_from_start(scene, scene.converts_start(), monitor);
  if (track.failure != Errc::ok) return track;
  warn_of_balance(track, scene);
  if (!(track.error[column::angular_velocity] < 1 && track.error[column::down] < 1))
    track.warn(warning_kinds[warning::rounding_decides], scene.question().times.back());
  return track;
}

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/full_rung_definition.hpp"
#endif
