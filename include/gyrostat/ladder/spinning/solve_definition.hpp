// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/ladder/spinning/cost.hpp"
#include "gyrostat/ladder/spinning/full_rung.hpp"
#include "gyrostat/ladder/spinning/linear_rung.hpp"
#include "gyrostat/ladder/spinning/picard_rung.hpp"
#include "gyrostat/ladder/spinning/second_order_rung.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/models/spinning/pointing.hpp"

namespace gyrostat::spinning {

namespace detail {

/// Greatest angle between body axis 3 and inertial axis 3, rad.
inline double greatest_tilt(std::span<const State<double>> states) noexcept {
  double most = 0;
  for (const State<double>& state : states) {
    const Quat<double>& q = state.attitude;
    most = std::max(most, 2 * std::atan2(std::hypot(q.x, q.y), std::hypot(q.z, q.w)));
  }
  return most;
}

/// What the caller gave, to the bit, in the row at t = 0.
inline void put_start(Answer& answer, const Problem<double>& problem) {
  const auto& [psi, phi, theta] = problem.angles;
  const auto put = [&](std::size_t which, const Vec3<double>& v) {
    gyrostat::put_start(answer, column_kinds[which], {v[0], v[1], v[2]});
  };
  put(column::angular_velocity, problem.angular_velocity);
  put(column::euler_312, {psi, phi, theta});
  put(column::velocity, problem.velocity);
  put(column::position, problem.position);
}

/// The formulas of the mean err by so many times the square of the mean tilt: 1.7 to 4, by the full equations of one stage at spins that make it 0.13 to 0.42 rad.
inline constexpr double mean_error = 4;
/// Mean tilt, rad, from which on they err by one percent or more.
inline constexpr double sound_mean = 0.05;

/// Whether the formulas of the mean are asked for, or nothing is by name.
inline bool asks_for_mean(const Question& question) noexcept {
  return question.asked.empty() ||
         std::any_of(question.asked.begin(), question.asked.end(), [](const AskedQuantity& each) {
           return each.scalar && (each.place == scalar::pointing_error || each.place == scalar::secular_velocity_ratio);
         });
}

inline void tell_scalars(Answer& answer, const Question& question, const Problem<double>& problem, const Track& track) {
  const double nu2 = problem.nutation_squared();
  double mean = nan<double>;
  math::Complex<double> ratio{nan<double>, nan<double>};
  if (problem.torque[2] == 0 && nu2 > 0 && problem.spin() * problem.effective_momentum() != 0) {
    mean = pointing_error(problem);
    ratio = secular_velocity_ratio(problem);
  }
  const auto give = [&](std::size_t which, std::array<double, 3> values, double error = nan<double>) {
    answer.quantities.push_back({&scalar_kinds[which], values, error});
  };
  give(scalar::pointing_error, {mean});
  give(scalar::secular_velocity_ratio, {ratio.re, ratio.im});
  give(scalar::tilt_max, {greatest_tilt(track.states)}, std::fmin(track.tilt_error, track.error[column::attitude]));
  give(scalar::nutation_frequency_squared, {nu2});
  const auto& kind = warning_kinds[warning::mean_of_small_tilt];
  if (mean > sound_mean && asks_for_mean(question))
    answer.warnings.push_back({&kind, kind.text, mean_error * mean * mean});
}

}  // namespace detail

/// Numbers and warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  const Problem<double>& problem = scene.problem();
  detail::put_start(answer, problem);
  const double nu2 = problem.nutation_squared(), r0 = problem.spin();
  if (tells_scalars(scene.question())) detail::tell_scalars(answer, scene.question(), problem, track);

  const auto warn = [&](std::size_t which, double value = nan<double>) {
    answer.warnings.push_back({&warning_kinds[which], warning_kinds[which].text, value});
  };
  const SpinFlags flags = spin_flags(problem);
  if (r0 == 0) warn(warning::no_spin);
  else if (flags.compliant) warn(warning::no_stiffness, problem.effective_momentum());
  else if (flags.resonant) warn(warning::resonance, divisors(problem).difference);
  if (flags.unstable) warn(warning::unstable_spin, nu2);
  if (const double stop = -r0 * problem.inertia[2] / problem.torque[2];
      stop > 0 && stop < scene.question().times.back())
    warn(warning::spin_reversal, stop);
}

/// In the order of rung_kinds.
inline constexpr Rung<Scene, Track> models[] = {{&linear_track, &cost_of_linear},
                                                {&second_order_track, &cost_of_second_order},
                                                {&picard_track, &cost_of_picard},
                                                {&full_track, &cost_of_full}};

GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept { return models[rung].cost(scene); }

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

}  // namespace gyrostat::spinning
