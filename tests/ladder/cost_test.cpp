// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/cost.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("a formula costs its set-up and its times", "[ladder]") {
  constexpr FormulaCost cost{3e-6, 1e-7};
  CHECK(cost(0) == 3e-6);
  CHECK(cost(100) == Approx(13e-6));
}

TEST_CASE("a run of series costs more the farther it turns and the shorter its steps are", "[ladder]") {
  constexpr SeriesCost cost{1e-6, 1e-6, 1e-7, 2};
  CHECK(cost(0, 1e-9, 0) == Approx(3e-6));
  CHECK(cost(10, epsilon<double>, 5) == Approx(1e-6 + 22e-6 + 5e-7));
  // a factor of 2^20 in the tolerance is one of two in the steps
  CHECK(cost(10, 0x1p20 * epsilon<double>, 0) == Approx(13e-6));
  CHECK(cost(10, 0, 0) > 1);  // no tolerance at all: more than anything
}
