// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/permanent.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostats.hpp"

namespace free_permanent_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Kind;
using gyrostat::free::Motion;
using gyrostat::free::permanent_rotations;
using V = Vec3<double>;

TEST_CASE("permanent rotations are steady, two, four or six, and as many stable as unstable but for two", "[free]") {
  Bodies bodies(41);
  int number[7] = {0, 0, 0, 0, 0, 0, 0};
  for (int i = 0; i < 400; ++i) {
    auto p = bodies.of(Regime::generic, i);
    if (i % 5 == 0) p.rotor_momentum[bodies.axis()] = 0;
    const double R = bodies.scale(-1, 1);
    const auto all = permanent_rotations(p, R);
    REQUIRE(all);
    ++number[all->count];
    int stable = 0, unstable = 0;
    for (int k = 0; k < all->count; ++k) {
      const auto& r = all->rotation[k];
      CAPTURE(i, k, all->count);
      CHECK(r.angular_momentum.norm() == Approx(R));
      CHECK((p.inertia * r.angular_velocity + p.rotor_momentum - r.angular_momentum).norm() <
            1e-11 * (R + p.rotor_momentum.norm()));
      CHECK((r.angular_velocity - r.ratio * r.angular_momentum).norm() < 1e-14 * R * std::abs(r.ratio));
      (r.stable() ? stable : unstable)++;
      // a start beside a stable one stays there, with the period of small oscillations
      if (!r.stable()) continue;
      auto near = p;
      near.angular_velocity = r.angular_velocity + 1e-6 * R * bodies.vector();
      const auto m = Motion<double>::make<DoubleDouble>(near.cast<DoubleDouble>());
      REQUIRE(m);
      const double shift = 1e-6 * R / std::sqrt(r.square);
      if (shift < 1e-5) CHECK(m->period() == Approx(2 * pi<double> / std::sqrt(r.square)).epsilon(1e-2));
    }
    CHECK(stable - unstable == 2);
  }
  CHECK((number[2] > 20 && number[4] > 20 && number[6] > 20));
}

TEST_CASE("without rotors the permanent rotations are those about the principal axes", "[free]") {
  const auto p = Problem<double>::from_moments({4, 3, 2}, {0, 0, 0}, {1, 2, 3});
  const auto all = permanent_rotations(p, 6.);
  REQUIRE(all);
  REQUIRE(all->count == 6);
  const double square[3] = {6. / 4 * 6 / 4 * (4 - 3) * (4 - 2) / 3 / 2, -6. / 3 * 6 / 3 * (4 - 3) * (3 - 2) / 4 / 2,
                            6. / 2 * 6 / 2 * (4 - 2) * (3 - 2) / 4 / 3};
  for (int k = 0; k < 6; ++k) {
    const auto& r = all->rotation[k];
    CHECK(r.square == Approx(square[k / 2]));
    CHECK(std::abs(r.angular_momentum[k / 2]) == Approx(6));
  }
  // the same as the motion itself says
  auto q = p;
  q.angular_velocity = {0, 2, 0};
  CHECK(Motion<double>::make(q)->steady_square() == Approx(square[1]));
  // a dual-spin body: the rotor along axis 1 makes the middle axis a stable one when it is strong
  const auto strong = permanent_rotations(Problem<double>::from_moments({4, 3, 2}, {9, 0, 0}, {1, 2, 3}), 6.);
  CHECK(strong->count == 2);
  for (int k = 0; k < 2; ++k) CHECK(strong->rotation[k].stable());
  CHECK(permanent_rotations(p, 0.).error() == Errc::not_positive);
}

TEST_CASE("permanent: a sphere keeps only M along its rotor momentum", "[free]") {
  CHECK(permanent_rotations(Problem<double>::from_moments({4, 4, 4}, {0, 0, 0}, {1, 2, 3}), 6.).error() ==
        Errc::not_applicable);
  const Vec3<double> l{0.6, 0, -0.8};
  const auto found = permanent_rotations(Problem<double>::from_moments({4, 4, 4}, l, {1, 2, 3}), 6.);
  REQUIRE(found);
  REQUIRE(found->count == 2);
  for (int k = 0; k < 2; ++k) {
    const auto& r = found->rotation[k];
    CHECK((r.angular_momentum - (k == 0 ? 6 : -6) * l).norm() < 1e-15);
    CHECK((4 * r.angular_velocity + l - r.angular_momentum).norm() < 2e-15);
    CHECK((r.ratio * r.angular_momentum - r.angular_velocity).norm() < 1e-15);
    CHECK(r.square == Approx(1. / 16));  // dM/dt = -M x l/J
  }
  // as of a body that is all but one
  const auto near = permanent_rotations(Problem<double>::from_moments({4, 4 + 1e-9, 4 + 2e-9}, l, {1, 2, 3}), 6.);
  REQUIRE(near->count == 2);
  for (int k = 0; k < 2; ++k) CHECK(near->rotation[k].square == Approx(1. / 16));
}

}  // namespace free_permanent_test
