// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

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
};

/// What a rung finds at the asked times, in principal axes.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, each relative to the greatest norm of its column; attitude: the angle, rad.
  ColumnErrors<double> error;
  Periodicity periodicity;
};

/// Whether small changes of a periodic motion stay small: 1 or 0; NaN: not known.
inline double stability(const Periodicity& known) noexcept {
  const OrbitStability verdict = orbit_stability(known.trace, known.trace_error);
  if (verdict == OrbitStability::undecided) return known.stable;
  return verdict == OrbitStability::stable ? 1 : 0;
}

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

inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, CallersRow{row_of(scene), scene.R_BP()}, track.states, track.error, scene.question(), tables,
               scene.question().wants_attitude ? 0 : column_set(column::attitude));
  if (!scene.periodic()) {
    const auto& [w, d, q] = scene.given();
    put_start(answer, column_kinds[column::angular_velocity], {w[0], w[1], w[2]});
    if (!scene.oriented()) put_start(answer, column_kinds[column::down], {d[0], d[1], d[2]});
    put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  }
}

/// The scalars that are known.
inline void tell(Answer& answer, const Periodicity& known) {
  const auto quantity = [&](std::size_t which, double value, double error) {
    if (!std::isnan(value)) answer.quantities.push_back({&scalar_kinds[which], {value}, error});
  };
  quantity(scalar::period, known.period, known.period_error);
  quantity(scalar::floquet_trace, known.trace, known.trace_error);
  quantity(scalar::stable, stability(known), nan<double>);
  quantity(scalar::precession_rate, known.precession, known.precession_error);
}

}  // namespace gyrostat::heavy
