// SPDX-License-Identifier: BSD-3-Clause
// What is public of the family `deceleration`: its ladder, and the models that docs/headers.md lists. What else its folders hold are
// details: free to read, and to change from one version to the next.
#pragma once

#include "gyrostat/ladder/deceleration/inputs.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/models/deceleration/averaged.hpp"
#include "gyrostat/models/deceleration/capture.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/models/deceleration/orbit_average.hpp"
#include "gyrostat/models/deceleration/orbit_second_order.hpp"
#include "gyrostat/models/deceleration/phase_grid.hpp"
#include "gyrostat/models/deceleration/second_order.hpp"
#include "gyrostat/models/deceleration/stability.hpp"
