// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/even_times.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("times are even to rounding, and one time is no grid", "[ladder]") {
  std::vector<double> times;
  for (int i = 0; i < 1000; ++i) times.push_back(3 + 0.1 * i);
  CHECK(even(times));
  times[500] += 1e-12;
  CHECK_FALSE(even(times));
  CHECK_FALSE(even(std::vector<double>{1}));
  CHECK_FALSE(even(std::vector<double>{}));
  CHECK_FALSE(even(std::vector<double>{0, 1, gyrostat::nan<double>}));
}
