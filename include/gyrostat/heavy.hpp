// SPDX-License-Identifier: BSD-3-Clause
// What is public of the family `heavy`: its ladder, and the models that docs/headers.md lists. What else its folders hold are
// details: free to read, and to change from one version to the next.
#pragma once

#include "gyrostat/ladder/heavy/general_orbit.hpp"
#include "gyrostat/ladder/heavy/inputs.hpp"
#include "gyrostat/ladder/heavy/nutating_orbit.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/ladder/heavy/swing_orbit.hpp"
#include "gyrostat/ladder/heavy/unstable_orbit.hpp"
#include "gyrostat/models/heavy/balance.hpp"
#include "gyrostat/models/heavy/collocation.hpp"
#include "gyrostat/models/heavy/euler_case.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/hanging.hpp"
#include "gyrostat/models/heavy/lagrange_top.hpp"
#include "gyrostat/models/heavy/pendulum.hpp"
#include "gyrostat/models/heavy/regular_precession.hpp"
#include "gyrostat/models/heavy/series.hpp"
#include "gyrostat/models/heavy/sleeping_top.hpp"
