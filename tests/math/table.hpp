// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "gyrostat/math/modulus.hpp"

namespace table {

/// One row of tests/data/elliptic_<name>.csv: the modulus and the numbers after it. See elliptic_tables.py.
struct Row {
  long double small = 0;
  bool of_k2 = true;
  std::vector<long double> value;

  template <class Scalar>
  gyrostat::math::Modulus<Scalar> modulus() const {
    const auto m = of_k2 ? gyrostat::math::Modulus<Scalar>::from_k2(Scalar(small))
                         : gyrostat::math::Modulus<Scalar>::from_kp2(Scalar(small));
    return m;
  }

  /// All numbers of the row are normal numbers of Scalar, or zero.
  template <class Scalar>
  bool fits() const {
    const auto normal = [](long double x) {
      return x == 0 || std::abs(x) > 16 * static_cast<long double>(std::numeric_limits<Scalar>::min());
    };
    return normal(small) && std::all_of(value.begin(), value.end(), normal);
  }
};

inline std::vector<Row> read(const std::string& name) {
  std::ifstream file(std::string(GYROSTAT_TEST_DATA) + "/elliptic_" + name + ".csv");
  REQUIRE(file.good());
  std::vector<Row> rows;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 's') continue;
    std::istringstream cells(line);
    std::string cell;
    Row row;
    for (int column = 0; std::getline(cells, cell, ','); ++column) {
      if (column == 0) row.small = std::strtold(cell.c_str(), nullptr);
      if (column == 1) row.of_k2 = cell == "k2";
      if (column > 1) row.value.push_back(std::strtold(cell.c_str(), nullptr));
    }
    rows.push_back(row);
  }
  REQUIRE(rows.size() > 50);
  return rows;
}

/// Units in the last place of `truth` by which `got` is wrong, the last place as epsilon has it; `slack` is an error of the same kind that is
/// forgiven.
template <class Scalar>
double ulps(Scalar got, long double truth, long double slack = 0) {
  if (static_cast<long double>(got) == truth) return 0;
  const Scalar size = std::abs(static_cast<Scalar>(truth));
  const Scalar spacing = std::nextafter(size, std::numeric_limits<Scalar>::infinity()) - size;
  const Scalar ulp = spacing * (gyrostat::epsilon<Scalar> / std::numeric_limits<Scalar>::epsilon());
  const long double wrong = std::abs(static_cast<long double>(got) - truth);
  const double error = static_cast<double>(wrong / (static_cast<long double>(ulp) + slack));
  return std::isnan(error) ? 1e300 : error;
}

/// The greatest error seen in each of several columns.
struct Worst {
  explicit Worst(std::vector<std::string> names) : names_(std::move(names)), error_(names_.size(), 0.0) {}

  void see(std::size_t column, double error) { error_[column] = std::max(error_[column], error); }
  double of(std::size_t column) const { return error_[column]; }

  std::string text() const {
    std::ostringstream out;
    for (std::size_t i = 0; i < names_.size(); ++i) out << names_[i] << ' ' << error_[i] << "  ";
    return out.str();
  }

 private:
  std::vector<std::string> names_;
  std::vector<double> error_;
};

}  // namespace table
