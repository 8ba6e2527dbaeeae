// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace linear_table {

using gyrostat::spinning::Problem;
using gyrostat::spinning::State;

/// One row of tests/data/spinning_linear.csv; see spinning_linear.py.
struct Row {
  std::string name;
  Problem<double> problem;
  double t;
  std::array<long double, 13> truth;  ///< p, q, psi, phi, theta, G (2), v (3), x (3)
};

inline std::vector<Row> read() {
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/spinning_linear.csv");
  REQUIRE(file.good());
  std::vector<Row> rows;
  std::string line;
  while (std::getline(file, line)) {
    if (line[0] == '#') continue;
    std::istringstream text(line);
    std::string cell;
    Row row;
    std::getline(text, row.name, ',');
    const auto next = [&] {
      std::getline(text, cell, ',');
      return std::stod(cell);
    };
    auto& p = row.problem;
    for (int i = 0; i < 3; ++i) p.inertia[i] = next();
    p.mass = next();
    p.rotor_momentum = next();
    p.charge_momentum = next();
    for (int i = 0; i < 2; ++i) p.torque[i] = next();
    for (int i = 0; i < 3; ++i) p.force[i] = next();
    for (int i = 0; i < 3; ++i) p.angular_velocity[i] = next();
    p.angles.psi = next();
    p.angles.phi = next();
    p.angles.theta = next();
    for (int i = 0; i < 3; ++i) p.velocity[i] = next();
    for (int i = 0; i < 3; ++i) p.position[i] = next();
    row.t = next();
    for (long double& value : row.truth) {
      std::getline(text, cell, ',');
      value = std::strtold(cell.c_str(), nullptr);
    }
    rows.push_back(row);
  }
  REQUIRE(rows.size() > 200);
  return rows;
}

/// The 13 outputs in the order of the table.
template <class Scalar>
std::array<long double, 13> outputs(const State<Scalar>& s) {
  return {s.angular_velocity[0], s.angular_velocity[1], s.angles.psi,  s.angles.phi,  s.angles.theta,
          s.momentum_I[0],       s.momentum_I[1],       s.velocity[0], s.velocity[1], s.velocity[2],
          s.position[0],         s.position[1],         s.position[2]};
}

/// First and second output of each quantity; the same twice: one alone.
inline constexpr int quantities[8][2] = {{0, 1}, {2, 3}, {4, 4}, {5, 6}, {7, 8}, {9, 9}, {10, 11}, {12, 12}};

inline long double size(const std::array<long double, 13>& y, int quantity) {
  const auto [i, j] = quantities[quantity];
  return i == j ? std::abs(y[std::size_t(i)]) : std::hypot(y[std::size_t(i)], y[std::size_t(j)]);
}

/// Difference of a quantity over its size in `truth` or `floor`, whichever is larger; 0/0 = 0.
inline double relative(const std::array<long double, 13>& y, const std::array<long double, 13>& truth, int quantity,
                       long double floor = 0) {
  std::array<long double, 13> apart;
  for (std::size_t i = 0; i < 13; ++i) apart[i] = y[i] - truth[i];
  const long double error = size(apart, quantity);
  return error == 0 ? 0 : double(error / std::max(size(truth, quantity), floor));
}

}  // namespace linear_table
