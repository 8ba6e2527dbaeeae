// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/general/custom_motion.hpp"
#include "gyrostat/ladder/general/full_rung.hpp"
#include "gyrostat/ladder/general/track.hpp"
#include "gyrostat/ladder/monitor.hpp"

/// The rung `full` by other integrators than the library's own: DOP853, which a torque of the caller's own needs, or what the scene brings.
namespace gyrostat::general {

inline constexpr const char* no_series =
    "a torque of your own has no Taylor series: leave integrator to auto, or take dop853 or cvode";
inline constexpr const char* no_value_of_law = "the torque of your own has no finite value";
inline constexpr const char* not_repeatable =
    "the torque of your own is not a function of time and state: asked twice at the start, it gave two values";
inline constexpr const char* steps_of_law =
    "the torque of your own makes the steps so short that their budget, 10 million, does not reach the last "
    "time: give a jump with the state, as that of a switch at zero, a width, name in breakpoints where a fast "
    "phase ends, give what brakes hard as [[torque]] of type damping, or ask for a shorter span or a looser tolerance";
inline constexpr const char* too_fast_for_dop853 =
    "wheels settle so fast that DOP853 would take too many steps: ask for a shorter span, or give the torque as tables "
    "and damping";

namespace detail {

inline const char* why_law_failed(LawFault fault) noexcept {
  return fault == LawFault::not_repeatable ? not_repeatable : no_value_of_law;
}

/// Says so where breakpoints are missing that a law might have.
inline void warn_of_law(Track& track, const Scene& scene) {
  if (scene.own_torque().any() && scene.own_torque().breakpoints.empty())
    track.warn(warning_kinds[warning::custom_smooth]);
}

}  // namespace detail

/// The full equations by DOP853.
GYROSTAT_COMPILED_ONCE Track full_by_dop853(const Scene& scene, Monitor* monitor);

/// Rung `full` by the integrator that the scene brings, or needs.
GYROSTAT_COMPILED_ONCE Track full_by_any(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/custom_rung_definition.hpp"
#endif
