// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/orbit_walk.hpp"

#include "catch.hpp"

#include "allocations.hpp"
#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Closed<double> begin(const Problem<double>& p, double spin, double G0) {
  State<double> start;
  start.angular_velocity = {0, 0, spin};
  start.down = {std::sqrt(1 - G0 * G0), 0, G0};
  const auto closed = close_orbit(p, start, 2 * pi<double> / spin, spin, AtSpin<double>{spin});
  REQUIRE(closed);
  return *closed;
}

}  // namespace

TEST_CASE("heavy orbit walk: members close, one after the other, both ways, without heap", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto from = begin(p, 4, .1);
  for (const double sense : {-1.0, 1.0}) {
    OrbitWalk<double> walk(p, from, 1, {0, 0, sense, 0});
    double spin = 4;
    for (int i = 0; i < 12; ++i) {
      const std::size_t before = allocations();
      REQUIRE(walk.advance());
      CHECK(allocations() == before);
      const auto& member = walk.member();
      CHECK(gap(p, member.start, member.period) < 1e-9);
      CHECK(member.start.down == from.start.down);
      CHECK((member.start.angular_velocity[2] - spin) * sense > 0);
      CHECK(walk.spin_slope() * sense > 0);
      spin = member.start.angular_velocity[2];
    }
  }
}

TEST_CASE("heavy orbit walk: past a fold of the spin", "[heavy]") {
  const auto p = unit_body(.55, .8, {0, 0, 1}, 0.);
  OrbitWalk<double> walk(p, begin(p, 4, .1), 1, {0, 0, -1, 0});
  double least = 4;
  while (walk.spin_slope() < 0 && walk.advance()) least = std::min(least, walk.member().start.angular_velocity[2]);
  REQUIRE(walk.spin_slope() > 0);
  CHECK(least == Approx(0.974).epsilon(0.002));
  CHECK(walk.shots() > 0);
  CHECK(walk.counts().steps > 0);
}

TEST_CASE("heavy orbit walk: on its own family where another comes near", "[heavy]") {
  // a top whose centre lies 1e-4 off its axis, where its nutation comes in step with the spin
  const auto p = *Problem<double>::make(
      {0.77520005340819609, 0.7749767866487971, 1.0315288305282593}, 0.40390434700321659,
      {8.4395990284069422e-05, 4.6693742053867553e-05, 0.41130677508657837}, 1.3053467299344408, 0);
  const double c = p.pendulum_rate(), G0 = 0.48583690324930551;
  const auto from = begin(p, 7 * c, G0);
  Vec3<double> ended[2];
  for (const bool small : {false, true}) {
    OrbitWalk<double> walk(p, from, c, {0, 0, -1, 0});
    if (small) walk.limit(1. / 64);
    while (walk.member().start.angular_velocity[2] > 0.424 * c) REQUIRE(walk.advance());
    ended[small] = walk.member().start.angular_velocity / c;
  }
  // on the other family p0 is -1.02 c here, and grows
  for (const auto& w : ended) CHECK(-w[0] == Approx(1).epsilon(.002));
}
