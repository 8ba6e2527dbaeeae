// SPDX-License-Identifier: BSD-3-Clause
// The motion of a heavy scene in long double, as an answer.
#pragma once

#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"

namespace gyrostat::heavy {

/// False where long double cannot follow the motion (too many steps), or has no body or periodic motion.
bool true_motion(const Scene& scene, Answer& truth);

}  // namespace gyrostat::heavy
