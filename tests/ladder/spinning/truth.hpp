// SPDX-License-Identifier: BSD-3-Clause
// The motion of a spinning scene in long double, as an answer.
#pragma once

#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"

namespace gyrostat::spinning {

/// False where long double cannot follow the motion (too many steps).
bool true_motion(const Scene& scene, Answer& truth);

}  // namespace gyrostat::spinning
