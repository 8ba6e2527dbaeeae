// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "asked.hpp"
#include "catch.hpp"

/// The cases of tests/data/deceleration.csv (deceleration_tables.py says what stands there).
namespace reference {

using V = gyrostat::Vec3<double>;

struct Case {
  std::string id;
  V moments;
  gyrostat::deceleration::Asked data;
  std::vector<double> norm, energy, k2;  ///< averaged to first order
  std::vector<V> full_momentum;
  std::vector<double> full_norm, full_energy;
  double averaged_stop, full_stop;  ///< s; NaN: not known

  bool has_rotor() const { return !data.rotor_momentum.isZero(0); }

  gyrostat::deceleration::Scene scene() const {
    const auto body = gyrostat::Inertia<double>::from_moments(moments[0], moments[1], moments[2]);
    REQUIRE(body);
    const auto made = gyrostat::deceleration::make_scene(*body, data);
    REQUIRE(made);
    return *made;
  }
};

inline std::vector<Case> cases() {
  using gyrostat::deceleration::Law;
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/deceleration.csv");
  REQUIRE(file.good());
  std::vector<Case> all;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    std::string cell, id;
    std::getline(cells, id, ',');
    std::vector<double> x;
    while (std::getline(cells, cell, ',')) x.push_back(std::strtod(cell.c_str(), nullptr));
    REQUIRE(x.size() == 26);
    if (all.empty() || all.back().id != id) {
      Case c;
      c.id = id;
      c.moments = V(x[0], x[1], x[2]);
      c.data.rotor_momentum = V(x[3], x[4], x[5]);
      c.data.control = V(x[6], x[7], x[8]);
      c.data.drag = x[9];
      c.data.law = Law(int(x[10]));
      c.data.drag_law = Law(int(x[11]));
      c.data.momentum = V(x[12], x[13], x[14]);
      c.averaged_stop = x[24];
      c.full_stop = x[25];
      all.push_back(c);
    }
    Case& c = all.back();
    c.data.times.push_back(x[15]);
    c.norm.push_back(x[16]);
    c.energy.push_back(x[17]);
    c.k2.push_back(x[18]);
    c.full_momentum.push_back(V(x[19], x[20], x[21]));
    c.full_norm.push_back(x[22]);
    c.full_energy.push_back(x[23]);
  }
  REQUIRE(all.size() == 12);
  return all;
}

}  // namespace reference
