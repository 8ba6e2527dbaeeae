// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/honesty.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("no margin narrows a distance, and companions are better than the answer", "[ladder]") {
  constexpr auto& how = honesty::side_by_side;
  CHECK(how.margin >= 1);
  CHECK(how.tighter > 1);
  CHECK(how.data_change >= 1);
  CHECK(honesty::cvode_margin_of_rounding >= honesty::cvode_margin);
}

namespace {

/// Whether truncation cannot be near to what two changes of a number make of it: so near to both that five distances were less than it.
bool are_apart(double one, double other) {
  return std::abs(one - other) >= 0.5 * std::max(std::abs(one), std::abs(other));
}

}  // namespace

TEST_CASE("no number of the data is moved nearly alike in both companions", "[ladder]") {
  const auto check = [](const auto& shifts) {
    for (std::size_t i = 0; i < std::size(shifts[0]); ++i) {
      CAPTURE(i, shifts[0][i], shifts[1][i]);
      CHECK(are_apart(shifts[0][i], shifts[1][i]));
    }
  };
  check(honesty::directions);
  check(honesty::moment_shifts);
  check(honesty::tensor_shifts);
  check(honesty::number_shifts);
}
