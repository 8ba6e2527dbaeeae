// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "gyrostat/ladder/deceleration/scene.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/models/deceleration/regime.hpp"

namespace gyrostat::deceleration {

/// What a rung finds at the asked times, in principal axes. Empty columns are not known to the rung.
struct Track : Outcome {
  std::vector<double> norm, energy, k2;
  std::vector<Regime> regime;
  std::vector<Vec3<double>> momentum;
  std::vector<Quat<double>> attitude;  ///< principal axes to inertial
  double stop_time = nan<double>;      ///< s; infinite: never; NaN: not known

  /// Estimated greatest errors in units of the columns.
  double norm_error = 0, energy_error = 0, k2_error = 0, momentum_error = 0, attitude_error = 0;
  double velocity_error = nan<double>;  ///< relative; NaN: as momentum_error implies
  double stop_error = 0;                ///< relative
};

namespace detail {

inline double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

inline double relative(double error, double size) { return size > 0 ? error / size : error > 0 ? 1.0 : 0.0; }

}  // namespace detail

/// Leaves out what alone would miss the tolerance, where the rest is worth having and nobody named the rung: M and with it
/// omega, whose phase is the hardest; and a stop that lies behind the times asked for.
inline void withhold(Track& track, const Scene& scene) {
  const double tolerance = scene.data().tolerance;
  if (scene.data().model != Model::any || scene.data().wants_attitude) return;
  if (track.stop_error > tolerance && track.stop_time > scene.data().times.back()) {
    track.warn("stop-withheld",
               "the stop lies behind the times asked for and its time misses the tolerance; ask for times up to it",
               track.stop_time);
    track.stop_time = nan<double>;
  }
  if (track.momentum.empty()) return;
  double size = 0, spin = 0;
  for (const Vec3<double>& M : track.momentum) {
    size = std::max(size, M.norm());
    spin = std::max(spin, scene.problem().angular_velocity(M).norm());
  }
  const double error = std::max(detail::relative(track.momentum_error, size),
                                detail::relative(track.momentum_error * scene.problem().inverse_inertia[2], spin));
  if (error <= tolerance) return;
  track.momentum.clear();
  track.warn("phase-withheld",
             "the vectors are left out: their error is over the tolerance, that of the slow columns need not be",
             error);
}

/// The columns of an answer, in the caller's axes. The answer's error is the greatest of all columns and of the stop time.
inline void fill(Answer& answer, const Scene& scene, const Track& track) {
  const auto& problem = scene.problem();
  const std::size_t n = scene.data().times.size();
  answer.times = scene.data().times;
  answer.warnings = track.warnings;
  answer.counts = track.counts;
  if (!std::isnan(track.stop_time)) answer.quantities.push_back({"stop_time", 1, {track.stop_time}, track.stop_error});
  const auto scalars = [&](const char* name, const std::vector<double>& values, double error) {
    if (!values.empty()) answer.columns.push_back({name, 1, values, error});
  };
  if (!track.momentum.empty()) {
    Column M{"angular_momentum", 3, {}, 0}, w{"angular_velocity", 3, {}, 0};
    double size = 0, spin = 0;
    for (const Vec3<double>& M_P : track.momentum) {
      const Vec3<double> w_P = problem.angular_velocity(M_P);
      const Vec3<double> M_B = scene.R_BP() * M_P, w_B = scene.R_BP() * w_P;
      M.values.insert(M.values.end(), M_B.begin(), M_B.end());
      w.values.insert(w.values.end(), w_B.begin(), w_B.end());
      size = std::max(size, M_P.norm());
      spin = std::max(spin, w_P.norm());
    }
    M.error = detail::relative(track.momentum_error, size);
    w.error = std::isnan(track.velocity_error)
                  ? detail::relative(track.momentum_error * problem.inverse_inertia[2], spin)
                  : track.velocity_error;
    answer.columns.push_back(std::move(M));
    answer.columns.push_back(std::move(w));
  }
  scalars("angular_momentum_norm", track.norm, detail::relative(track.norm_error, detail::greatest(track.norm)));
  scalars("energy", track.energy, detail::relative(track.energy_error, detail::greatest(track.energy)));
  scalars("modulus_squared", track.k2, track.k2_error);
  if (!track.regime.empty()) {
    Column regime{"regime", 1, {}, nan<double>};
    for (const Regime r : track.regime) regime.values.push_back(double(r));
    answer.columns.push_back(std::move(regime));
  }
  if (!track.attitude.empty()) {
    Column q{"attitude", 4, {}, track.attitude_error};
    q.values.reserve(4 * n);
    const Quat<double> q_PB = conjugate(from_matrix(scene.R_BP()));
    for (const Quat<double>& q_IP : track.attitude) {
      const Quat<double> q_IB = normalised(q_IP * q_PB);
      q.values.insert(q.values.end(), {q_IB.x, q_IB.y, q_IB.z, q_IB.w});
    }
    answer.columns.push_back(std::move(q));
  }

  // The greatest of all, NaN if any is.
  answer.error = 0;
  const auto count = [&](double error) {
    if (!(error <= answer.error) && !std::isnan(answer.error)) answer.error = error;
  };
  for (const Column& column : answer.columns)
    if (column.name != std::string_view("regime")) count(column.error);
  if (!std::isnan(track.stop_time)) count(track.stop_error);
}

}  // namespace gyrostat::deceleration
