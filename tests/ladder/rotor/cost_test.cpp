// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/cost.hpp"

#include "../../models/rotor/bodies.hpp"
#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

TEST_CASE("of a rotor the closed forms cost as many times, the full equations as they are long", "[rotor]") {
  const auto posed = [](std::vector<double> times) {
    Asked data;
    data.angular_velocity = {0.1, 0.2, 3};
    data.times = std::move(times);
    return *make_scene(reference_body(0.05, 30), data);
  };
  const Scene brief = posed({1}), sparse = posed({1000}), dense = posed({1, 2, 3, 4, 5});
  CHECK(cost_of_closed_form(brief) == cost_of_closed_form(sparse));
  CHECK(cost_of_closed_form(brief) < cost_of_closed_form(dense));
  CHECK(cost_of_closed_form(brief) < cost_of_linear_tail(brief));
  CHECK(cost_of_full(sparse) > 100 * cost_of_full(brief));
  CHECK(cost_of_full(sparse) > cost_of_linear_tail(sparse));
}
