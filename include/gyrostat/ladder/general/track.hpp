// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/general/scene.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/models/general/balances.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/rotation/euler.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::general {

/// What a rung finds at the asked times, and by how much it may be off: absolute, in the unit of each primitive. NaN: not known.
struct Track : Outcome {
  std::vector<State<double>> states;
  std::array<double, primitive::count> off;
  /// Of a rung that knows norm and energy better than states tell: the column and its absolute error.
  struct Slow {
    std::vector<double> values;
    double off = nan<double>;
  };
  Slow norm, energy;
  /// By how much momentum in space, its size, the energy and the torque are off, where a rung has looked at them itself: absolute. NaN: what the
  /// primitives make of them is all that is known.
  struct Compared {
    double inertial = nan<double>, norm = nan<double>, energy = nan<double>, torque = nan<double>;
  };
  Compared compared;
  double stop_time = nan<double>, stop_error = nan<double>;
  /// From when to when a brake holds the body, s, and how well each begin is known: there all torque is that of rest.
  std::vector<std::array<double, 2>> rests;
  double rest_off = 0;
  /// Of torques and motors, where that is asked for.
  double energy_balance = nan<double>, momentum_balance = nan<double>;
  Power<double> work{nan<double>, nan<double>}, work_error = work;  ///< J; relative

  Track() { off.fill(nan<double>); }
};

namespace detail {

/// The axes of the orbit at t, x along it, y against its normal, z to the centre, to inertial ones; its sign does not jump.
GYROSTAT_COMPILED_ONCE Quat<double> orbit_axes(const Orbit<double>& orbit, double t) noexcept;

/// Whether a rung that gives these primitives, norm and energy apart, gives the column.
GYROSTAT_COMPILED_ONCE bool known(const Track& track, std::size_t place) noexcept;

/// The error of a column of which Track::Compared knows: absolute, and relative to its size, as the answer has it.
GYROSTAT_COMPILED_ONCE double column_off(const Track& track, const Scene& scene, std::size_t place) noexcept;
GYROSTAT_COMPILED_ONCE double column_error(const Track& track, const Scene& scene, std::size_t place) noexcept;

}  // namespace detail

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track);

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/track_definition.hpp"
#endif
