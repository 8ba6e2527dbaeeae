// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/solve_definition.hpp"

// for who steps the equations without the ladder
template class gyrostat::ode::Taylor<gyrostat::free::FullSystem<double>>;
