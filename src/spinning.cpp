// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/full_rung_definition.hpp"
#include "gyrostat/ladder/spinning/linear_rung_definition.hpp"
#include "gyrostat/ladder/spinning/picard_rung_definition.hpp"
#include "gyrostat/ladder/spinning/second_order_rung_definition.hpp"
#include "gyrostat/ladder/spinning/scene_definition.hpp"
#include "gyrostat/ladder/spinning/solve_definition.hpp"
#include "gyrostat/ladder/spinning/track_definition.hpp"
