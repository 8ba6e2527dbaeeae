// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/ladder/spinning/track.hpp"

namespace gyrostat::spinning {

namespace detail {

inline void warn_of_gimbal_lock(Track& track, double least_cosine) {
  track.warn(warning_kinds[warning::gimbal_lock], least_cosine);
}

}  // namespace detail

/// Rung `full`: the full equations, by Taylor series or by what the scene brings.
GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/full_rung_definition.hpp"
#endif
