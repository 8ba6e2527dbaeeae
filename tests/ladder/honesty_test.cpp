// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/honesty.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("no margin narrows a distance, and companions are better than the answer", "[ladder]") {
  constexpr auto& how = honesty::side_by_side;
  CHECK(how.margin >= 1);
  CHECK(how.tighter > 1);
  CHECK(how.data_change >= 1);
  CHECK(honesty::cvode_margin_of_rounding >= honesty::cvode_margin);
}
