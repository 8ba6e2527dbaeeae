// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/periodic_family.hpp"

#include "at_length.hpp"
#include "catch.hpp"

#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

double spin_of(const PeriodicOrbit<double>& orbit) { return orbit.start.angular_velocity[2]; }

PeriodicFamily<double> family_of(const Problem<double>& p, double G0, const FamilyOptions<double>& options = {}) {
  auto family = periodic_family(p, 5., G0, options);
  REQUIRE(family);
  return std::move(family).value();
}

}  // namespace

TEST_CASE("heavy periodic family: members close and follow one another", "[heavy]") {
  const auto p = unit_body(1.6, 1.3, {.36, -.48, .8}, .5);
  const auto family = family_of(p, .1);
  CHECK(family.slow_rate == Approx(1));
  REQUIRE(family.members.size() > 20);
  for (std::size_t i = 0; i < family.members.size(); ++i) {
    const auto& m = family.members[i];
    CHECK(m.closure < 1e-9);
    CHECK(m.start.down[1] == 0);
    CHECK(m.start.down[2] == .1);
    if (i % 8 == 0) CHECK(gap(p, m.start, m.period) < 1e-9);
    if (i > 0) CHECK((m.start.angular_velocity - family.members[i - 1].start.angular_velocity).norm() < 0.5);
  }
}

TEST_CASE("heavy periodic family: where families end", "[heavy][length]") {
  SECTION("a flat pendulum: r0 = 2 c") {
    std::vector bodies{unit_body(.55, .8, {1, 0, 0}, 0.)};
    if (at_length()) bodies.push_back(unit_body(1.6, 1.3, {1, 0, 0}, 0.));
    for (const auto& p : bodies) {
      const auto family = family_of(p, 0);
      CHECK(spin_of(family.members.back()) == Approx(2).epsilon(1e-6));
      CHECK(family.members.back().period > 15);
    }
  }
  SECTION("axis 3 the least one") {
    const auto family = family_of(unit_body(1.6, 1.3, {.36, -.48, .8}, .5), .1);
    CHECK(family.end == FamilyEnd::homoclinic);
    CHECK(spin_of(family.members.back()) == Approx(1.482).epsilon(.001));
  }
  SECTION("the centre on axis 3: a fold") {
    const auto family = family_of(unit_body(.55, .8, {0, 0, 1}, 0.), .1);
    CHECK(family.end == FamilyEnd::homoclinic);
    REQUIRE(family.folds.size() == 1);
    CHECK(spin_of(family.members[family.folds[0]]) == Approx(.974).epsilon(.001));
    CHECK(spin_of(family.members.back()) > spin_of(family.members[family.folds[0]]));
  }
}

TEST_CASE("heavy periodic family: where the long families end", "[heavy][.long]") {
  SECTION("a generic body: at a trace of 3.4e3 the spin is 0.60 c and the period 11.8/c") {
    const auto family = family_of(unit_body(.55, .8, {.6, .48, .64}, .7), .1);
    CHECK(family.end == FamilyEnd::homoclinic);
    std::size_t i = 0;
    while (family.members[i].trace_minus_4 < 3.4e3) ++i;
    CHECK(spin_of(family.members[i]) == Approx(.60).epsilon(.01));
    CHECK(family.members[i].period == Approx(11.8).epsilon(.01));
  }
  SECTION("a centre in the plane of axes 1, 3: a fold at 1.05 c, and up again beyond 1.59 c") {
    const auto family = family_of(unit_body(.55, .8, {.6, 0, .8}, 0.), .1, {.most_members = 120});
    REQUIRE(family.folds.size() == 1);
    const std::size_t fold = family.folds[0];
    CHECK(spin_of(family.members[fold]) == Approx(1.05).epsilon(.01));
    CHECK(family.members[fold].stability == OrbitStability::stable);
    for (std::size_t i = fold + 2; i < family.members.size(); ++i)
      CHECK(spin_of(family.members[i]) > spin_of(family.members[i - 1]));
    const auto& last = family.members.back();
    CHECK((spin_of(last) > 1.59 && spin_of(last) < 1.63));  // it goes on in tiny steps, ever more unstable
    CHECK(last.period > 13);                                // over twice that at the fold
    CHECK(last.trace_minus_4 > 300);
  }
}

TEST_CASE("heavy periodic family: ends that are asked for", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto down_to = family_of(p, .1, {.last_spin = 2});
  CHECK(down_to.end == FamilyEnd::spin_reached);
  CHECK(spin_of(down_to.members.back()) == 2);
  const auto alone = periodic_orbit(p, 2., .1);
  REQUIRE(alone);
  CHECK(std::abs(down_to.members.back().period - alone->period) < 1e-12);
  CHECK(std::abs(down_to.members.back().trace_minus_4 - alone->trace_minus_4) < 1e-11);

  const auto few = family_of(p, .1, {.most_members = 7});
  CHECK(few.end == FamilyEnd::member_limit);
  CHECK(few.members.size() == 7);

  const auto mirrored = periodic_family(p, -5., .1, {.last_spin = -2});
  REQUIRE(mirrored);
  CHECK(spin_of(mirrored->members.back()) == -2);
  CHECK(mirrored->members.back().period == Approx(alone->period).epsilon(1e-12));

  CHECK(periodic_family(p, 5., .1, {.last_spin = 6}).error() == Errc::out_of_domain);
  CHECK(periodic_family(p, 5., .1, {.last_spin = -1}).error() == Errc::out_of_domain);
  CHECK(periodic_family(p, 5., 1.).error() == Errc::out_of_domain);

  // through r0 = 0: an axis 3 that is stiff, its centre half way up
  const auto through = family_of(unit_body(.78947, .5789, {-.4961, 0, .8682}, 0.), .5);
  CHECK(through.end == FamilyEnd::spin_zero);
}
