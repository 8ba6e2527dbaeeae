// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/models/deceleration/averaging_error.hpp"

namespace gyrostat::deceleration {

/// How many breakdown momenta are left when the full equations take over from the averaged ones: the later, the less the
/// mean equations err there and the more turns the full ones make.
inline double hand_over_share(const Scene& scene) noexcept {
  return std::clamp(std::pow(scene.data().tolerance, -0.25), 8.0, 100.0);
}

namespace detail {

/// Error of what the control opposes, N m s: |M|, or |J omega| = `carrier`, which the energy tells.
inline double opposed_error(const Problem<double>& problem, const SlowError<double>& error, double carrier) noexcept {
  if (problem.law == Law::total) return error.norm;
  return std::min(std::sqrt(2 * error.energy / problem.inverse_inertia[0]),
                  error.energy / (problem.inverse_inertia[0] * carrier));
}

}  // namespace detail

/// Goes on from M (principal axes) at time `begin` with the full equations: appends the samples that the track still
/// lacks, finds the stop, and adds to the track's errors what `error` at the hand-over grows to, as a neighbour shows
/// that starts as far away along its orbit as the phase may be wrong.
inline Errc hand_over(Track& track, const Scene& scene, const Vec3<double>& M, double begin,
                      const SlowError<double>& error, Monitor* monitor) {
  const auto& times = scene.data().times;
  Problem<double> problem = scene.problem();
  problem.momentum = M;
  std::vector<double> rest(times.begin() + std::ptrdiff_t(track.momentum.size()), times.end());
  for (double& t : rest) t = std::max(0.0, t - begin);
  // What the control opposes is late by its own error over the weakest control.
  const double late =
      detail::opposed_error(problem, error, (M - problem.rotor_momentum).norm()) / final_torque(scene).least;
  if (rest.empty() && scene.data().model == Model::any && late > scene.data().tolerance * 2 * begin) {
    track.warn("stop-withheld", "the stop lies behind the times asked for and its time would miss the tolerance");
    return Errc::ok;
  }
  const auto solve = [&] { return full_motion_track(problem, rest, scene.data().tolerance, true, nullptr, monitor); };
  const Track full = solve();
  if (full.failure != Errc::ok) return full.failure;
  const Vec3<double> flow = cross<double>(M, problem.angular_velocity(M));
  if (flow.norm() > 0) problem.momentum = (M + error.vector * flow.normalized()).normalized() * M.norm();
  const Track near = solve();
  if (near.failure != Errc::ok) return near.failure;

  track.stop_time = begin + full.stop_time;
  if (std::isfinite(full.stop_time)) {
    track.stop_error =
        (late + 2 * std::abs(full.stop_time - near.stop_time) + full.stop_error * full.stop_time) / track.stop_time;
  }
  if (!rest.empty()) {
    double vector = 0, norm = 0, energy = 0, k2 = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      vector = std::max(vector, (full.momentum[i] - near.momentum[i]).norm());
      norm = std::max(norm, std::abs(full.norm[i] - near.norm[i]));
      energy = std::max(energy, std::abs(full.energy[i] - near.energy[i]));
      k2 = std::max(k2, full.regime[i] == near.regime[i] ? std::abs(full.k2[i] - near.k2[i]) : 1.0);
    }
    const double spin = problem.angular_velocity(M).norm();
    track.norm_error = std::max(track.norm_error, error.norm + 2 * norm + full.norm_error);
    track.energy_error =
        std::max(track.energy_error, error.norm * spin + error.energy + 2 * energy + full.energy_error);
    track.k2_error = std::min(1.0, std::max(track.k2_error, error.k2 + 2 * k2 + full.k2_error));
    track.momentum_error = std::max(track.momentum_error, error.vector + 2 * vector + full.momentum_error);
  }
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(track.norm, full.norm);
  append(track.energy, full.energy);
  append(track.k2, full.k2);
  append(track.regime, full.regime);
  append(track.momentum, full.momentum);
  track.counts += full.counts;
  track.counts += near.counts;
  return Errc::ok;
}

}  // namespace gyrostat::deceleration
