// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/question.hpp"

#include <vector>

#include "catch.hpp"
#include "gyrostat/core/real.hpp"

using namespace gyrostat;

TEST_CASE("times increase from zero on, and the tolerance is a share", "[ladder]") {
  const auto check = [](std::vector<double> times, double tolerance = 1e-6) { return check_times(times, tolerance); };
  CHECK(check({0}) == Errc::ok);
  CHECK(check({0, 1, 2}) == Errc::ok);
  CHECK(check({3, 4}, 0.5) == Errc::ok);
  CHECK(check({}) == Errc::out_of_domain);
  CHECK(check({-1e-300, 1}) == Errc::negative);
  CHECK(check({1, 1}) == Errc::not_increasing);
  CHECK(check({0, gyrostat::nan<double>}) == Errc::not_finite);
  CHECK(check({0, infinity<double>}) == Errc::not_finite);
  for (const double tolerance : {0.0, -1e-6, 1.0}) CHECK(check({0, 1}, tolerance) == Errc::out_of_domain);
  for (const double tolerance : {gyrostat::nan<double>, infinity<double>})
    CHECK(check({0, 1}, tolerance) == Errc::not_finite);
}
