// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/deceleration/cost.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"

namespace gyrostat::deceleration {

/// In the order of rung_kinds, whichever elliptic functions the rungs take.
GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept {
  constexpr double (*costs[])(const Scene&) noexcept = {&cost_of_equal_torque, &cost_of_averaged, &cost_of_averaged_2,
                                                        &cost_of_full};
  return costs[rung](scene);
}

}  // namespace gyrostat::deceleration
