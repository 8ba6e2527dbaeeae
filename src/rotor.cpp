// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/closed_form_rung_definition.hpp"
#include "gyrostat/ladder/rotor/full_lanes_definition.hpp"
#include "gyrostat/ladder/rotor/full_rung_definition.hpp"
#include "gyrostat/ladder/rotor/linear_tail_rung_definition.hpp"
#include "gyrostat/ladder/rotor/scene_definition.hpp"
#include "gyrostat/ladder/rotor/solve_definition.hpp"
#include "gyrostat/ladder/rotor/track_definition.hpp"
