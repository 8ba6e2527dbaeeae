// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/conversion_error.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/exact.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

/// Period and precession of the motions that are known exactly (docs/heavy.md, section 7).
namespace gyrostat::heavy {

/// Of the fast periodic motion that the scene asks for, known exactly.
GYROSTAT_COMPILED_ONCE Periodicity periodicity_of(const Scene& scene, const State<double>& start,
                                                  const Exact<double>& exact);

/// Of the motion from a start, whichever rung answers: of a pendulum the period, and a plane that stands still; of a top its mean
/// precession, and the period where its inclination is constant.
GYROSTAT_COMPILED_ONCE Periodicity periodicity_from(const Problem<double>& problem, const State<double>& start);

/// The same of a scene, with what its conversions err: by the bodies and starts that are off by as much. What they lose is not known.
GYROSTAT_COMPILED_ONCE Periodicity periodicity_from(const Scene& scene);

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/exact_periodicity_definition.hpp"
#endif
