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
  return scene.periodic() ? detail::periodic_full(scene, monitor)
                          : detail::full_from_start(scene, scene.converts_start(), monitor);
}

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/full_rung_definition.hpp"
#endif
