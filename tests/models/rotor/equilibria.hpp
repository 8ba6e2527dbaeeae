// SPDX-License-Identifier: BSD-3-Clause
// The steady rotations of the reference data: tests/data/rotor_equilibria.csv.
#pragma once

#include <array>
#include <complex>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"

namespace gyrostat::rotor {

struct ReferencePoint {
  std::string type;
  Vec3<double> direction;
  double spin_rate, level, determinant, tilt_coupling;
  std::array<std::complex<double>, 3> eigenvalues;
  std::string verdict;
};

struct ReferenceSet {
  std::string name;
  Mat3<double> inertia;
  double axial_inertia;
  Vec3<double> axis;
  double slope, no_load_rate, norm, coupling;
  std::vector<ReferencePoint> points;

  Gyrostat<double> gyrostat() const {
    const auto made = Gyrostat<double>::make(inertia, axis, axial_inertia, slope, no_load_rate);
    REQUIRE(made);
    return *made;
  }
};

inline std::vector<ReferenceSet> reference_equilibria() {
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/rotor_equilibria.csv");
  REQUIRE(file.good());
  std::vector<ReferenceSet> sets;
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#') continue;
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
    const auto x = [&](std::size_t i) { return std::stod(cell[i]); };
    if (cell[0] == "set") {
      ReferenceSet s;
      s.name = cell[1];
      s.inertia << x(2), x(5), x(6), x(5), x(3), x(7), x(6), x(7), x(4);
      s.axial_inertia = x(8);
      s.axis = {x(9), x(10), x(11)};
      s.slope = x(12);
      s.no_load_rate = x(13);
      s.norm = x(14);
      s.coupling = x(15);
      sets.push_back(s);
    } else {
      ReferencePoint p{cell[0], {x(1), x(2), x(3)}, x(4), x(5), x(6), x(7), {}, cell[14]};
      for (std::size_t i = 0; i < 3; ++i) p.eigenvalues[i] = {x(8 + 2 * i), x(9 + 2 * i)};
      sets.back().points.push_back(p);
    }
  }
  REQUIRE(sets.size() == 21);
  return sets;
}

}  // namespace gyrostat::rotor
