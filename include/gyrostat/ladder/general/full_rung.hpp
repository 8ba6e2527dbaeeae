// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"
#include "gyrostat/ladder/general/track.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/trials.hpp"

namespace gyrostat::general {

inline constexpr const char* too_stiff =
    "wheels and damping both settle so fast that the full equations would take too many steps: leave out what hardly "
    "matters, or ask for a shorter span";

inline constexpr const char* forcing_lost =
    "a wave, the magnetic field or the orbit goes through more than 1e8 rad up to the last time, and its phase is "
    "lost: "
    "ask for a shorter span or take it out";

namespace detail {

/// Primitives stand first in full_columns, in the same order.
static_assert(std::size_t{primitive::attitude} == std::size_t{full_column::attitude} &&
              std::size_t{primitive::position} == std::size_t{full_column::position});

/// The part of its tolerance that a column made of several primitives leaves to each.
inline constexpr double share_of_each = 0.5;
/// The same of the torque where its own error is not looked at: a torque may change much where they change little.
inline constexpr double share_of_unjudged_torque = 1.0 / 64;

/// Columns whose own errors a run knows, which may be far less than what those of the primitives would make of them: a motion whose phase is
/// lost may keep its energy. Each is at most three numbers wide.
inline constexpr std::size_t compared_columns[] = {column::angular_momentum_inertial, column::angular_momentum_norm,
                                                   column::energy};

/// What is asked of the primitives so that the columns made of them are as asked. judged: where a run judges the compared columns and the
/// torque itself.
inline FullErrors<double> wanted_of(const Scene& scene, const Goal<std::size(column_kinds)>& goal,
                                    const FullRow<double>& row, bool judged) noexcept {
  // rates are held to those of the start, if it turns
  constexpr auto rate = primitive::angular_velocity;
  const double least = scene.problem().angular_velocity.norm() > 0 ? 1e-3 : 0.1;
  const double finer = !judged && row.scale[rate] > 0
                           ? std::clamp(scene.scales()[column::angular_velocity] / row.scale[rate], least, 1.0)
                           : 1.0;
  auto wanted = FullErrors<double>::all(infinity<double>);
  constexpr std::size_t own[] = {column::attitude,   column::angular_velocity, column::angular_momentum,
                                 column::rotor_rate, column::rotor_angle,      column::velocity,
                                 column::position};
  for (std::size_t c = 0; c < std::size(column_kinds); ++c) {
    if (!(goal.columns[c] < infinity<double>) || !scene.has_column(c)) continue;
    if (judged && std::ranges::find(compared_columns, c) != std::end(compared_columns)) continue;
    const double of_torque = judged ? share_of_each : share_of_unjudged_torque;
    for (std::size_t p = 0; p < primitive::count; ++p) {
      if (!has(made_of[c], p) || (p == primitive::rotor_rate && scene.wheels().count == 0)) continue;
      const double share = own[p] == c ? 1.0 : c == column::torque ? of_torque : share_of_each;
      wanted[p] = std::min(wanted[p], goal.columns[c] * share * (p == primitive::angular_velocity ? finer : 1.0));
    }
  }
  return wanted;
}

/// The absolute errors of what is made of the primitives, as it was compared itself.
GYROSTAT_COMPILED_ONCE Track::Compared compared_of(const Track& track, const FullErrors<double>& error,
                                                   const FullRow<double>& row) noexcept;

/// The absolute errors of the primitives.
GYROSTAT_COMPILED_ONCE std::array<double, primitive::count> off_of(const Track& track, const FullErrors<double>& error,
                                                                   const FullRow<double>& row,
                                                                   const Scene& scene) noexcept;

/// Where it is asked for: how well energy and momentum at the last time agree with all power and torque on the way, by a run of its own.
GYROSTAT_COMPILED_ONCE void add_balance(Track& track, const Scene& scene, double step_tolerance) noexcept;

}  // namespace detail

/// Of wheels and torques that need no states of their own; and of the others, and of a path that forces bend.
inline constexpr SeriesCost small_series_cost{26e-6, 2e-6, 0.7e-6, 0.7}, large_series_cost{26e-6, 2.9e-6, 0.75e-6, 0.7};
/// A step with a torque that a field exerts costs so many times what one without does more, with a dipole's so many more, and on an orbit that is no circle.
inline constexpr double of_field = 1, of_dipole = 1, of_ellipse = 2;
/// Of wheels that settle fast, by Radau: some forty short steps until they follow, then those that the body asks for.
inline constexpr SeriesCost stiff_cost{800e-6, 20e-6, 3e-6, 1};

GYROSTAT_COMPILED_ONCE double cost_of_full(const Scene& scene) noexcept;

namespace detail {

/// The refusal of a scene whose phases no integrator keeps; of others no failure.
GYROSTAT_COMPILED_ONCE Track unless_lost(const Scene& scene);

}  // namespace detail

/// Rung `full`: the full equations by Taylor series, or by Radau where wheels settle fast.
GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor);
/// The same in one run without neighbours, its errors told as 0: to be compared with another of its kind.
GYROSTAT_COMPILED_ONCE Track full_track_alone(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/full_rung_definition.hpp"
#endif
