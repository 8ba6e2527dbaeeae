// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/scene_definition.hpp"
#include "gyrostat/ladder/rotor/solve_definition.hpp"
