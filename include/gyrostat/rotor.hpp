// SPDX-License-Identifier: BSD-3-Clause
// What is public of the family `rotor`: its ladder, and the models that docs/headers.md lists. What else its folders hold are
// details: free to read, and to change from one version to the next.
#pragma once

#include "gyrostat/ladder/rotor/inputs.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/attractor.hpp"
#include "gyrostat/models/rotor/closed_form.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/full_batch.hpp"
#include "gyrostat/models/rotor/linear_tail.hpp"
#include "gyrostat/models/rotor/relaxing.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"
