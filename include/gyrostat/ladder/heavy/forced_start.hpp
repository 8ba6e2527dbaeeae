// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/regular_precession.hpp"
#include "gyrostat/models/heavy/scaled.hpp"
#include "gyrostat/models/heavy/series.hpp"

/// The start of the forced motion of a fast spin: where it is known, and how far a given start is from it.
namespace gyrostat::heavy {

/// Spin and inclination of the forced motion that a scene asks for, or that its start would belong to.
inline Periodic forced_start(const Scene& scene) noexcept {
  if (scene.periodic()) return *scene.periodic();
  return {scene.start().angular_velocity[2], scene.start().down[2]};
}

/// How far a start is from that of the forced motion with the same r and d3: the change of rates over |r|, and of down.
inline double departure(const State<double>& start, const State<double>& forced) noexcept {
  return std::hypot((start.angular_velocity - forced.angular_velocity).norm() / std::abs(start.angular_velocity[2]),
                    (start.down - forced.down).norm());
}

/// What such a departure becomes up to t: a free nutation beside the forced motion, which may grow as far as the errors of its exponent allow,
/// and what it does to the phases. Infinite where that is not small.
GYROSTAT_COMPILED_ONCE MotionError<double> departed(const Scaled<double>& s, double departure, double t) noexcept;

/// The start of a fast periodic motion where it is known in closed form: spin about a horizontal or weightless axis 3 that no torque
/// turns away, slow regular precession of a body symmetric about axis 3. Attitude: psi = 0. not_applicable where it is not known.
GYROSTAT_COMPILED_ONCE Result<State<double>> plain_start(const Problem<double>& problem,
                                                         const Periodic& asked) noexcept;

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/forced_start_definition.hpp"
#endif
