// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/cost.hpp"

#include "catch.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("of a spinning body second order costs less where turns are many and times are few", "[spinning]") {
  Problem<double> p;
  p.inertia = {8.7, 8.6, 11.1};
  p.angular_velocity = {0, 0, 1};
  p.torque = {1e-3, 0, 0};
  const auto sparse = posed(p, 1000, 1e-6, any_rung, 10), dense = posed(p, 10, 1e-6, any_rung, 1000);
  CHECK(cost_of_linear(sparse) < cost_of_second_order(sparse));
  CHECK(cost_of_second_order(sparse) < cost_of_full(sparse));
  CHECK(cost_of_full(dense) < 1.2 * cost_of_second_order(dense));
  CHECK(cost_of_picard(dense) == infinity<double>);
  p.torque[2] = 1e-3;  // Taylor series of fewer equations
  const auto axial = posed(p, 1000, 1e-6, any_rung, 10);
  CHECK(cost_of_linear(axial) < cost_of_full(axial));
}
