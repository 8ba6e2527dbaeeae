// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"

namespace gyrostat::spinning {

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, as column_kinds measures them.
  ColumnErrors<double> error;
};

inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, Row<double>{scales(scene.problem(), scene.question().times.back())}, track.states, track.error,
               scene.question(), tables);
}

}  // namespace gyrostat::spinning
