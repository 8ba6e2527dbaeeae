// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/general/track.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/rung.hpp"

namespace gyrostat::general {

/// Answers a scene with the cheapest rung whose own error estimate meets the tolerance: those of the families that the scene is exactly an
/// instance of, and the full equations. Where no rung answers, the refusal says why and the answer holds only what was tried.
GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor = nullptr);

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/solve_definition.hpp"
#endif
