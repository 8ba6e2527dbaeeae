// SPDX-License-Identifier: BSD-3-Clause
// What is public of the family `general`: its ladder, and the models that docs/headers.md lists. What else its folders hold are
// details: free to read, and to change from one version to the next.
#pragma once

#include "gyrostat/ladder/general/custom_motion.hpp"
#include "gyrostat/ladder/general/inputs.hpp"
#include "gyrostat/ladder/general/propagator.hpp"
#include "gyrostat/ladder/general/recognise.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/holding.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/rest.hpp"
#include "gyrostat/models/general/settling.hpp"
#include "gyrostat/models/general/stiff.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/models/general/wheels.hpp"
