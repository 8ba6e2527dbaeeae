// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/rung.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"

namespace gyrostat::spinning {

/// Answers a scene with the cheapest rung whose own error estimate meets the tolerance: linear, second-order, picard (by name only),
/// full. Where no rung answers, the refusal says why and the answer holds only what was tried.
///
/// Beside the columns the answer has
///     pointing_error               |M|/|r0 X|, how far the torque pushes the mean direction of the spin axis, rad
///     secular_velocity_ratio       limit of (v1, v2)/v3 in the linear motion
///     tilt_max                     greatest angle of body axis 3 to inertial axis 3 at the times asked for, rad
///     nutation_frequency_squared   nu^2 at the start, 1/s^2
/// The first two are NaN where there is no mean: under a torque about axis 3, without stable spin (nu^2 <= 0), where r0 X = 0; the
/// second also without force.
GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor = nullptr);

/// What an answer by that rung would cost where it applies, by its place in the table, s.
GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept;

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/solve_definition.hpp"
#endif
