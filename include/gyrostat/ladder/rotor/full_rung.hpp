// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/rotor/track.hpp"

namespace gyrostat::rotor {

/// Rung `full`: the full equations, by the library's own integrators or by those that the scene brings.
GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/full_rung_definition.hpp"
#endif
