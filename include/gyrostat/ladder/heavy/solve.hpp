// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/ladder/rung.hpp"

namespace gyrostat::heavy {

/// Answers a scene with the cheapest rung whose own error estimate meets the tolerance: exact (where there is a closed form, nothing
/// is cheaper or better), series-2, series, full. Where no rung answers, the refusal says why and the answer holds only what was tried.
///
/// Beside the columns the answer has, where the motion is periodic and the rung knows it,
///     period            s
///     floquet_trace     of the 6 x 6 monodromy, minus 4
///     stable            1 or 0; absent where the trace is too near +-2 to say
///     precession_rate   mean turn about the vertical, right-handed about DOWN, rad/s
/// and of a start with an exact case (a pendulum, a symmetric top) what of these that case knows, whichever rung answers.
GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor = nullptr);

/// What an answer by that rung would cost where it applies, by its place in the table, s.
GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept;

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/solve_definition.hpp"
#endif
