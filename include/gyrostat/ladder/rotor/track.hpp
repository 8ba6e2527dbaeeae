// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/rotor/column_errors.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"

namespace gyrostat::rotor {

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  /// Estimated greatest errors over the times, each relative to the greatest norm of its column; attitude: the angle, rad.
  ColumnErrors<double> error;
};

/// The columns of an answer. The answer's error is the greatest of all columns.
inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  const auto& body = scene.gyrostat();
  const std::size_t n = track.states.size();
  answer.times = scene.data().times;
  answer.warnings = track.warnings;
  answer.counts = track.counts;
  const auto column = [&](const char* name, int width, double error) -> std::vector<double>& {
    answer.columns.push_back({name, width, {}, error});
    answer.columns.back().values.reserve(n * std::size_t(width));
    return answer.columns.back().values;
  };
  answer.columns.reserve(6);
  auto& attitude = column("attitude", 4, track.error.attitude);
  auto& velocity = column("angular_velocity", 3, track.error.angular_velocity);
  auto& momentum = column("angular_momentum", 3, track.error.angular_momentum);
  auto& rate = column("rotor_rate", 1, track.error.rotor_rate);
  auto& angle = column("rotor_angle", 1, track.error.rotor_angle);
  auto& lyapunov = column("lyapunov", 1, track.error.lyapunov);
  for (const State<double>& state : track.states) {
    const Vec3<double> Omega = body.angular_velocity(state.momentum, state.axial_momentum);
    const Quat<double>& q = state.attitude;
    attitude.insert(attitude.end(), {q.x, q.y, q.z, q.w});
    velocity.insert(velocity.end(), Omega.begin(), Omega.end());
    momentum.insert(momentum.end(), state.momentum.begin(), state.momentum.end());
    rate.push_back(body.rotor_rate(state.axial_momentum, Omega));
    angle.push_back(state.rotor_angle);
    lyapunov.push_back(body.lyapunov(state.momentum, state.axial_momentum));
  }
  answer.error = track.error.greatest();
}

}  // namespace gyrostat::rotor
