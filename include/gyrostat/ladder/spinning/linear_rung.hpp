// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/even_times.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/spinning/axial_motion.hpp"
#include "gyrostat/ladder/spinning/tilt_errors.hpp"
#include "gyrostat/ladder/spinning/track.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/axial_torque.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/linear_grid.hpp"
#include "gyrostat/models/spinning/tilt_orders.hpp"
#include "gyrostat/rotation/euler_312.hpp"

namespace gyrostat::spinning {

namespace detail {

inline constexpr const char* tilt_too_large =
    "the tilt, or the error of the spin angle, may exceed 0.3 rad: equations for small tilt do not hold";

/// Gives up before the motion is computed, where another rung may answer.
inline bool gives_up(const Scene& scene, int rung, const LinearErrors<double>& error) noexcept {
  return scene.question().rung != rung && !(holds(error) && error.attitude <= scene.goal().columns[column::attitude]);
}

/// At so few times the attitude's error is taken from the modes at each: half a microsecond a time. At more, up to `many_times`, where the last one alone
/// leaves room for what is asked: a motion of higher order takes longer.
inline constexpr std::size_t few_times = 32, many_times = 1024;

/// Whether the a-priori error of the attitude does not do.
inline bool worth_a_closer_look(const Scene& scene, int rung, const LinearErrors<double>& error) noexcept {
  return holds(error) && (scene.question().rung == rung || gives_up(scene, rung, error));
}

/// The error of the attitude by looking at each time, where that is worth it, else as it is. look(times): what it is at these.
template <class Look>
double looked_at(const Scene& scene, const LinearErrors<double>& error, Look&& look) noexcept {
  const std::span<const double> times = scene.question().times;
  if (times.size() > few_times) {
    const double wanted = scene.goal().columns[column::attitude];
    const bool may_do = times.size() <= many_times && error.attitude > wanted && look(times.last(1)) <= wanted;
    if (!may_do) return error.attitude;
  }
  return look(times);
}

GYROSTAT_COMPILED_ONCE Track given_up(const LinearErrors<double>& error);

/// The linear motion at the times, on a grid where they are even and many.
GYROSTAT_COMPILED_ONCE void linear_states(const Problem<double>& problem, std::span<const double> times,
                                          std::span<State<double>> states) noexcept;

/// What the turning of the data into the axes of the spin makes of the linear motion, in the units of the columns.
GYROSTAT_COMPILED_ONCE ColumnErrors<double> linear_conversion_errors(const Scene& scene);

/// The track with the stated errors and the domain, where its states are numbers. of_data: of the columns, in their units.
GYROSTAT_COMPILED_ONCE Track judged(Track track, const Scene& scene, const LinearErrors<double>& error,
                                    const ColumnErrors<double>& of_data);

}  // namespace detail

/// Rung `linear`: the exact motion for small tilt (docs/spinning.md, section 3), under a torque about the spin axis by Taylor series
/// (section 6.3).
GYROSTAT_COMPILED_ONCE Track linear_track(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/linear_rung_definition.hpp"
#endif
