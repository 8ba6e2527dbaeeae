// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/scene.hpp"
#include "gyrostat/ladder/rung.hpp"
#include "gyrostat/math/elliptic.hpp"

namespace gyrostat::deceleration {

/// Answers a scene with the cheapest rung whose own error estimate meets the tolerance: equal-torque, averaged, averaged-2, full.
/// Where no rung answers, the refusal says why and the answer holds only what was tried. The compiled library holds that for
/// math::Native; solve_definition.hpp makes it for other elliptic functions.
template <class Elliptic = math::Native>
Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor = nullptr);

/// What an answer by that rung would cost where it applies, by its place in the table, s.
GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept;

#ifdef GYROSTAT_COMPILED
extern template Answer solve<math::Native>(const Scene&, Refusal&, Monitor*);
#endif

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/cost_definition.hpp"
#include "gyrostat/ladder/deceleration/solve_definition.hpp"
#endif
