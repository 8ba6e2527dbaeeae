// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/cost_definition.hpp"
#include "gyrostat/ladder/deceleration/solve_definition.hpp"

namespace gyrostat::deceleration {

template Answer solve<math::Native>(const Scene&, Refusal&, Monitor*);

}  // namespace gyrostat::deceleration
