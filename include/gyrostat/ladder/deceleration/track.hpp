// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/deceleration/scene.hpp"
#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/outcome.hpp"

namespace gyrostat::deceleration {

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  bool knows_momentum = false;  ///< the rung follows the phase, and with it M and omega
  bool knows_attitude = false;
  ColumnErrors<double> error;      ///< estimated greatest errors over the times, in units of the columns
  double stop_time = nan<double>;  ///< s; infinite: never; NaN: not known
  double stop_error = 0;           ///< relative

  using Outcome::warn;
  void warn(std::size_t which, double value = nan<double>, const char* text = nullptr) {
    warn(warning_kinds[which], value, text);
  }

  /// The momentum is known, and with it the angular velocity, to an error, N m s.
  void know_momentum(const Problem<double>& problem, double error_of_momentum) noexcept {
    knows_momentum = true;
    error[column::angular_momentum] = error_of_momentum;
    error[column::angular_velocity] = error_of_momentum * problem.inverse_inertia[2];
    // moments that come from a tensor err as the greatest does
    if (!problem.exact_moments)
      error[column::angular_velocity] += 8 * epsilon<double> * problem.inverse_inertia[2] / problem.inverse_inertia[0] *
                                         problem.angular_velocity(problem.momentum).norm();
  }

  /// So near to the stop that it may be behind it.
  bool may_be_at_stop(double t) const noexcept {
    return stop_time > 0 && stop_time < infinity<double> && std::abs(t - stop_time) <= stop_error * stop_time;
  }

  /// Computed where its rung has no meaning: no error is known.
  void leave_domain() {
    in_domain = false;
    error = ColumnErrors<double>::all(infinity<double>);
    if (std::isfinite(stop_time)) stop_error = infinity<double>;
    warn(warning::beyond_validity);
  }

  ColumnSet unknown() const noexcept {
    const ColumnSet vectors = knows_momentum ? 0 : column_set(column::angular_momentum, column::angular_velocity);
    return vectors | (knows_attitude ? 0 : column_set(column::attitude));
  }
};

/// Leaves out a stop time that alone would miss the tolerance, where the stop lies behind the times asked for and nobody asked for it.
GYROSTAT_COMPILED_ONCE void withhold_stop(Track& track, const Scene& scene);

/// The columns that are asked for, in the caller's axes, and the stop time.
GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track);

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/track_definition.hpp"
#endif
