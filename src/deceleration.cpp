// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/averaged_rung_definition.hpp"
#include "gyrostat/ladder/deceleration/averaging_definition.hpp"
#include "gyrostat/ladder/deceleration/cost_definition.hpp"
#include "gyrostat/ladder/deceleration/equal_torque_rung_definition.hpp"
#include "gyrostat/ladder/deceleration/full_rung_definition.hpp"
#include "gyrostat/ladder/deceleration/hand_over_definition.hpp"
#include "gyrostat/ladder/deceleration/orbit_kind_definition.hpp"
#include "gyrostat/ladder/deceleration/orbit_rung_definition.hpp"
#include "gyrostat/ladder/deceleration/scene_definition.hpp"
#include "gyrostat/ladder/deceleration/solve_definition.hpp"
#include "gyrostat/ladder/deceleration/track_definition.hpp"

namespace gyrostat::deceleration {

template Answer solve<math::Native>(const Scene&, Refusal&, Monitor*);

}  // namespace gyrostat::deceleration
