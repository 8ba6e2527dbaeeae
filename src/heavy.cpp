// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/solve_definition.hpp"
