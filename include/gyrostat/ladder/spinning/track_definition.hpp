// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/spinning/track.hpp"

namespace gyrostat::spinning {

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, Row<double>{scales(scene.problem(), scene.question().times.back())}, track.states, track.error,
               scene.question(), tables);
}

}  // namespace gyrostat::spinning
