// SPDX-License-Identifier: BSD-3-Clause
// What is public of the family `spinning`: its ladder, and the models that docs/headers.md lists. What else its folders hold are
// details: free to read, and to change from one version to the next.
#pragma once

#include "gyrostat/ladder/spinning/inputs.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/models/spinning/axial_torque.hpp"
#include "gyrostat/models/spinning/design.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/linear_grid.hpp"
#include "gyrostat/models/spinning/picard.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/second_order.hpp"
#include "gyrostat/models/spinning/spin_angle.hpp"
#include "gyrostat/models/spinning/tilt_orders.hpp"
