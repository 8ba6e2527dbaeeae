// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/even_times.hpp"
#include "gyrostat/ladder/free/track.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/models/free/averages.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/free/quick_lanes.hpp"
#include "gyrostat/rotation/symmetric.hpp"

namespace gyrostat::free {

namespace detail {

/// What the recurrence loses of attitude and momentum. Over 20 000 random bodies of moments far apart it was 60 roundings at most.
inline constexpr double grid_rounding = 64 * epsilon<double>;

/// What the asked wheels turned through, and how far that may be off, rad.
GYROSTAT_COMPILED_ONCE void turn_wheels(Track& track, const Scene& scene, const ClosedForm& form);

/// Of the rates of the wheels, which follow those of the body.
GYROSTAT_COMPILED_ONCE double rate_error(const Scene& scene, std::span<const State<double>> states,
                                         double of_velocity) noexcept;

/// Of M, over its length or its scale; where the bound knows nothing, as where M is all rounding: M keeps its length, and cannot be off by more
/// than two of it and the rounding of the parts that it is summed of.
GYROSTAT_COMPILED_ONCE double momentum_error(const Scene& scene, double R, double bound) noexcept;

/// Of states by a form: `bound` of it up to the last time, that of the rates over `fastest`, rad/s; R = |M|; `rounding`: what a recurrence adds.
GYROSTAT_COMPILED_ONCE void state_errors(Track& track, const Scene& scene, const MotionError<double>::Bound& bound,
                                         double fastest, double R, double rounding) noexcept;

/// Of what is unstable or nearly so; agree: neighbours are motions of the same kind.
GYROSTAT_COMPILED_ONCE void warn_of_motion(Outcome& track, const Motion<double>& motion, bool agree);

/// What the rung answers by a form.
GYROSTAT_COMPILED_ONCE Track track_of(const Scene& scene, const ClosedForm& form);

/// Whether states are all that is asked for, at times of which each is worked out by itself, of a motion that needs theta functions.
GYROSTAT_COMPILED_ONCE bool asks_for_states(const Scene& scene) noexcept;

inline QuickLanes::Body lane_of(const Scene& scene) noexcept {
  return {&scene.assembly(), &scene.principal(), scene.question().times.back()};
}

/// Whether what lanes know of a scene is within what is asked; then `track` has it.
GYROSTAT_COMPILED_ONCE bool take_lane(Track& track, const Scene& scene, const QuickLanes& lanes, int b);

}  // namespace detail

/// Rung `closed-form`: the motion as a pair of theta functions (docs/free.md), set up in double where that is known to do for what is asked, else to
/// twice the digits of a double, so that the data are what limits it.
GYROSTAT_COMPILED_ONCE Track closed_form_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::free

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/free/closed_form_rung_definition.hpp"
#endif
