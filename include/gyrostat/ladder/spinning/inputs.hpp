// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <span>

#include "gyrostat/ladder/inputs.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"
#include "gyrostat/rotation/euler_312.hpp"

namespace gyrostat::spinning {

inline constexpr InputKind input_kinds[] = {
    {"body.inertia", 3},      {"body.mass", 1},          {"body.rotor_momentum", 1}, {"field.momentum", 1},
    {"field.charge", 1},      {"field.flux_density", 1}, {"field.arm", 1},           {"field.angle", 1},
    {"torque.body", 3},       {"torque.force", 3},       {"initial.attitude", 4},    {"initial.angular_velocity", 3},
    {"initial.euler_312", 3}, {"initial.velocity", 3},   {"initial.position", 3}};

/// The scene of the numbers of input_kinds; the field is given by its momentum, its parts or not at all, the attitude by a quaternion,
/// angles or not at all. Errors: those of Scene::make; out_of_domain: not so many numbers;
/// zero_vector: a quaternion of nought.
inline Result<Scene> scene_of(std::span<const double> numbers, const Question& question) {
  if (numbers.size() != input_width(input_kinds)) return Errc::out_of_domain;
  InputReader next(numbers);
  Problem<double> problem;
  problem.inertia = next.vector();
  problem.mass = next.number();
  problem.rotor_momentum = next.number();
  const double momentum = next.number(), charge = next.number(), flux_density = next.number(), arm = next.number(),
               angle = next.number();
  if (is_given(momentum)) problem.charge_momentum = momentum;
  if (is_given(charge)) problem.charge_momentum = charge * flux_density * (arm * arm) * std::cos(angle);
  problem.torque = next.vector();
  problem.force = next.vector();
  const Quat<double> attitude = next.quaternion();
  problem.angular_velocity = next.vector();
  Vec3<double> angles = next.vector();
  if (norm(attitude) == 0) return Errc::zero_vector;
  if (is_given(attitude)) angles = angles_312(attitude);
  if (is_given(angles)) problem.angles = {angles[0], angles[1], angles[2]};
  problem.velocity = next.vector();
  problem.position = next.vector();
  return Scene::make(problem, question);
}

}  // namespace gyrostat::spinning
