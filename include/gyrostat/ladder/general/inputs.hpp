// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/inputs.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A general problem as a row of numbers. What it is made of, its wheels and torques, their types and the lengths of their tables, stays; so
/// the list of the numbers is that of one problem, and each row is put into a copy of it.
namespace gyrostat::general {

/// What a number, or a few of them, are: "body", -1, "inertia"; "wheels", 0, "axis", of the first wheel.
struct InputName {
  const char* table;
  int place;  ///< in the list that the table is; -1: it is none
  const char* key;
};

namespace detail {

template <class Visit>
void visit_wheel(Wheel<double>& wheel, int place, Visit&& visit) {
  const auto own = [&](const char* key, auto& value) { visit(InputName{"wheels", place, key}, value); };
  own("axis", wheel.axis), own("axial_inertia", wheel.axial_inertia);
  own("rate", wheel.rate), own("angle", wheel.angle), own("torque", wheel.torque);
  own("friction", wheel.friction), own("slope", wheel.slope), own("no_load_rate", wheel.no_load_rate);
  own("table.times", wheel.table.times), own("table.values", wheel.table.values);
}

template <class Visit>
void visit_torque(Torque<double>& torque, int place, Visit&& visit) {
  const auto own = [&](const char* key, auto& value) { visit(InputName{"torques", place, key}, value); };
  Factor<double>& factor = torque.factor;
  own("vector", torque.vector), own("point", torque.point), own("matrix", torque.matrix);
  if (torque.gradient) own("gradient", *torque.gradient);
  own("table.times", torque.table.times), own("table.values", torque.table.values);
  own("factor_table.times", factor.table.times), own("factor_table.values", factor.table.values);
  own("mean", factor.mean), own("amplitude", factor.amplitude);
  own("rate", factor.rate), own("phase", factor.phase), own("on", factor.on);
}

}  // namespace detail

/// Calls visit(name, value) for all that a problem holds in numbers, in a fixed order: a double, Vec3, Mat3 (row after row), Quat (x, y, z,
/// w), or a vector of doubles or of pairs.
template <class Visit>
void visit_numbers(Problem<double>& of, Visit&& visit) {
  const auto in = [&](const char* table) {
    return [&visit, table](const char* key, auto& value) { visit(InputName{table, -1, key}, value); };
  };
  const auto body = in("body");
  body("inertia", of.inertia), body("mass", of.mass);
  body("centre_of_mass", of.centre_of_mass), body("rotor_momentum", of.rotor_momentum);
  for (std::size_t i = 0; i < of.wheels.size(); ++i) detail::visit_wheel(of.wheels[i], int(i), visit);
  for (std::size_t i = 0; i < of.torques.size(); ++i) detail::visit_torque(of.torques[i], int(i), visit);
  if (of.orbit) {
    const auto orbit = in("orbit");
    orbit("radius", of.orbit->radius), orbit("mu", of.orbit->mu);
    orbit("eccentricity", of.orbit->eccentricity), orbit("true_anomaly", of.orbit->true_anomaly);
    orbit("radial", of.orbit->radial), orbit("along", of.orbit->along);
  }
  const auto field = in("field");
  field("gravity", of.field.gravity), field("down", of.field.down);
  field("flux_density", of.field.flux_density), field("axis", of.field.axis), field("rate", of.field.rate);
  field("strength", of.field.strength), field("radius", of.field.radius);
  const auto start = in("initial");
  start("attitude", of.attitude), start("angular_velocity", of.angular_velocity);
  start("velocity", of.velocity), start("position", of.position);
  if (of.clock != 0) start("retimed", of.retimed);
}

/// Appends the numbers of a value of visit_numbers.
inline void give(const double& value, std::vector<double>& to) { to.push_back(value); }
inline void give(const Vec3<double>& value, std::vector<double>& to) {
  to.insert(to.end(), value.begin(), value.end());
}
inline void give(const Mat3<double>& value, std::vector<double>& to) {
  for (int i = 0; i < 9; ++i) to.push_back(value(i / 3, i % 3));
}
inline void give(const Quat<double>& q, std::vector<double>& to) { to.insert(to.end(), {q.x, q.y, q.z, q.w}); }
inline void give(const std::vector<double>& values, std::vector<double>& to) {
  to.insert(to.end(), values.begin(), values.end());
}
inline void give(const std::vector<std::array<double, 2>>& pairs, std::vector<double>& to) {
  for (const auto& [from, until] : pairs) to.push_back(from), to.push_back(until);
}

namespace detail {

inline void take(InputReader& next, double& value) noexcept { value = next.number(); }
inline void take(InputReader& next, Vec3<double>& value) noexcept { value = next.vector(); }
inline void take(InputReader& next, Mat3<double>& value) noexcept { value = next.tensor(); }
inline void take(InputReader& next, Quat<double>& value) noexcept { value = next.quaternion(); }
inline void take(InputReader& next, std::vector<double>& values) noexcept {
  for (double& value : values) value = next.number();
}
inline void take(InputReader& next, std::vector<std::array<double, 2>>& pairs) noexcept {
  for (auto& [from, to] : pairs) from = next.number(), to = next.number();
}

}  // namespace detail

/// The problem with the numbers of a row in place of its own; the attitude is brought to unit norm. numbers: as many as visit_numbers sees.
inline Problem<double> with_numbers(const Problem<double>& problem, std::span<const double> numbers) {
  Problem<double> made = problem;
  InputReader next(numbers);
  visit_numbers(made, [&](const InputName&, auto& value) { detail::take(next, value); });
  return made;
}

}  // namespace gyrostat::general
