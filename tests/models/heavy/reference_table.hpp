// SPDX-License-Identifier: BSD-3-Clause
// The rows of tests/data/heavy_<name>.csv (heavy_tables.py says what stands there).
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

struct ReferenceRow {
  std::string id;  ///< empty where the table has none
  std::vector<double> number;

  /// Columns 0 to 8: A, B, C, M, g, x0, y0, z0, N.
  template <Real Scalar = double>
  Problem<Scalar> problem() const {
    const auto v = [this](std::size_t i) {
      return Vec3<double>(number[i], number[i + 1], number[i + 2]).cast<Scalar>();
    };
    const auto made = Problem<Scalar>::make(v(0), Scalar(number[3]), v(5), Scalar(number[4]), Scalar(number[8]));
    REQUIRE(made);
    return *made;
  }
};

/// Rows of tests/data/heavy_NAME.csv, or of the table of the paper, which comes with the package.
inline std::vector<ReferenceRow> reference_rows(const std::string& name, bool with_id = true) {
  const std::string data = GYROSTAT_TEST_DATA;
  std::ifstream file(name == "published" ? data + "/../../python/gyrostat/families/heavy/published.csv"
                                         : data + "/heavy_" + name + ".csv");
  REQUIRE(file);
  std::vector<ReferenceRow> rows;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    ReferenceRow row;
    if (with_id) std::getline(cells, row.id, ',');
    while (std::getline(cells, cell, ',')) row.number.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace gyrostat::heavy
