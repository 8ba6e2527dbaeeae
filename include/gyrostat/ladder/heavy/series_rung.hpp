// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/conversion_error.hpp"
#include "gyrostat/ladder/heavy/forced_track.hpp"
#include "gyrostat/models/heavy/series.hpp"

namespace gyrostat::heavy {

/// Rung `series`: the forced motion of a fast spin by the series to the order that the tolerance needs (docs/heavy.md, section 3); of a
/// start beside that of the periodic motion with what the departure adds to the error.
GYROSTAT_COMPILED_ONCE Track series_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/series_rung_definition.hpp"
#endif
