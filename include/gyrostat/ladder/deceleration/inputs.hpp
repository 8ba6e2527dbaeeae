// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "gyrostat/ladder/deceleration/scene.hpp"
#include "gyrostat/ladder/inputs.hpp"

namespace gyrostat::deceleration {

inline constexpr InputKind input_kinds[] = {{"body.inertia", 9},
                                            {"body.rotor_momentum", 3},
                                            {"torque.control", 3},
                                            {"torque.drag", 1},
                                            {"torque.law", 1},
                                            {"torque.drag_law", 1},
                                            {"initial.attitude", 4},
                                            {"initial.angular_velocity", 3},
                                            {"initial.angular_momentum", 3}};

/// The scene of the numbers of input_kinds; of angular_velocity and angular_momentum one is given. Errors: those of
/// Inertia::from_tensor and Scene::make; out_of_domain: not so many numbers, or no such law.
inline Result<Scene> scene_of(std::span<const double> numbers, const Question& question) {
  if (numbers.size() != input_width(input_kinds)) return Errc::out_of_domain;
  InputReader next(numbers);
  const auto body = Inertia<double>::from_tensor(next.tensor());
  if (!body) return body.error();
  Setup setup;
  setup.rotor_momentum = next.vector();
  setup.control = next.vector();
  setup.drag = next.number();
  const auto law = next.choice<Law>(2), drag_law = next.choice<Law>(2);
  if (!law || !drag_law) return Errc::out_of_domain;
  setup.law = *law, setup.drag_law = *drag_law;
  Question asked = question;
  const Quat<double> attitude = next.quaternion();
  asked.wants_attitude = is_given(attitude);
  if (asked.wants_attitude) setup.attitude = attitude;
  const Vec3<double> omega = next.vector();
  setup.momentum = next.vector();
  if (is_given(omega)) {
    setup.angular_velocity = omega;
    setup.momentum = body->tensor() * omega + setup.rotor_momentum;
  }
  return Scene::make(*body, setup, asked);
}

}  // namespace gyrostat::deceleration
