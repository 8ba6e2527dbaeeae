// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/neighbour.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"

namespace neighbour_test {

using namespace gyrostat;
using spinning::neighbour;
using Problem = spinning::Problem<double>;

Problem spinner() {
  Problem p;
  p.inertia = {2, 2, 3};
  p.angular_velocity = {0, 0, 4};
  p.torque = {0, 1e-9, 0};
  return p;
}

TEST_CASE("the rates of two neighbours of a spinner lie on opposite sides of its own", "[spinning]") {
  Problem p = spinner();
  p.angular_velocity = {-0.3, 0.2, 4};
  const Vec3<double> one = neighbour<double>(p, 4, 1e-9, Aside::first).angular_velocity - p.angular_velocity,
                     two = neighbour<double>(p, 4, 1e-9, Aside::second).angular_velocity - p.angular_velocity,
                     three = neighbour<double>(p, 4, 1e-9, Aside::opposite).angular_velocity - p.angular_velocity;
  for (int i = 0; i < 3; ++i) CHECK((one[i] * two[i] < 0 && one[i] * three[i] < 0));
}

TEST_CASE("a neighbour of a spinner keeps its symmetry and its axis", "[spinning]") {
  Problem p = spinner();
  for (const Aside aside : {Aside::first, Aside::second, Aside::opposite}) {
    Problem near = neighbour<double>(p, 4, 1e-12, aside);
    CHECK(near.inertia[0] == near.inertia[1]);
    CHECK(near.inertia[0] != p.inertia[0]);
    CHECK(near.angular_velocity[0] != 0);  // the torque takes it off the axis
    p.torque.setZero();
    near = neighbour<double>(p, 4, 1e-12, aside);
    CHECK((near.angular_velocity[0] == 0 && near.angular_velocity[1] == 0));
    p = spinner();
  }
}

TEST_CASE("what was turned into the axes of the spin errs as its greatest component does", "[spinning]") {
  Problem p = spinner();
  p.torque = {1, 1e-9, 0};
  const double change = 1e-12;
  for (const bool converted : {false, true}) {
    p.converted = converted;
    const auto near = neighbour<double>(p, 4, change, Aside::first);
    CHECK((std::abs(near.torque[1] - p.torque[1]) > .4 * change) == converted);
    CHECK((near.torque[2] != 0) == converted);
    CHECK(std::abs(near.torque[0] - 1) < change);
  }
}

TEST_CASE("next to an unstable axis nothing of what brings a neighbour of a spinner away cancels", "[spinning]") {
  Problem p;
  p.inertia = {0.9, 0.8, 1.5};
  double least = 1;
  for (const Aside aside : {Aside::first, Aside::second, Aside::opposite})
    for (int k = 0; k < 100; ++k) {
      const double turn = 0.0628 * k;
      p.angular_velocity = {27, 4e-5 * std::cos(turn), 4e-5 * std::sin(turn)};
      const Vec3<double> M = p.inertia.cwiseProduct(p.angular_velocity), inverse = p.inertia.cwiseInverse();
      const Vec3<double> leaving = leaving_direction<double>(M, p.angular_velocity, inverse.asDiagonal());
      REQUIRE(leaving.norm() > 0);
      const auto near = neighbour<double>(p, 27, 1e-12, aside);
      const Vec3<double> moved = near.inertia.cwiseProduct(near.angular_velocity) - M;
      least = std::min(least, std::abs(moved.dot(leaving)) / (leaving.norm() * 1e-12 * M.norm()));
    }
  CHECK(least > 0.5);
}

}  // namespace neighbour_test
