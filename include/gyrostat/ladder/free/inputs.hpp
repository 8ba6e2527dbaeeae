// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/inputs.hpp"

namespace gyrostat::free {

/// An element of `wheel`: axis, axial inertia, rate, 1 where it turns freely.
inline constexpr InputKind input_kinds[] = {{"body.inertia", 9},
                                            {"body.rotor_momentum", 3},
                                            {"initial.angular_velocity", 3},
                                            {"initial.angular_momentum", 3},
                                            {"initial.attitude", 4},
                                            {"view.axis", 3},
                                            {"view.direction", 3},
                                            {"view.half_angle", 1},
                                            {"wheel", 6, true}};

/// The scene of the numbers of input_kinds; of angular_velocity and angular_momentum one is given. Errors: those of
/// symmetric_part and Scene::make; out_of_domain: numbers of no whole wheel.
inline Result<Scene> scene_of(std::span<const double> numbers, const Question& question) {
  constexpr std::size_t fixed = input_width(input_kinds), each = 6;
  if (numbers.size() < fixed || (numbers.size() - fixed) % each != 0) return Errc::out_of_domain;
  InputReader next(numbers);
  Assembly<double> assembly;
  Problem<double>& body = assembly.body;
  const auto inertia = symmetric_part<double>(next.tensor());
  if (!inertia) return inertia.error();
  body.inertia = *inertia;
  body.rotor_momentum = next.vector();
  const Vec3<double> omega = next.vector(), momentum = next.vector();
  body.momentum_given = !is_given(omega);
  (body.momentum_given ? body.angular_momentum : body.angular_velocity) = body.momentum_given ? momentum : omega;
  body.attitude = next.quaternion();
  ViewRequest view;
  view.axis = next.direction();
  view.direction = next.direction();
  view.half_angle = next.number();
  while (next.left() > 0) {
    Wheel<double> wheel;
    wheel.axis = next.direction();
    wheel.axial_inertia = next.number();
    wheel.rate = next.number();
    wheel.turns_freely = next.number() != 0;
    assembly.wheels.push_back(wheel);
  }
  const auto made = Scene::make(assembly, question);
  return made && is_given(view.axis) ? made->viewed(view) : made;
}

}  // namespace gyrostat::free
