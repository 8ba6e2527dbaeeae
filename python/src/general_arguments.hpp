// SPDX-License-Identifier: BSD-3-Clause
// A general scene from Python: dicts with one entry for each member of the structures in models/general/problem.hpp, as
// families/general/functions.py makes them.
#pragma once

#include <pybind11/stl.h>

#include <cstddef>
#include <string>

#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "scene_arguments.hpp"

namespace gyrostat::python {

namespace detail {

/// The entries of one dict, by name.
class Entries {
 public:
  Entries(std::string name, const py::dict& entries) : name_(std::move(name)), entries_(entries) {}

  py::object operator[](const char* key) const {
    if (!entries_.contains(key)) raise("DomainError", name_ + " lacks " + key);
    return entries_[key];
  }
  bool has(const char* key) const { return entries_.contains(key) && !entries_[key].is_none(); }
  double number(const char* key) const {
    const double made = PyFloat_AsDouble((*this)[key].ptr());
    if (PyErr_Occurred() != nullptr) PyErr_Clear(), raise("DomainError", name_ + "." + key + ": not a number");
    return made;
  }
  Array array(const char* key) const {
    const auto made = Array::ensure((*this)[key]);
    if (!made) PyErr_Clear(), raise("DomainError", name_ + "." + key + ": not an array of numbers");
    return made;
  }
  Vec3<double> vector(const char* key) const { return python::vector((name_ + "." + key).c_str(), array(key)); }
  Mat3<double> matrix(const char* key) const {
    const Array values = array(key);
    require_shape((name_ + "." + key).c_str(), values, {3, 3});
    Mat3<double> made;
    for (int i = 0; i < 9; ++i) made(i / 3, i % 3) = values.data()[i];
    return made;
  }
  Quat<double> quaternion(const char* key) const { return python::quaternion((name_ + "." + key).c_str(), array(key)); }
  /// The place of a word in the list of them.
  template <class Enum, std::size_t N>
  Enum word(const char* key, const char* const (&words)[N]) const {
    const auto value = (*this)[key].cast<std::string>();
    for (std::size_t i = 0; i < N; ++i)
      if (value == words[i]) return static_cast<Enum>(i);
    raise("DomainError", name_ + "." + key + " = '" + value + "': unknown");
  }
  std::string name(const char* key) const { return name_ + "." + key; }
  Entries part(const char* key) const { return {name_ + "." + key, (*this)[key].cast<py::dict>()}; }

 private:
  std::string name_;
  py::dict entries_;
};

/// times (n,), values (n, width), interpolation, extend; None: no table.
inline general::Table<double> table_of(const Entries& of, const char* key, py::ssize_t width) {
  general::Table<double> made;
  if (!of.has(key)) return made;
  const Entries given = of.part(key);
  const Array times = given.array("times"), values = given.array("values");
  require_shape(given.name("times").c_str(), times, {-1});
  require_shape(given.name("values").c_str(), values, {times.size(), width});
  made.times.assign(times.data(), times.data() + times.size());
  made.values.assign(values.data(), values.data() + values.size());
  made.between = given.word<general::Between>("interpolation", general::between_words);
  made.holds = given["extend"].cast<std::string>() == "hold";
  return made;
}

inline general::Wheel<double> wheel_of(const Entries& given) {
  general::Wheel<double> made;
  made.type = given.word<general::WheelType>("type", general::wheel_words);
  made.axis = given.vector("axis");
  made.axial_inertia = given.number("axial_inertia");
  made.rate = given.number("rate");
  made.angle = given.number("angle");
  made.torque = given.number("torque");
  made.friction = given.number("friction");
  made.slope = given.number("slope");
  made.no_load_rate = given.number("no_load_rate");
  made.table = table_of(given, "table", 1);
  return made;
}

inline general::Torque<double> torque_of(const Entries& given) {
  general::Torque<double> made;
  made.type = given.word<general::TorqueType>("type", general::torque_words);
  made.axes = given.word<general::Axes>("axes", general::axes_words);
  made.opposed = given.word<general::Opposed>("opposed", general::opposed_words);
  made.vector = given.vector("vector");
  made.point = given.vector("point");
  made.matrix = given.matrix("matrix");
  if (given.has("gradient")) made.gradient = given.number("gradient");
  made.table = table_of(given, "table", 3);
  made.factor.table = table_of(given, "factor_table", 1);
  made.factor.mean = given.number("mean");
  made.factor.amplitude = given.number("amplitude");
  made.factor.rate = given.number("rate");
  made.factor.phase = given.number("phase");
  const Array on = given.array("on");
  require_shape(given.name("on").c_str(), on, {-1, 2});
  for (py::ssize_t i = 0; i + 1 < on.size(); i += 2) made.factor.on.push_back({on.data()[i], on.data()[i + 1]});
  return made;
}

inline general::Orbit<double> orbit_of(const Entries& given) {
  general::Orbit<double> made;
  made.radius = given.number("radius");
  made.mu = given.number("mu");
  made.eccentricity = given.number("eccentricity");
  made.true_anomaly = given.number("true_anomaly");
  made.radial = given.vector("radial");
  made.along = given.vector("along");
  if (given.has("surface")) made.surface = given.number("surface");
  return made;
}

inline general::Field<double> field_of(const Entries& given) {
  general::Field<double> made;
  made.gravity = given.number("gravity");
  made.down = given.vector("down");
  made.magnetic = given.word<general::MagneticField>("magnetic", general::field_words);
  made.flux_density = given.vector("flux_density");
  made.axis = given.vector("axis");
  made.rate = given.number("rate");
  made.strength = given.number("strength");
  made.radius = given.number("radius");
  return made;
}

}  // namespace detail

inline general::Problem<double> general_problem(const py::dict& given) {
  const detail::Entries all("scene", given), body = all.part("body"), start = all.part("initial");
  general::Problem<double> made;
  made.inertia = body.matrix("inertia");
  made.mass = body.number("mass");
  made.mass_given = body["mass_given"].cast<bool>();
  made.centre_of_mass = body.vector("centre_of_mass");
  made.fixed = body["fixed"].cast<bool>();
  made.rotor_momentum = body.vector("rotor_momentum");
  std::size_t place = 0;
  for (const py::handle wheel : all["wheels"].cast<py::list>())
    made.wheels.push_back(detail::wheel_of({"wheel[" + std::to_string(place++) + "]", wheel.cast<py::dict>()}));
  place = 0;
  for (const py::handle torque : all["torques"].cast<py::list>())
    made.torques.push_back(detail::torque_of({"torque[" + std::to_string(place++) + "]", torque.cast<py::dict>()}));
  if (all.has("orbit")) made.orbit = detail::orbit_of(all.part("orbit"));
  made.field = detail::field_of(all.part("field"));
  made.attitude = start.quaternion("attitude");
  made.angular_velocity = start.vector("angular_velocity");
  made.velocity = start.vector("velocity");
  made.position = start.vector("position");
  if (all.has("clock")) made.clock = all.number("clock"), made.retimed = all.number("retimed");
  return made;
}

/// DomainError says which wheel or torque is unsound, and why.
[[noreturn]] inline void raise_fault(const general::Problem<double>& problem, Errc code) {
  const general::Fault of_wheel = general::check_wheels(problem), fault = general::check(problem);
  if (!fault) raise("DomainError", message(code));
  if (fault.place < 0) raise("DomainError", fault.why);
  raise("DomainError", (of_wheel ? "wheel[" : "torque[") + std::to_string(fault.place) + "]: " + fault.why);
}

}  // namespace gyrostat::python
