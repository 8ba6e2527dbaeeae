// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/unstable_orbit.hpp"

#include "catch.hpp"

#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("heavy unstable orbit: agrees with shooting where that is good", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto shot = periodic_orbit(p, 3., .1);
  REQUIRE(shot);
  const auto orbit = unstable_orbit(p, *shot, {.first_nodes = 33});
  REQUIRE(orbit);
  CHECK(orbit->method == OrbitMethod::collocation);
  CHECK(std::abs(orbit->period - shot->period) <= (orbit->error.period + shot->error.period) * shot->period);
  CHECK(std::abs(orbit->trace_minus_4 - shot->trace_minus_4) <= orbit->error.trace + shot->error.trace);
  CHECK(orbit->error.period < 1e-12);
  CHECK(orbit->closure < 1e-13);
}

TEST_CASE("heavy unstable orbit: a trace of some hundreds", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto shot = periodic_orbit(p, 0.65, .1);
  REQUIRE(shot);
  const auto orbit = unstable_orbit(p, *shot);
  REQUIRE(orbit);
  CHECK(orbit->trace_minus_4 > 300);
  CHECK(std::abs(orbit->period - shot->period) <= (orbit->error.period + shot->error.period) * shot->period);
  CHECK(std::abs(orbit->trace_minus_4 - shot->trace_minus_4) <= orbit->error.trace + shot->error.trace);
  CHECK(orbit->error.period < 1e-9);
  CHECK(orbit->closure < 1e-9);
}
