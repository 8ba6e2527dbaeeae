// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/honesty.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("no margin narrows a distance, and rounding asks for no less than truncation", "[ladder]") {
  constexpr auto& how = honesty::side_by_side;
  CHECK(honesty::margin(1e-9) >= 1);
  CHECK(honesty::margin(epsilon<double>) > honesty::margin(1e-9));
  CHECK(how.looser > 1);
  CHECK(how.least_loose > how.data_change);
  CHECK(honesty::cvode_margin_of_rounding >= honesty::cvode_margin);
}
