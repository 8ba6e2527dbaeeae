// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/free/solve_definition.hpp"
