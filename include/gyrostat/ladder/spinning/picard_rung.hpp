// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/spinning/track.hpp"
#include "gyrostat/models/spinning/picard.hpp"

namespace gyrostat::spinning {

/// Rung `picard`: sweeps of quadratures over the full equations (docs/spinning.md, section 6.2), 2, then 4, then 8 where fewer do not
/// meet the tolerance. The full equations cost less at every tolerance, so it answers only where it is asked for by name.
GYROSTAT_COMPILED_ONCE Track picard_track(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/picard_rung_definition.hpp"
#endif
