// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/propagator_definition.hpp"
#include "gyrostat/ladder/general/scene_definition.hpp"
#include "gyrostat/ladder/general/solve_definition.hpp"
