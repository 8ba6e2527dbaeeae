// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/solve_definition.hpp"
