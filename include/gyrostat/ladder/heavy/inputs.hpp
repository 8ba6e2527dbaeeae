// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/ladder/inputs.hpp"

namespace gyrostat::heavy {

inline constexpr InputKind input_kinds[] = {{"body.inertia", 9},
                                            {"body.mass", 1},
                                            {"body.centre_of_mass", 3},
                                            {"field.gravity", 1},
                                            {"field.gravity_gradient", 1},
                                            {"field.centre_distance", 1},
                                            {"initial.angular_velocity", 3},
                                            {"initial.down", 3},
                                            {"initial.attitude", 4},
                                            {"initial.periodic", 2}};

/// The scene of the numbers of input_kinds; of down, attitude and periodic one is given, and of the gradient and the distance of the
/// centre one at most. Errors: those of Body::make and Scene::make; out_of_domain: not so many numbers.
inline Result<Scene> scene_of(std::span<const double> numbers, const Question& question) {
  if (numbers.size() != input_width(input_kinds)) return Errc::out_of_domain;
  InputReader next(numbers);
  const Mat3<double> inertia = next.tensor();
  const double mass = next.number();
  const Vec3<double> centre = next.vector();
  const double gravity = next.number(), gradient = next.number(), distance = next.number();
  if (is_given(distance) && !(distance > 0)) return Errc::not_positive;
  const auto body = Body::make(inertia, mass, centre, gravity,
                               is_given(distance)   ? 3 * (gravity / distance)
                               : is_given(gradient) ? gradient
                                                    : 0);
  if (!body) return body.error();
  Start start;
  start.state.angular_velocity = next.vector();
  const Vec3<double> down = next.direction();
  const Quat<double> attitude = next.quaternion();
  const double spin = next.number(), cosine = next.number();
  Question asked = question;
  if (is_given(down)) start.state.down = down;
  if (is_given(attitude)) {
    start.state.attitude = attitude;
    start.oriented = asked.wants_attitude = true;
  }
  if (is_given(spin)) {
    start.state = {};
    start.periodic = Periodic{spin, cosine};
  }
  return Scene::make(*body, start, asked);
}

/// scene_of, with words of its own for a mass centre that no body can have, where all errors are told by their codes.
struct SceneOf {
  Result<Scene> operator()(std::span<const double> numbers, const Question& question) const {
    return scene_of(numbers, question);
  }
  static const char* why(std::span<const double> numbers) {
    if (numbers.size() != input_width(input_kinds)) return nullptr;
    InputReader next(numbers);
    const Mat3<double> inertia = next.tensor();
    const double mass = next.number();
    const Vec3<double> centre = next.vector(), none(0, 0, 0);
    const auto outside = Body::make(inertia, mass, centre, 0, 0);
    return !outside && outside.error() == Errc::triangle_inequality && Body::make(inertia, mass, none, 0, 0)
               ? "no body with this mass and this inertia about the fixed point has its mass centre there"
               : nullptr;
  }
};

}  // namespace gyrostat::heavy
