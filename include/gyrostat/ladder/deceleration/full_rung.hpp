// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/full_motion.hpp"
#include "gyrostat/ladder/deceleration/orbit_kind.hpp"
#include "gyrostat/ladder/deceleration/track.hpp"

namespace gyrostat::deceleration {

namespace detail {

/// The state of M, all but its attitude.
GYROSTAT_COMPILED_ONCE State<double> state_on_orbit(const Problem<double>& problem, const Vec3<double>& M) noexcept;

/// The modulus varies slowly: its error is looked at in about so many parts of the points, at the ends of each.
inline constexpr std::size_t k2_looks = 64;
constexpr std::size_t k2_stride(std::size_t points) noexcept { return 1 + points / k2_looks; }

/// The track of the full equations from their states and errors, relative where the columns measure them so. errors: as in k2_error.
GYROSTAT_COMPILED_ONCE Track track_of(const Problem<double>& problem, std::vector<State<double>> states,
                                      bool knows_attitude, const ColumnErrors<double>& error,
                                      std::span<const ColumnErrors<double>> errors = {});

/// Whether some of the times are so near the stop that they may be behind it; then the modulus may be any that it has on the way.
GYROSTAT_COMPILED_ONCE bool doubt_modulus_at_stop(Track& track, const Problem<double>& problem,
                                                  std::span<const double> times) noexcept;

}  // namespace detail

/// The full equations of a problem in principal axes at times >= 0, by Taylor series. `wanted`: as in MotionOptions.
GYROSTAT_COMPILED_ONCE Track full_motion_track(const Problem<double>& problem, std::span<const double> times,
                                               double tolerance, std::span<const double> wanted, bool find_stop,
                                               const Quat<double>* attitude, Monitor* monitor);

/// The angle that U and the axes turn through up to the last time, or up to the stop, where there is one, to its order, rad: the stop where
/// that is nearer, or where it is to_stop.
GYROSTAT_COMPILED_ONCE double turned_angle(const Scene& scene, bool to_stop) noexcept;

/// Whether the full equations are followed to the stop: not where nobody needs it and it lies so far behind the last time that it is not worth its
/// cost.
GYROSTAT_COMPILED_ONCE bool goes_to_stop(const Scene& scene) noexcept;

/// Why the full equations are not worth a try; nullptr: they are. Slow columns do not need the phase.
GYROSTAT_COMPILED_ONCE const char* not_worth(const Scene& scene, const Goal<std::size(column_kinds)>& goal) noexcept;

/// Rung `full`: the full equations, by Taylor series or by what the scene brings.
GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor);

namespace detail {

/// Warns that a stop behind the asked times is not told, with this text but where the body may never stop; nullptr: the warning's own.
GYROSTAT_COMPILED_ONCE void warn_of_stop_withheld(Track& track, const Scene& scene, const char* text = nullptr);

}  // namespace detail

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/full_rung_definition.hpp"
#endif
