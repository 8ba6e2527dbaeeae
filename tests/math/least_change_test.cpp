// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/least_change.hpp"

#include "catch.hpp"

namespace least_change_test {

using gyrostat::math::least_change;

TEST_CASE("two linear functions are put right by the least change", "[math]") {
  // gradients f = (3, 0) and s = (1, 2)
  const auto by = least_change(6., 4., 9., 3., 5.);
  CHECK(3 * (3 * by.first + by.second) == Approx(6));              // f . change
  CHECK((3 * by.first + by.second) + 4 * by.second == Approx(4));  // s . change
}

TEST_CASE("one of two functions is put right where they are not independent", "[math]") {
  const auto first = least_change(6., 1., 9., 6., 4.);
  CHECK(first.first == 6. / 9);
  CHECK(first.second == 0);
  const auto second = least_change(6., 1., 0., 0., 4.);
  CHECK(second.first == 0);
  CHECK(second.second == 0.25);
  const auto none = least_change(6., 1., 0., 0., 0.);
  CHECK(none.first == 0);
  CHECK(none.second == 0);
}

}  // namespace least_change_test
