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
