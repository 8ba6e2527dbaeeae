// SPDX-License-Identifier: BSD-3-Clause
// A free body with wheels from Python arguments.
#pragma once

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>

#include "gyrostat/models/free/reduced.hpp"
#include "scene_arguments.hpp"

namespace gyrostat::python {

/// Axes (n, 3), axial inertias and rates of the wheels, and 1 for those that turn freely.
using Wheels = std::tuple<Array, Array, Array, Array>;

inline free::Assembly<double> assembly_of(const Array& inertia, const Array& rotor_momentum, const Wheels& wheels,
                                          const std::optional<Array>& angular_velocity,
                                          const std::optional<Array>& angular_momentum, const Array& attitude) {
  free::Assembly<double> made;
  made.body.inertia = body(inertia).tensor();
  made.body.rotor_momentum = vector("rotor_momentum", rotor_momentum);
  if (angular_velocity.has_value() == angular_momentum.has_value())
    raise("DomainError", "give one of angular_velocity and angular_momentum");
  if (angular_velocity) made.body.angular_velocity = vector("angular_velocity", *angular_velocity);
  else made.body.angular_momentum = vector("angular_momentum", *angular_momentum);
  made.body.momentum_given = angular_momentum.has_value();
  made.body.attitude = quaternion("attitude", attitude);
  const auto& [axes, inertias, rates, turn_freely] = wheels;
  require_shape("wheels: axis", axes, {rates.size(), 3});
  require_shape("wheels: axial_inertia", inertias, {rates.size()});
  require_shape("wheels: type", turn_freely, {rates.size()});
  for (py::ssize_t i = 0; i < rates.size(); ++i) {
    const double* axis = axes.data() + 3 * i;
    made.wheels.push_back(
        {{axis[0], axis[1], axis[2]}, inertias.data()[i], rates.data()[i], turn_freely.data()[i] != 0});
  }
  return made;
}

/// The scene's parts are sound, or DomainError says which is not.
template <class T>
T sound(const Result<T>& made, const free::Assembly<double>& assembly, const free::UnsoundWheel<double>& unsound) {
  if (made) return *made;
  if (unsound.wheel < 0) raise("DomainError", message(made.error()));
  const auto& wheel = assembly.wheels[std::size_t(unsound.wheel)];
  const std::string which = "wheel[" + std::to_string(unsound.wheel) + "]: ";
  if (made.error() == Errc::triangle_inequality)
    raise("DomainError", which + "axial_inertia = " + text(wheel.axial_inertia) +
                             ": the body of this inertia holds less than " + text(unsound.limit) +
                             " of a wheel about this axis beside the wheels before it");
  raise("DomainError", which + message(made.error()));
}

}  // namespace gyrostat::python
