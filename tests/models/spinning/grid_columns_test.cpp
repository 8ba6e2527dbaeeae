// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/grid_columns.hpp"

#include <numeric>
#include <vector>

#include "catch.hpp"

using gyrostat::spinning::GridColumns;

TEST_CASE("columns from an entry on", "[spinning]") {
  std::vector<double> a(14 * 10);
  std::iota(a.begin(), a.end(), 0.0);
  double* d = a.data();
  const GridColumns<double> all{d,      d + 10, d + 20, d + 30,  d + 40,  d + 50,  d + 60,
                                d + 70, d + 80, d + 90, d + 100, d + 110, d + 120, d + 130};
  const auto later = all.from(3);
  CHECK(*later.p == 3);
  CHECK(*later.theta == 43);
  CHECK(*later.x3 == 123);
  CHECK(*later.G3 == 133);
  auto without = all;
  without.G3 = nullptr;
  CHECK(without.from(5).G3 == nullptr);
}
