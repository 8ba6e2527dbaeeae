// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/scene_definition.hpp"
#include "gyrostat/ladder/heavy/solve_definition.hpp"

// the set-up to twice the digits is long in compiling
template class gyrostat::heavy::EulerCase<double>;
