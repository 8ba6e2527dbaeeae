// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gyrostat/ladder/deceleration/hand_over.hpp"

namespace gyrostat::deceleration {

namespace detail {

GYROSTAT_COMPILED_ONCE double opposed_error(const Problem<double>& problem, const SlowError<double>& error,
                                            double carrier) noexcept {
  if (problem.law == Law::total) return error.norm;
  return std::min(std::sqrt(2 * error.energy / problem.inverse_inertia[0]),
                  error.energy / (problem.inverse_inertia[0] * carrier));
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Errc hand_over(Track& track, const Scene& scene, const Vec3<double>& M, double begin,
                                      const SlowError<double>& error, Monitor* monitor) {
  const auto& times = scene.question().times;
  const double tolerance = scene.goal().tightest;
  Problem<double> problem = scene.problem();
  problem.momentum = M;
  std::vector<double> rest(times.begin() + std::ptrdiff_t(track.states.size()), times.end());
  for (double& t : rest) t = std::max(0.0, t - begin);
  // What the control opposes is late by its own error over the weakest control.
  const double late =
      detail::opposed_error(problem, error, (M - problem.rotor_momentum).norm()) / final_torque(scene).least;
  if (rest.empty() && scene.question().rung == any_rung && !scene.needs_stop() && late > tolerance * 2 * begin) {
    detail::warn_of_stop_withheld(track, scene);
    return Errc::ok;
  }
  const auto solve = [&] { return full_motion_track(problem, rest, tolerance, {}, true, nullptr, monitor); };
  const Track full = solve();
  if (full.failure != Errc::ok) return full.failure;
  const Vec3<double> flow = cross<double>(M, problem.angular_velocity(M));
  if (flow.norm() > 0) problem.momentum = (M + error.vector * flow.normalized()).normalized() * M.norm();
  const Track near = solve();
  if (near.failure != Errc::ok) return near.failure;

  if (std::isnan(full.stop_time)) track.warn(warning::stop_unknown);
  track.stop_time = begin + full.stop_time;
  if (std::isfinite(full.stop_time)) {
    track.stop_error =
        (late + 2 * std::abs(full.stop_time - near.stop_time) + full.stop_error * full.stop_time) / track.stop_time;
  }
  if (!rest.empty()) {
    Comparison both(Row<double>{problem});
    double k2 = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      both.add(full.states[i], near.states[i]);
      if (full.states[i].regime != near.states[i].regime) k2 = 1;
    }
    ColumnErrors<double> grown = 2 * both.difference();
    grown[column::modulus_squared] = std::max(grown[column::modulus_squared], 2 * k2);
    grown += full.error;
    grown[column::angular_momentum] += error.vector;
    grown[column::angular_momentum_norm] += error.norm;
    grown[column::energy] += error.norm * problem.angular_velocity(M).norm() + error.energy;
    grown[column::modulus_squared] += error.k2;
    track.error.raise(grown);
    track.error[column::modulus_squared] = std::min(1.0, track.error[column::modulus_squared]);
    track.know_momentum(problem, track.error[column::angular_momentum]);
  }
  track.states.insert(track.states.end(), full.states.begin(), full.states.end());
  track.counts += full.counts;
  track.counts += near.counts;
  return Errc::ok;
}

}  // namespace gyrostat::deceleration
