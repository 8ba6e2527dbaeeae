// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/solve_definition.hpp"
