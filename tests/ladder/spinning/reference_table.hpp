// SPDX-License-Identifier: BSD-3-Clause
// The full motions of the reference data (tests/data/spinning_full.csv).
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::spinning {

template <Real S>
struct ReferenceCase {
  std::string name;
  Problem<S> problem;
  std::vector<S> times;
  std::vector<State<S>> states;
};

template <Real S>
std::vector<ReferenceCase<S>> reference_cases() {
  std::ifstream file(GYROSTAT_TEST_DATA "/spinning_full.csv");
  REQUIRE(file);
  std::vector<ReferenceCase<S>> cases;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream in(line);
    std::string name, word;
    std::getline(in, name, ',');
    const auto number = [&] {
      REQUIRE(std::getline(in, word, ','));
      return static_cast<S>(std::strtold(word.c_str(), nullptr));
    };
    // what is given is a double, whatever the scalar
    const auto given = [&] { return static_cast<S>(std::strtod(word.c_str(), nullptr)); };
    const auto next_given = [&] { return number(), given(); };
    const auto vector = [&](auto&& next) {
      const S a = next(), b = next(), c = next();
      return Vec3<S>(a, b, c);
    };
    Problem<S> p;
    p.inertia = vector(next_given);
    p.mass = next_given();
    p.torque = vector(next_given);
    p.force = vector(next_given);
    p.rotor_momentum = next_given();
    p.charge_momentum = number();
    p.angular_velocity = vector(next_given);
    p.angles.psi = next_given();
    p.angles.phi = next_given();
    p.angles.theta = next_given();
    p.velocity = vector(next_given);
    p.position = vector(next_given);
    if (cases.empty() || cases.back().name != name) cases.push_back({name, p, {}, {}});
    cases.back().times.push_back(next_given());
    State<S> state;
    state.angular_velocity = vector(number);
    state.angles.psi = number();
    state.angles.phi = number();
    state.angles.theta = number();
    Mat3<S> R;
    for (int i = 0; i < 3; ++i) R.row(i) = vector(number).transpose();
    state.attitude = from_matrix(R);
    state.momentum_I = vector(number);
    state.velocity = vector(number);
    state.position = vector(number);
    cases.back().states.push_back(state);
  }
  return cases;
}

}  // namespace gyrostat::spinning
