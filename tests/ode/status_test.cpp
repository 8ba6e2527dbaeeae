// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/status.hpp"

#include "catch.hpp"

#include <cstring>

using gyrostat::ode::Counts;
using gyrostat::ode::Status;

TEST_CASE("every ending of an integration has its own sentence") {
  constexpr Status all[] = {Status::reached,        Status::event,      Status::step_limit,
                            Status::step_underflow, Status::not_finite, Status::cancelled};
  for (const Status a : all) {
    CHECK(std::strcmp(message(a), "unknown status") != 0);
    for (const Status b : all) {
      if (a != b) CHECK(std::strcmp(message(a), message(b)) != 0);
    }
  }
}

TEST_CASE("work adds up") {
  Counts total{1, 2, 3};
  total += Counts{10, 20, 30};
  CHECK(total.rhs == 11);
  CHECK(total.steps == 22);
  CHECK(total.rejected == 33);
}
