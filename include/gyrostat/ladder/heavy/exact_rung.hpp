// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/conversion_error.hpp"
#include "gyrostat/ladder/heavy/exact_periodicity.hpp"
#include "gyrostat/ladder/heavy/forced_start.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/exact.hpp"

namespace gyrostat::heavy {

/// Rung `exact`: the cases that are known in closed form or by quadrature (docs/heavy.md, section 7).
GYROSTAT_COMPILED_ONCE Track exact_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/exact_rung_definition.hpp"
#endif
