// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/monitor.hpp"

#include <thread>

#include "catch.hpp"

TEST_CASE("a monitor starts with nothing done and carries a wish to stop between threads", "[ladder]") {
  gyrostat::Monitor monitor;
  CHECK(monitor.fraction.load() == 0);
  CHECK_FALSE(monitor.cancel.load());
  std::thread([&] { monitor.cancel.store(true); }).join();
  CHECK(monitor.cancel.load());
}
