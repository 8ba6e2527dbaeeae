// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/solve_definition.hpp"
