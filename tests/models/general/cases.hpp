// SPDX-License-Identifier: BSD-3-Clause
// The reference cases of data/general.csv as problems.
#pragma once

#include <array>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gyrostat/models/general/problem.hpp"

namespace general_cases {

using namespace gyrostat;
using namespace gyrostat::general;

/// A row of the table, read from left to right.
template <Real S>
class Reader {
 public:
  explicit Reader(const std::string& line) {
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, ',');) words_.push_back(word);
  }
  const std::string& word() { return words_.at(next_++); }
  bool more() const { return next_ < words_.size(); }
  S number() { return static_cast<S>(std::strtold(word().c_str(), nullptr)); }
  template <class Enum>
  Enum place() {
    return static_cast<Enum>(std::stoi(word()));
  }
  Vec3<S> vector() {
    const S x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Quat<S> attitude() {
    const S x = number(), y = number(), z = number(), w = number();
    return {w, x, y, z};
  }
  Mat3<S> matrix() {
    Mat3<S> m;
    for (int i = 0; i < 3; ++i) m.row(i) = vector();
    return m;
  }
  Table<S> table(std::size_t width) {
    Table<S> made;
    made.between = place<Between>();
    made.holds = number() != 0;
    const auto count = static_cast<std::size_t>(number());
    for (std::size_t i = 0; i < count; ++i) made.times.push_back(number());
    for (std::size_t i = 0; i < count * width; ++i) made.values.push_back(number());
    return made;
  }

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

template <Real S>
struct Case {
  std::string id;
  Problem<S> problem;
  /// Of attitude, angular velocity, angular momentum, rotor rates and angles, velocity, position.
  std::array<double, 7> one_ulp{};
  std::vector<S> times;
  std::vector<State<S>> truth;
  bool has_path = false;
};

template <Real S>
void read_wheel(Reader<S>& row, Problem<S>& problem) {
  Wheel<S> wheel;
  wheel.type = row.template place<WheelType>();
  wheel.axis = row.vector();
  wheel.axis.normalize();
  wheel.axial_inertia = row.number(), wheel.rate = row.number(), wheel.torque = row.number();
  wheel.friction = row.number(), wheel.slope = row.number(), wheel.no_load_rate = row.number();
  problem.wheels.push_back(wheel);
}

template <Real S>
void read_torque(Reader<S>& row, Problem<S>& problem) {
  Torque<S> torque;
  torque.type = row.template place<TorqueType>();
  torque.axes = row.template place<Axes>();
  torque.opposed = row.template place<Opposed>();
  torque.vector = row.vector(), torque.point = row.vector(), torque.matrix = row.matrix();
  if (const S gradient = row.number(); gradient == gradient) torque.gradient = gradient;
  torque.factor.mean = row.number(), torque.factor.amplitude = row.number();
  torque.factor.rate = row.number(), torque.factor.phase = row.number();
  problem.torques.push_back(torque);
}

template <Real S>
void read_surroundings(const std::string& name, Reader<S>& row, Problem<S>& problem) {
  if (name == "orbit") {
    Orbit<S>& orbit = problem.orbit.emplace();
    orbit.radius = row.number(), orbit.mu = row.number();
    orbit.eccentricity = row.number(), orbit.true_anomaly = row.number();
    orbit.radial = row.vector().normalized();
    const Vec3<S> along = row.vector();
    orbit.along = (along - orbit.radial * orbit.radial.dot(along)).normalized();
    return;
  }
  auto& field = problem.field;
  field.gravity = row.number(), field.down = row.vector().normalized();
  field.magnetic = row.template place<MagneticField>();
  field.flux_density = row.vector(), field.axis = row.vector().normalized();
  field.rate = row.number(), field.strength = row.number(), field.radius = row.number();
}

template <Real S>
void read_state(Reader<S>& row, Case<S>& made) {
  made.times.push_back(row.number());
  State<S>& state = made.truth.emplace_back();
  state.attitude = row.attitude();
  state.angular_velocity = row.vector(), state.angular_momentum = row.vector();
  for (std::size_t i = 0; i < made.problem.wheels.size(); ++i) state.rotor_rate[i] = row.number();
  for (std::size_t i = 0; i < made.problem.wheels.size(); ++i) state.rotor_angle[i] = row.number();
  made.has_path = row.more();
  if (made.has_path) state.velocity = row.vector(), state.position = row.vector();
}

template <Real S>
std::vector<Case<S>> cases() {
  std::ifstream file(GYROSTAT_TEST_DATA "/general.csv");
  if (!file) throw std::runtime_error("no general.csv");
  std::vector<Case<S>> made;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    Reader<S> row(line);
    const std::string name = row.word();
    if (name == "case") {
      Case<S>& one = made.emplace_back();
      one.id = row.word();
      Problem<S>& problem = one.problem;
      problem.inertia = row.matrix(), problem.mass = row.number(), problem.centre_of_mass = row.vector();
      problem.fixed = row.number() != 0;
      problem.rotor_momentum = row.vector(), problem.attitude = row.attitude();
      problem.angular_velocity = row.vector(), problem.velocity = row.vector(), problem.position = row.vector();
      continue;
    }
    Case<S>& one = made.back();
    Problem<S>& problem = one.problem;
    if (name == "wheel") read_wheel(row, problem);
    else if (name == "torque") read_torque(row, problem);
    else if (name == "on") {
      const S from = row.number(), to = row.number();
      problem.torques.back().factor.on.push_back({from, to});
    } else if (name == "table") problem.torques.back().table = row.table(3);
    else if (name == "factor") problem.torques.back().factor.table = row.table(1);
    else if (name == "ulp") {
      for (double& size : one.one_ulp) size = static_cast<double>(row.number());
    } else if (name == "at") read_state(row, one);
    else read_surroundings(name, row, problem);
  }
  return made;
}

}  // namespace general_cases
