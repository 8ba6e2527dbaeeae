// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/conversion_error_definition.hpp"
#include "gyrostat/ladder/heavy/exact_periodicity_definition.hpp"
#include "gyrostat/ladder/heavy/exact_rung_definition.hpp"
#include "gyrostat/ladder/heavy/forced_start_definition.hpp"
#include "gyrostat/ladder/heavy/forced_track_definition.hpp"
#include "gyrostat/ladder/heavy/full_rung_definition.hpp"
#include "gyrostat/ladder/heavy/scene_definition.hpp"
#include "gyrostat/ladder/heavy/series_2_rung_definition.hpp"
#include "gyrostat/ladder/heavy/series_rung_definition.hpp"
#include "gyrostat/ladder/heavy/solve_definition.hpp"
#include "gyrostat/ladder/heavy/track_definition.hpp"

// the set-up to twice the digits is long in compiling
template class gyrostat::heavy::EulerCase<double>;
