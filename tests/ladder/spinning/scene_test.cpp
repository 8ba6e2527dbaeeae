// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/scene.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("a spinning scene checks what it is given", "[spinning]") {
  Problem<double> body;
  body.inertia = {8.7, 8.6, 11.1};
  body.mass = 10;
  Question question;
  question.times = {0, 1};
  CHECK(Scene::make(body, question));
  const auto failure = [&](auto change) {
    Problem<double> p = body;
    change(p);
    return Scene::make(p, question).error();
  };
  for (const double bad : {gyrostat::nan<double>, infinity<double>}) {
    CHECK(failure([&](auto& p) { p.inertia[1] = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.mass = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.rotor_momentum = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.charge_momentum = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.torque[2] = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.force[0] = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.angular_velocity[0] = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.angles.phi = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.velocity[1] = bad; }) == Errc::not_finite);
    CHECK(failure([&](auto& p) { p.position[2] = bad; }) == Errc::not_finite);
  }
  CHECK(failure([](auto& p) { p.mass = 0; }) == Errc::not_positive);
  CHECK(failure([](auto& p) { p.inertia[0] = -1; }) == Errc::not_positive);
  CHECK(failure([](auto& p) { p.inertia[2] = 17.31; }) == Errc::triangle_inequality);
  CHECK(failure([](auto& p) { p.inertia = {1, 1, 2}; }) == Errc::ok);
  question.times = {1, 0};
  CHECK(failure([](auto&) {}) == Errc::not_increasing);
}
