// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/cost.hpp"

#include <string_view>

#include "scenes.hpp"

using namespace scenes;

TEST_CASE("a deceleration of a few turns is integrated, one of many is averaged", "[deceleration]") {
  Case few(.02, 10);
  few.data.rotor_momentum = {0, .1, 0};
  const Case many(1e-5, 1e4);
  CHECK(cost_of_full(few.scene()) < cost_of_averaged_2(few.scene()));
  CHECK(cost_of_full(many.scene()) > 10 * cost_of_averaged(many.scene()));
  const Answer integrated = few.solve();
  CHECK(std::string_view(integrated.model) == "full");
  CHECK(std::string_view(integrated.tried[0].why) == costs_more);
  CHECK(integrated.tried.back().accepted);
  CHECK(std::string_view(many.with(any_rung, 1e-2).solve().model) == "averaged");
  Case rotor = many;
  rotor.data.rotor_momentum = {0, .1, 0};
  CHECK(cost_of_averaged(rotor.scene()) > cost_of_averaged(many.scene()));
}

TEST_CASE("a stop that is asked for counts in the cost", "[deceleration]") {
  Case c(1e-4, 100);
  c.data.asked = {{column::angular_momentum_norm}};
  const double without = cost_of_full(c.scene());
  c.data.asked.push_back({scalar::stop_time, true});
  CHECK(cost_of_full(c.scene()) > 5 * without);
}

TEST_CASE("a mean motion over an orbit takes no more steps than are worth it", "[deceleration]") {
  Case c(.02, 100);
  c.data.rotor_momentum = {0, .1, 0};
  CHECK(steps_worth(c.scene(), averaged_orbit_step, 5000) < 100);
  CHECK(steps_worth(c.with(rung::averaged, 1e-3).scene(), averaged_orbit_step, 5000) == 5000);
  Case slow(1e-6, 1e6);
  slow.data.rotor_momentum = {0, .1, 0};
  CHECK(steps_worth(slow.scene(), averaged_orbit_step, 5000) == 5000);
}
