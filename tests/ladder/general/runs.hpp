// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "../../models/general/truth.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"

/// Full motions of general scenes, and their truth.
namespace general_runs {

using namespace gyrostat;
using namespace gyrostat::general;

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool slow_build = true;
#else
inline constexpr bool slow_build = false;
#endif

struct Run {
  FullMotionAnswer<double> answer;
  std::vector<State<double>> states;
};

inline Run run(const Problem<double>& problem, const std::vector<double>& times, double tolerance, bool alone = false) {
  Run made;
  made.states.resize(times.size());
  FullMotionOptions<double> options;
  options.tolerance = tolerance, options.step_cap = 1'000'000, options.alone = alone;
  const auto answer = full_motion<double>(problem, times, made.states, options);
  REQUIRE(answer);
  made.answer = *answer;
  return made;
}

inline FullErrors<double> apart(const Problem<double>& problem, const std::vector<double>& times,
                                const std::vector<State<double>>& one, const std::vector<State<double>>& two) {
  const Prepared<double> of(problem, times.back());
  Comparison both{FullRow<double>(of)};
  for (std::size_t i = 0; i < one.size(); ++i) both.add(one[i], two[i]);
  return both.relative(both.difference());
}

inline void check_within(const FullErrors<double>& error, const FullErrors<double>& stated) {
  for (std::size_t k = 0; k < std::size(full_columns); ++k) {
    CAPTURE(full_columns[k].name, error[k], stated[k]);
    CHECK(error[k] <= stated[k]);
  }
}

inline std::vector<State<double>> truth(const Problem<double>& problem, const std::vector<double>& times) {
  const std::vector<long double> wide(times.begin(), times.end());
  std::vector<State<double>> made;
  const auto of = general_truth::cast<long double>(problem);
  for (const auto& state : general_truth::motion<long double>(of, wide, 1e-17L, 20'000))
    made.push_back(general_truth::cast<double>(state));
  return made;
}

/// The scene `stiff-wheel`, with a motor of any slope.
inline Problem<double> wheel_on_a_carrier(double slope) {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5;
  p.angular_velocity = {0.5, 1.1, -0.8};
  auto& wheel = p.wheels.emplace_back();
  wheel.type = WheelType::motor;
  wheel.axis = Vec3<double>(0.750525551894, 0.350245257551, 0.560392412081).normalized();
  wheel.axial_inertia = 0.35, wheel.rate = 24, wheel.slope = slope, wheel.no_load_rate = 25;
  return p;
}

/// Three oblique wheels of very different slopes, with waves, a gradient of an eccentric orbit, tables, intervals, a force.
inline Problem<double> three_wheels(double slope) {
  auto p = wheel_on_a_carrier(0.5);
  for (int k = 0; k < 2; ++k) p.wheels.push_back(p.wheels[0]);
  p.wheels[1].axis = Vec3<double>(-0.3, 1, 0.4).normalized(), p.wheels[2].axis = Vec3<double>(0.1, 0.5, 1).normalized();
  p.wheels[1].slope = slope, p.wheels[1].axial_inertia = 0.1, p.wheels[2].axial_inertia = 0.2;
  auto& driven = p.wheels[2];
  driven.type = WheelType::torque, driven.friction = slope / 30, driven.torque = 12 * driven.friction;
  driven.table = {{1, 2, 3.5}, {0, driven.torque, -driven.torque}, Between::linear, true};
  auto& orbit = p.orbit.emplace();
  orbit.radius = 7e6, orbit.mu = 0.01 * 7e6 * 7e6 * 7e6, orbit.eccentricity = 0.2;
  p.torques.resize(4);
  p.torques[0].vector = {0.3, -0.2, 0.1}, p.torques[0].axes = Axes::inertial;
  p.torques[0].factor.amplitude = 0.5, p.torques[0].factor.rate = 3;
  p.torques[1].type = TorqueType::gravity_gradient;
  p.torques[2].type = TorqueType::table;
  p.torques[2].table = {{0.5, 1.5, 3}, {0.1, 0, 0, 0, 0.5, 0, 0.2, 0.2, 0.2}, Between::cubic, false};
  p.torques[3].type = TorqueType::thrust, p.torques[3].vector = {0.1, 0.2, -0.1}, p.torques[3].point = {0.5, 0, 1};
  p.torques[3].factor.on = {{0.7, 2.2}};
  return p;
}

}  // namespace general_runs
