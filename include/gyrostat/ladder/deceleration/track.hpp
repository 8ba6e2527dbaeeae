// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

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
    if (!problem.exact_gaps)
      error[column::angular_velocity] += 8 * epsilon<double> * problem.inverse_inertia[2] / problem.inverse_inertia[0] *
                                         problem.angular_velocity(problem.momentum).norm();
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

/// The errors as the columns measure them.
inline ColumnErrors<double> relative_error(const Track& track, const Scene& scene) noexcept {
  Comparison sizes(Row<double>{scene.problem()});
  for (const auto& state : track.states) sizes.add(state);
  return sizes.relative(track.error);
}

/// Leaves out a stop time that alone would miss the tolerance, where the stop lies behind the times asked for and nobody asked for it.
inline void withhold_stop(Track& track, const Scene& scene) {
  const Question& question = scene.question();
  if (question.rung != any_rung || scene.needs_stop()) return;
  if (track.stop_error > question.tolerance && track.stop_time > question.times.back()) {
    track.warn(warning::stop_withheld, track.stop_time);
    track.stop_time = nan<double>;
  }
}

/// The columns that are asked for, in the caller's axes, and the stop time.
inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, Row<double>{scene.problem(), scene.R_BP()}, track.states, relative_error(track, scene),
               scene.question(), tables, track.unknown());
  const Setup& given = scene.setup();
  const Vec3<double>& M = given.momentum;
  const Quat<double>& q = given.attitude;
  put_start(answer, column_kinds[column::angular_momentum], {M[0], M[1], M[2]});
  if (given.angular_velocity) {
    const Vec3<double>& omega = *given.angular_velocity;
    put_start(answer, column_kinds[column::angular_velocity], {omega[0], omega[1], omega[2]});
  }
  put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  if (std::isnan(track.stop_time)) return;
  answer.quantities.push_back({&scalar_kinds[scalar::stop_time], {track.stop_time}, track.stop_error});
}

}  // namespace gyrostat::deceleration
