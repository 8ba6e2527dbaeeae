// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/monitor.hpp"

#include "catch.hpp"

using namespace gyrostat;

TEST_CASE("a monitor that has told to stop once, as of a signal, tells it from then on", "[ladder]") {
  static int asked;
  asked = 0;
  Monitor monitor;
  CHECK_FALSE(monitor.cancelled());
  monitor.stop = []() noexcept { return ++asked == 2; };
  CHECK_FALSE(monitor.cancelled());
  for (int i = 0; i < 3; ++i) CHECK(monitor.cancelled());
  CHECK(asked == 2);
  CHECK(monitor.cancel);
}

TEST_CASE("a monitor that another thread cancels asks nobody else", "[ladder]") {
  static int asked;
  asked = 0;
  Monitor monitor;
  monitor.stop = []() noexcept { return ++asked > 0; };
  monitor.cancel = true;
  CHECK(monitor.cancelled());
  CHECK(asked == 0);
}
