// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/deceleration/equal_torque_rung.hpp"
#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/ladder/deceleration/scene.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"

/// What the rungs of the family `deceleration` cost, s.
namespace gyrostat::deceleration {

/// By what of the free motion is needed (Unbraked).
inline constexpr FormulaCost equal_torque_cost[] = {{1e-6, 0.05e-6}, {4e-6, 0.2e-6}, {50e-6, 0.2e-6}};
inline constexpr FormulaCost averaged_cost{9e-6, 0.17e-6}, averaged_orbit_cost{110e-6, 1e-6};
inline constexpr FormulaCost averaged_2_cost{13e-6, 0.35e-6}, averaged_2_orbit_cost{0.9e-3, 1e-6};
/// On top, where the motion is followed to its stop.
inline constexpr double averaged_orbit_stop = 200e-6, averaged_2_stop = 200e-6, averaged_2_orbit_stop = 2e-3;
inline constexpr SeriesCost series_cost{5e-6, 3e-6, 0.2e-6, 1};

inline double cost_of_equal_torque(const Scene& scene) noexcept {
  if (!scene.equal_control() || scene.has_rotor()) return equal_torque_cost[0](0);  // refused at once
  return equal_torque_cost[int(unbraked_motion(scene))](scene.question().times.size());
}
inline double cost_of_averaged(const Scene& scene) noexcept {
  const std::size_t times = scene.question().times.size();
  if (!needs_orbit(scene)) return averaged_cost(times);
  return averaged_orbit_cost(times) + (goes_to_stop(scene) ? averaged_orbit_stop : 0.0);
}
inline double cost_of_averaged_2(const Scene& scene) noexcept {
  const std::size_t times = scene.question().times.size();
  const bool orbit = needs_orbit(scene);
  const double to_stop = orbit ? averaged_2_orbit_stop : averaged_2_stop;
  return (orbit ? averaged_2_orbit_cost : averaged_2_cost)(times) + (goes_to_stop(scene) ? to_stop : 0.0);
}
inline double cost_of_full(const Scene& scene) noexcept {
  const auto& problem = scene.problem();
  const FullCoefficients<double> f(problem);
  const double size = (problem.momentum - f.offset).norm(), b = scene.least_control(), drag = problem.drag;
  const double last = scene.question().times.back();
  const double stop = EqualTorqueLaw(b, drag, size).stop_time();
  const double span = goes_to_stop(scene) && stop < infinity<double> ? stop : std::min(last, stop);
  const double mean = size / (1 + drag * span) * (stop <= span ? 0.5 : 1.0);
  // the polhode is no faster than the body turns at the start
  const double turning = size > 0 ? problem.angular_velocity(problem.momentum).norm() / size : 0;
  const double own = scene.question().wants_attitude ? problem.inverse_inertia[0]
                                                     : std::min(f.quadratic.cwiseAbs().maxCoeff(), turning);
  const double angle = span * (own * mean + f.linear.norm() + f.rate.norm() + problem.gyro_rate().norm());
  return series_cost(angle, 1e-9, scene.question().times.size()) + (stop <= span ? 100e-6 : 0);
}

/// What a step of the mean equations over an orbit takes, with what the error is made of, s.
inline constexpr double averaged_orbit_step = 30e-6, averaged_2_orbit_step = 120e-6;

/// The number of steps of the mean equations that cost as much as the full equations, `most` at most; `most` for a rung that is named.
inline std::uint64_t steps_worth(const Scene& scene, double step, std::uint64_t most) noexcept {
  const Question& question = scene.question();
  if (question.rung != any_rung) return most;
  return static_cast<std::uint64_t>(std::clamp(cost_of_full(scene) / step, 1.0, static_cast<double>(most)));
}

}  // namespace gyrostat::deceleration
