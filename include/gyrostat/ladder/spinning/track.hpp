// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/spinning/column_errors.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"

namespace gyrostat::spinning {

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, each relative to the greatest norm of its column; attitude: the angle, rad.
  ColumnErrors<double> error;
};

/// The columns of an answer. The answer's error is the greatest of all columns.
inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  answer.times = scene.question().times;
  answer.warnings = track.warnings;
  answer.counts = track.counts;
  const auto column = [&](const char* name, int width, double error) -> std::vector<double>& {
    answer.columns.push_back({name, width, {}, error});
    answer.columns.back().values.reserve(track.states.size() * std::size_t(width));
    return answer.columns.back().values;
  };
  answer.columns.reserve(6);
  auto& rates = column("angular_velocity", 3, track.error.angular_velocity);
  auto& angles = column("euler_312", 3, track.error.angles);
  auto& attitude = column("attitude", 4, track.error.attitude);
  auto& momentum = column("angular_momentum_inertial", 3, track.error.momentum);
  auto& velocity = column("velocity", 3, track.error.velocity);
  auto& position = column("position", 3, track.error.position);
  const auto append = [](std::vector<double>& to, const Vec3<double>& v) { to.insert(to.end(), v.begin(), v.end()); };
  for (const State<double>& state : track.states) {
    append(rates, state.angular_velocity);
    append(angles, {state.angles.psi, state.angles.phi, state.angles.theta});
    const Quat<double>& q = state.attitude;
    attitude.insert(attitude.end(), {q.x, q.y, q.z, q.w});
    append(momentum, state.momentum_I);
    append(velocity, state.velocity);
    append(position, state.position);
  }
  answer.error = track.error.greatest();
}

}  // namespace gyrostat::spinning
