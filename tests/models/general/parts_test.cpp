// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/parts.hpp"

#include "catch.hpp"

namespace general_parts_test {

using namespace gyrostat;
using namespace gyrostat::general;

TEST_CASE("one direction is enough for all that lies along it", "[general]") {
  Directions<double> directions;
  directions.need({0, 0, 0});
  CHECK(directions.count == 0);
  directions.need({0, 0, -3});
  directions.need({0, 0, 0.1});
  CHECK(directions.count == 1);
  CHECK(directions.of[0] == Vec3<double>(0, 0, -1));
  CHECK(directions.share(0, {1, 2, 3}) == -3);
  directions.need({0, 1e-12, 1});
  CHECK(directions.count == 3);
  CHECK(directions.of[1] == Vec3<double>(0, 1, 0));
  // a tiny torque in another direction is one
  Directions<double> two;
  two.need({1, 0, 0});
  two.need({0, 1e-30, 0});
  CHECK(two.count == 3);
}

TEST_CASE("the normal of an orbit is a direction", "[general]") {
  Terms<double> terms;
  terms.orbital[2] = Mat3<double>::Identity();
  Directions<double> directions;
  const Vec3<double> normal(0, 0.6, 0.8);
  add_directions(directions, terms, normal);
  CHECK(directions.count == 1);
  const Part<double> part(terms, directions, normal);
  CHECK(part.has_directions);
  CHECK_FALSE(part.is_nonlinear());
  const auto torque = part.direction[0] * row<double>({1, 2, 3});
  for (int i = 0; i < 3; ++i) CHECK(torque[i] == Approx(i + 1));
}

TEST_CASE("a part knows what is in it", "[general]") {
  const Directions<double> none;
  const auto made = [&](auto&& change) {
    Terms<double> terms;
    change(terms);
    return Part<double>(terms, none, {0, 0, 1});
  };
  CHECK_FALSE(made([](auto& t) { t.body = {1, 2, 3}; }).moves());
  CHECK(made([](auto& t) { t.by_rate(0, 1) = 1; }).moves());
  CHECK_FALSE(made([](auto& t) { t.by_rate(0, 1) = 1; }).is_nonlinear());
  CHECK(made([](auto& t) { t.gradient = 1; }).is_nonlinear());
  CHECK(made([](auto& t) { t.eddy(1, 1) = 1; }).is_nonlinear());
  CHECK(made([](auto& t) { t.brake_carrier[1] = 1; }).is_nonlinear());

  Sees sees;
  Terms<double> terms;
  terms.eddy(0, 0) = 1, terms.force_inertial[1] = 2;
  sees.add(terms);
  CHECK(sees.field);
  CHECK(sees.field_rate);
  CHECK(sees.force);
  CHECK_FALSE(sees.body_force);
  CHECK_FALSE(sees.orbit_axes);
  CHECK_FALSE(sees.orbit_gradient);
}

}  // namespace general_parts_test
