// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/free/closed_form_rung.hpp"
#include "gyrostat/ladder/free/full_motion.hpp"
#include "gyrostat/ladder/free/track.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/monitor.hpp"

namespace gyrostat::free {

/// Rung `full`: the full equations by Taylor series, the referee.
GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::free

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/free/full_rung_definition.hpp"
#endif
