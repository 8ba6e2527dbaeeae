// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"

namespace gyrostat::rotor {

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, each relative to the greatest norm of its column; attitude: the angle, rad.
  ColumnErrors<double> error;
};

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track);

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/track_definition.hpp"
#endif
