// SPDX-License-Identifier: BSD-3-Clause
// The motion of a rotor scene in long double, as an answer, and how far an answer is from it.
#pragma once

#include "asked.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"

namespace gyrostat::rotor {

/// False where long double cannot follow the motion (too many steps).
bool true_motion(const Scene& scene, Answer& truth, Integrator integrator = Integrator::taylor);

}  // namespace gyrostat::rotor
