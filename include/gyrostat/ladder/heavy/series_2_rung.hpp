// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/conversion_error.hpp"
#include "gyrostat/ladder/heavy/forced_track.hpp"
#include "gyrostat/models/heavy/nutating.hpp"
#include "gyrostat/models/heavy/series_2.hpp"

namespace gyrostat::heavy {

/// Rung `series-2`: the forced motion of a fast spin to second order (docs/heavy.md, section 3) where the scene asks for the periodic
/// motion; from another start with the free nutation, to first order (section 5), or without it where that errs less.
GYROSTAT_COMPILED_ONCE Track series_2_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/series_2_rung_definition.hpp"
#endif
