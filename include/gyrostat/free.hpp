// SPDX-License-Identifier: BSD-3-Clause
// What is public of the family `free`: its ladder, and the models that docs/headers.md lists. What else its folders hold are
// details: free to read, and to change from one version to the next.
#pragma once

#include "gyrostat/ladder/free/inputs.hpp"
#include "gyrostat/ladder/free/solve.hpp"
#include "gyrostat/models/free/flips.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/free/motion_lanes.hpp"
#include "gyrostat/models/free/permanent.hpp"
#include "gyrostat/models/free/quick_lanes.hpp"
#include "gyrostat/models/free/theta_pair.hpp"
#include "gyrostat/models/free/view.hpp"
