// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/scene.hpp"

#include "../../models/rotor/bodies.hpp"
#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

TEST_CASE("a rotor scene checks what it is given", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  Asked good;
  good.times = {0, 1, 2};
  good.attitude = {2, 0, 0, 0};
  good.angular_velocity = {0.1, 0.2, 0.3};
  good.rotor_rate = 4;
  const auto scene = make_scene(body, good);
  REQUIRE(scene);
  CHECK(scene->start().attitude == Quat<double>{1, 0, 0, 0});
  CHECK(scene->start().momentum.isApprox(body.inertia() * good.angular_velocity + 0.35 * 4 * body.axis(), 1e-15));

  const auto failure = [&](auto change) {
    Asked data = good;
    change(data);
    return make_scene(body, data).error();
  };
  CHECK(failure([](auto& d) {
          d.angular_velocity *= 1e-160;
          d.rotor_rate = 0;
        }) == Errc::ok);  // beside the motor's
  CHECK(failure([](auto& d) { d.angular_velocity *= 1e155; }) == Errc::beyond_range);
  CHECK(failure([](auto& d) { d.times.clear(); }) == Errc::out_of_domain);
  CHECK(failure([](auto& d) { d.times = {-1, 0}; }) == Errc::negative);
  CHECK(failure([](auto& d) { d.times = {0, 0}; }) == Errc::not_increasing);
  CHECK(failure([](auto& d) { d.times = {0, gyrostat::nan<double>}; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.times = {0, infinity<double>}; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.tolerance = 0; }) == Errc::out_of_domain);
  CHECK(failure([](auto& d) { d.tolerance = 1; }) == Errc::out_of_domain);
  CHECK(failure([](auto& d) { d.tolerance = gyrostat::nan<double>; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.angular_velocity[2] = gyrostat::nan<double>; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.rotor_rate = infinity<double>; }) == Errc::not_finite);
  CHECK(failure([](auto& d) { d.attitude = {0, 0, 0, 0}; }) == Errc::zero_vector);
  CHECK(failure([](auto& d) { d.attitude.x = gyrostat::nan<double>; }) == Errc::not_finite);
}
