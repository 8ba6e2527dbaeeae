// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/general_orbit.hpp"

#include "catch.hpp"

#include "allocations.hpp"
#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("heavy general orbit: the reference swing, from a coarse guess", "[heavy]") {
  const auto p =
      Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 4.617791555485795e-06);
  REQUIRE(p);
  State<double> start;
  start.angular_velocity = {1.269674446905596494, 3.559395753500153467, -3.349544177132476556};
  start.down = {6.644084177367007839e-01, 4.953551612529644733e-01, 5.596290902559151913e-01};
  const double period = 7.199202857476036554e-01;
  const auto exact = general_orbit(*p, start, period);
  REQUIRE(exact);
  CHECK(exact->period == Approx(period).epsilon(1e-12));
  CHECK((exact->start.angular_velocity - start.angular_velocity).norm() < 1e-11);
  CHECK(exact->trace_minus_4 == Approx(0.3151323190566089).margin(1e-10));
  CHECK(exact->error.period < 1e-10);

  State<double> off = start;
  off.angular_velocity += Vec3<double>(0.02, -0.01, 0.015);
  const std::size_t before = allocations();
  const auto near = general_orbit(*p, off, 1.01 * period);
  CHECK(allocations() == before);
  REQUIRE(near);
  CHECK(near->closure < 1e-12);
  CHECK(gap(*p, near->start, near->period) < 1e-11);
  CHECK(p->energy(near->start) == Approx(p->energy(off)).epsilon(1e-12));
  CHECK(p->vertical_momentum(near->start) == Approx(p->vertical_momentum(off)).margin(1e-15));
  CHECK(std::abs(near->period / period - 1) < 0.01);
}

TEST_CASE("heavy general orbit: agrees with the one at its spin", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto orbit = periodic_orbit(p, 3., .1);
  REQUIRE(orbit);
  State<double> start = later(p, orbit->start, 0.3 * orbit->period);
  start.down /= start.down.norm();
  const auto again = general_orbit(p, start, orbit->period);
  REQUIRE(again);
  CHECK(again->period == Approx(orbit->period).epsilon(1e-12));
  CHECK(again->trace_minus_4 == Approx(orbit->trace_minus_4).margin(1e-10));
}

TEST_CASE("heavy general orbit: refusals", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  State<double> start;
  start.angular_velocity = {0, 0, 3};
  start.down = {1, 0, 0};
  CHECK(general_orbit(p, start, 0.).error() == Errc::out_of_domain);
  CHECK(general_orbit(p, start, gyrostat::nan<double>).error() == Errc::out_of_domain);
  start.down = {1.1, 0, 0};
  CHECK(general_orbit(p, start, 2.).error() == Errc::out_of_domain);
  start.down = {gyrostat::nan<double>, 0, 0};
  CHECK(general_orbit(p, start, 2.).error() == Errc::not_finite);
}
