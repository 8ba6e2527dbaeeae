// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/models/heavy/multipliers.hpp"

namespace gyrostat::heavy {

/// What a rung knows of a periodic motion; NaN: not known.
struct Periodicity {
  double period = nan<double>, period_error = nan<double>;          ///< s; relative
  double trace = nan<double>, trace_error = nan<double>;            ///< of the monodromy, minus 4; absolute
  double precession = nan<double>, precession_error = nan<double>;  ///< mean turn about DOWN, rad/s; absolute
  double stable = nan<double>;                                      ///< 1 or 0 where more is known than the trace says
  std::array<double, 2> sides{
      nan<double>, nan<double>};  ///< of a top that nods: on which side its axis passes the poles (LagrangeTop::sides)
};

/// What a rung finds at the asked times, in principal axes.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, each relative to the greatest norm of its column; attitude: the angle, rad.
  ColumnErrors<double> error;
  Periodicity periodicity;
};

/// Whether small changes of a periodic motion stay small: 1 or 0; NaN: not known.
GYROSTAT_COMPILED_ONCE double stability(const Periodicity& known) noexcept;

/// The columns of a scene's states, and their scales.
inline Row<double> row_of(const Scene& scene) noexcept {
  return {scales(scene.problem(), scene.periodic() ? scene.periodic()->spin : scene.start().angular_velocity.norm())};
}

/// Writes the columns of a state in principal axes in the caller's.
struct CallersRow : Row<double> {
  Mat3<double> R_BP;  ///< principal axes to body axes

  void operator()(const State& state_P, double* row) const noexcept {
    Row<double>::operator()(in_axes(R_BP, state_P), row);
  }
};

/// Of a motion that began steadily, or at rest, where the weight makes that unstable.
GYROSTAT_COMPILED_ONCE void warn_of_balance(Track& track, const Scene& scene);

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track);

/// The scalars that are known.
GYROSTAT_COMPILED_ONCE void tell(Answer& answer, const Periodicity& known);

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/track_definition.hpp"
#endif
