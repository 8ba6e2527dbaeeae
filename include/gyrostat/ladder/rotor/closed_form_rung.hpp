// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/rotor/state_columns.hpp"
#include "gyrostat/ladder/rotor/track.hpp"
#include "gyrostat/models/rotor/closed_form.hpp"

namespace gyrostat::rotor {

/// Rung `closed-form`: the exact special cases (docs/rotor.md, section 5).
GYROSTAT_COMPILED_ONCE Track closed_form_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/closed_form_rung_definition.hpp"
#endif
