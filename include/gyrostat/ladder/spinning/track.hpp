// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "gyrostat/core/linkage.hpp"
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
  /// Of the tilt alone, rad, where the rung knows it; NaN: it is within the error of the attitude.
  double tilt_error = nan<double>;
};

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track);

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/track_definition.hpp"
#endif
