// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/times.hpp"

#include <vector>

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("the times of a motion start at zero or later and do not fall") {
  const auto check = [](std::vector<double> times) { return check_span<double>(times); };
  CHECK(check({}) == Errc::ok);
  CHECK(check({0, 1, 1, 2}) == Errc::ok);
  CHECK(check({-1e-300}) == Errc::not_increasing);
  CHECK(check({2, 1}) == Errc::not_increasing);
  CHECK(check({0, gyrostat::nan<double>}) == Errc::not_finite);
  CHECK(check({infinity<double>}) == Errc::not_finite);
}
