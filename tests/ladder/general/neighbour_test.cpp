// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/neighbour.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "../../models/general/scenes.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/general/inputs.hpp"

namespace general_neighbour_test {

using namespace gyrostat;
using namespace gyrostat::general;
using general::detail::beside;
using general::detail::condition_of;
using general::detail::keeps_axis;

/// All numbers of a problem, list after list.
std::vector<double> numbers_of(Problem<double> problem) {
  std::vector<double> made;
  visit_numbers(problem, [&](const InputName&, const auto& value) { give(value, made); });
  return made;
}

TEST_CASE("a neighbour differs by the amount, in every number that is not zero, and in another direction",
          "[general]") {
  general_scenes::Scenes source(41);
  const double amount = 1e-8;
  for (int i = 0; i < 40; ++i) {
    const auto of = source.next(3).problem;
    const auto one = numbers_of(beside(of, amount, Aside::first)), two = numbers_of(beside(of, amount, Aside::second)),
               given = numbers_of(of);
    REQUIRE(one.size() == given.size());
    std::size_t moved = 0, apart = 0;
    for (std::size_t k = 0; k < given.size(); ++k) moved += one[k] != given[k], apart += one[k] != two[k];
    CHECK(moved >= 9);
    CHECK(apart >= 9);
    const auto near = beside(of, amount, Aside::first);
    // its own, and what the momentum loses beside that of the wheels
    const double lost = Wheels<double>::of(of).inverse.norm() * momenta_of_wheels(of);
    // and next to an unstable rotation what brings the motion away
    const double leaves = 2 * honesty::leaving_shift * Wheels<double>::of(of).inverse.norm() *
                          (of.inertia.norm() * of.angular_velocity.norm() + momenta_of_wheels(of));
    CHECK((near.angular_velocity - of.angular_velocity).norm() <=
          amount * (2 * of.angular_velocity.norm() + 2 * lost + leaves));
    CHECK((near.inertia - of.inertia).norm() <= 4 * amount * of.inertia.norm());
    for (std::size_t k = 0; k < of.wheels.size(); ++k) {
      CHECK(std::abs(near.wheels[k].axial_inertia / of.wheels[k].axial_inertia - 1) <= amount);
      CHECK((near.wheels[k].axis - of.wheels[k].axis).norm() <= 2 * amount);
    }
  }
}

TEST_CASE("times that another clock has moved are moved on, and stay in their order", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 4).asDiagonal();
  p.torques.resize(2);
  p.torques[0].vector = {1, 0, 0};
  p.torques[0].factor.on = {{1, 2}, {2, 3}, {3 + 1e-3, 4}};
  auto& table = p.torques[1].table;
  p.torques[1].type = TorqueType::table;
  table.times = {0, 1, 2, 2 + 1e-3, 3};
  table.values = {0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0};
  p.clock = 1e6, p.retimed = 1e-3;
  const auto lasts = [](const Problem<double>& of) {
    double sum = 0;
    for (const auto& [from, to] : of.torques[0].factor.on) sum += to - from;
    return sum;
  };
  const auto adds = [](const Problem<double>& of) {
    double sum = 0;
    const auto& x = of.torques[1].table;
    for (std::size_t i = 1; i < x.times.size(); ++i)
      sum += (x.times[i] - x.times[i - 1]) * (x.values[3 * i] + x.values[3 * i - 3]) / 2;
    return sum;
  };
  for (const Aside aside : {Aside::first, Aside::second, Aside::opposite}) {
    const auto near = beside(p, 1e-16, aside);
    const double way = aside == Aside::first ? 1 : -1;
    CHECK(way * (lasts(near) - lasts(p)) > 2e-3);
    CHECK(way * (adds(near) - adds(p)) > 1e-3);
    CHECK(!check(near));
    auto exact = p;
    exact.retimed = 0;
    CHECK(beside(exact, 1e-16, aside).torques[0].factor.on == p.torques[0].factor.on);
    CHECK(beside(exact, 1e-16, aside).torques[1].table.times == table.times);
  }
}

TEST_CASE("a neighbour lies turned by what vectors round to in turning, and not where they do not", "[general]") {
  const double amount = 1e-9;
  const auto turned = [&](const Quat<double>& of, Aside aside) {
    Problem<double> p;
    p.inertia = Vec3<double>(3, 2, 4).asDiagonal();
    p.attitude = of;
    const Quat<double> by = conjugate(of) * beside(p, amount, aside).attitude;
    return Vec3<double>(2 * by.x, 2 * by.y, 2 * by.z);
  };
  // axes that are exchanged, or none
  for (const Quat<double>& exact : {Quat<double>{1, 0, 0, 0}, Quat<double>{0, 1, 0, 0}, Quat<double>{0, 0, 0, -1}})
    CHECK(turned(exact, Aside::first).isZero(0));
  // about one axis
  const auto plane = turned({0.8, 0, 0.6, 0}, Aside::first);
  CHECK(plane[0] == 0);
  CHECK(plane[1] != 0);
  CHECK(plane[2] == 0);
  // by as little as a small turn loses
  CHECK(turned({1, 1e-7, 0, 0}, Aside::first).norm() < 1e-5 * amount);
  const Quat<double> any{0.5, -0.1, 0.7, 0.5};
  const auto one = turned(as_unit(any), Aside::first), other = turned(as_unit(any), Aside::opposite);
  CHECK(one.cwiseAbs().minCoeff() > amount);
  CHECK(one.norm() < 8 * amount);
  CHECK((one + other).norm() < 1e-6 * one.norm());
}

TEST_CASE("what a symmetry keeps at zero stays there in a neighbour, and a body at rest rests", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 4).asDiagonal();
  p.angular_velocity = {0, 0, 0.5};
  p.torques.resize(1);
  p.torques[0].vector = {0, 0, 0.1};
  CHECK(keeps_axis(p));
  auto near = beside(p, 1e-9, Aside::first);
  CHECK(near.angular_velocity[0] == 0);
  CHECK(near.angular_velocity[1] == 0);
  CHECK(near.angular_velocity[2] != 0.5);
  CHECK(near.inertia.isDiagonal(0));
  // a torque aside, another frame, or products of inertia end the symmetry
  p.torques[0].vector = {0, 0.1, 0};
  CHECK_FALSE(keeps_axis(p));
  CHECK(beside(p, 1e-9, Aside::first).angular_velocity[0] != 0);
  p.torques[0].vector = {0, 0, 0.1}, p.torques[0].axes = Axes::inertial;
  CHECK_FALSE(keeps_axis(p));
  p.torques[0].axes = Axes::body, p.inertia(0, 1) = p.inertia(1, 0) = 0.1;
  CHECK_FALSE(keeps_axis(p));
  p.angular_velocity.setZero();
  CHECK(beside(p, 1e-9, Aside::first).angular_velocity.isZero(0));
}

TEST_CASE("a tensor that is all but singular without its wheels magnifies its rounding", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 4).asDiagonal();
  CHECK(condition_of(Wheels<double>::of(p)) == 1);
  p.inertia(0, 1) = p.inertia(1, 0) = 0.1;
  CHECK(condition_of(Wheels<double>::of(p)) < 3);
  Wheel<double> wheel;
  wheel.type = WheelType::free, wheel.axis = Vec3<double>(1, 1, 0) / std::sqrt(2.), wheel.axial_inertia = 2.4;
  p.wheels.push_back(wheel);
  CHECK(condition_of(Wheels<double>::of(p)) > 20);
}

TEST_CASE("a neighbour of an unstable rotation leaves it to one side, and another to the other", "[general]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const double amount = 1e-12;
  int seen = 0;
  for (int i = 0; i < 400; ++i) {
    Problem<double> p;
    const auto R = to_matrix(as_unit(Quat<double>{any(random), any(random), any(random), any(random)}));
    const Mat3<double> J = R * Vec3<double>(1, 2, 2.5).asDiagonal() * R.transpose();
    p.inertia = (J + J.transpose()) / 2;
    p.angular_velocity = {any(random), any(random), any(random)};
    const double ratio = 1 + any(random);
    p.rotor_momentum = ratio * p.angular_velocity - p.inertia * p.angular_velocity;  // a steady rotation
    const auto wheels = Wheels<double>::of(p);
    const Vec3<double> M = ratio * p.angular_velocity;
    const auto leaving = leaving_direction<double>(M, p.angular_velocity, wheels.inverse);
    if (leaving.isZero(0)) continue;
    ++seen;
    const auto moved = [&](Aside aside) {
      const Vec3<double> by = wheels.reduced * (beside(p, amount, aside).angular_velocity - p.angular_velocity);
      return by.dot(leaving) / leaving.norm();
    };
    const double size =
        std::max((p.inertia * p.angular_velocity).cwiseAbs().maxCoeff(), p.rotor_momentum.cwiseAbs().maxCoeff());
    CHECK(moved(Aside::first) > amount * size / 4);
    CHECK(moved(Aside::opposite) < -amount * size / 4);
  }
  CHECK(seen > 20);
}

}  // namespace general_neighbour_test
