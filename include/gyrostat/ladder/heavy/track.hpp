// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "gyrostat/ladder/heavy/column_errors.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/models/heavy/multipliers.hpp"

namespace gyrostat::heavy {

/// What a rung knows of a periodic motion; NaN: not known.
struct Periodicity {
  double period = nan<double>, period_error = nan<double>;          ///< s; relative
  double trace = nan<double>, trace_error = nan<double>;            ///< of the monodromy, minus 4; absolute
  double precession = nan<double>, precession_error = nan<double>;  ///< mean turn about DOWN, rad/s; absolute
  double stable = nan<double>;                                      ///< 1 or 0 where more is known than the trace tells
};

/// What a rung finds at the asked times, in principal axes.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, each relative to the greatest norm of its column; attitude: the angle, rad.
  ColumnErrors<double> error;
  Periodicity periodicity;
};

/// The columns of an answer, in the caller's axes. The answer's error is the greatest of all columns.
inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  const bool turning = scene.question().wants_attitude;
  answer.times = scene.question().times;
  answer.warnings = track.warnings;
  answer.counts = track.counts;
  const auto column = [&](const char* name, int width, double error) -> std::vector<double>& {
    answer.columns.push_back({name, width, {}, error});
    answer.columns.back().values.reserve(track.states.size() * std::size_t(width));
    return answer.columns.back().values;
  };
  answer.columns.reserve(3);
  auto& rates = column("angular_velocity", 3, track.error.angular_velocity);
  auto& down = column("down", 3, track.error.down);
  auto* attitude = turning ? &column("attitude", 4, track.error.attitude) : nullptr;
  for (const State<double>& state_P : track.states) {
    const State<double> state = in_axes(scene.R_BP(), state_P);
    rates.insert(rates.end(), state.angular_velocity.begin(), state.angular_velocity.end());
    down.insert(down.end(), state.down.begin(), state.down.end());
    const Quat<double>& q = state.attitude;
    if (turning) attitude->insert(attitude->end(), {q.x, q.y, q.z, q.w});
  }
  auto error = track.error;
  if (!turning) error.attitude = 0;
  answer.error = error.greatest();

  const Periodicity& p = track.periodicity;
  const auto quantity = [&](const char* name, double value, double of) {
    if (!std::isnan(value)) answer.quantities.push_back({name, 1, {value}, of});
  };
  // relative to the truth, which may be smaller by as much
  const auto relative = [](double absolute, double value) noexcept {
    const double left = std::abs(value) - absolute;
    return absolute == 0 ? 0.0 : left > 0 ? absolute / left : infinity<double>;
  };
  quantity("period", p.period, p.period_error);
  quantity("floquet_trace", p.trace, relative(p.trace_error, p.trace));
  const OrbitStability verdict = orbit_stability(p.trace, p.trace_error);
  const bool decided = verdict != OrbitStability::undecided;
  quantity("stable", decided ? verdict == OrbitStability::stable : p.stable, nan<double>);
  quantity("precession_rate", p.precession, relative(p.precession_error, p.precession));
}

}  // namespace gyrostat::heavy
