// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the deceleration family with GSL's elliptic functions.
#ifdef GYROSTAT_HAVE_GSL
#include "gyrostat/ladder/deceleration/solve_definition.hpp"
#include "gyrostat/math/gsl.hpp"

template gyrostat::Answer gyrostat::deceleration::solve<gyrostat::math::Gsl>(const Scene&, Refusal&, Monitor*);
#endif
