// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/swing_orbit.hpp"

#include "catch.hpp"

#include <array>
#include <vector>

#include "allocations.hpp"
#include "gyrostat/math/complete.hpp"
#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"
#include "models/heavy/reference_table.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("heavy swings: small ones have the period of their mode, with a defect of second order", "[heavy]") {
  Tops random(51);
  for (int i = 0; i < 10; ++i) {
    const auto p = random.body(1, i % 2 == 0 ? 0 : 0.5);
    const auto rest = heavy::hanging(p);
    REQUIRE(rest);
    for (const int mode : {0, 1}) {
      const double T = 2 * pi<double> / rest->frequency[std::size_t(mode)];
      std::array<PeriodicOrbit<double>, 2> orbits;
      const std::array<double, 2> angles{0.01, 0.02};
      const auto found = swing_orbits<double>(p, mode, angles, orbits);
      REQUIRE(found);
      REQUIRE(*found == 2);
      const double a = orbits[0].period / T - 1, b = orbits[1].period / T - 1;
      CHECK(std::abs(b) < 1e-3);
      CHECK(std::log2(b / a) == Approx(2).margin(0.15));
    }
  }
}

TEST_CASE("heavy swings: close, rest twice, without vertical momentum, without heap", "[heavy]") {
  Tops random(52);
  int all = 0;
  for (int i = 0; i < 12; ++i) {
    const auto p = random.body(1, i % 2 == 0 ? 0 : 0.5);
    for (const int mode : {0, 1}) {
      const std::size_t before = allocations();
      const auto orbit = swing_orbit(p, mode, 0.8);
      CHECK(allocations() == before);
      if (!orbit) continue;
      ++all;
      CHECK(orbit->start.angular_velocity.norm() == 0);
      CHECK(gap(p, orbit->start, orbit->period) < 1e-11);
      CHECK(later(p, orbit->start, orbit->period / 2).angular_velocity.norm() < 1e-10);
      CHECK(orbit->start.down.dot(heavy::hanging(p)->down) == Approx(std::cos(0.8)).epsilon(1e-14));
    }
  }
  CHECK(all >= 20);
}

TEST_CASE("heavy swings: the reference motion of the softer mode", "[heavy]") {
  const auto made =
      Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 4.617791555485795e-06);
  REQUIRE(made);
  const auto& p = *made;
  // by energy; along a swing it is that of the start
  const double energy = -1.191891020677838670e-01, period = 7.199202857476036554e-01;
  double low = 0.1, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double angle = (low + high) / 2;
    const auto orbit = swing_orbit(p, 0, angle);
    REQUIRE(orbit);
    (p.energy(orbit->start) < energy ? low : high) = angle;
  }
  const auto orbit = swing_orbit(p, 0, low);
  REQUIRE(orbit);
  CHECK(orbit->period == Approx(period).epsilon(1e-12));
  CHECK(orbit->trace_minus_4 == Approx(0.3151323190566089).margin(1e-10));
  CHECK(orbit->stability == OrbitStability::stable);
}

TEST_CASE("heavy swings: a body from the literature turns from stable to unstable", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const std::vector<double> angles{.02, .2, .4, .6, .8, 1., 1.2, 1.4, 1.6};
  std::vector<PeriodicOrbit<double>> orbits(angles.size());
  const auto found = swing_orbits<double>(p, 0, angles, orbits);
  REQUIRE(found);
  CHECK(*found == angles.size());
  CHECK(orbits[0].period == Approx(6.0277).margin(2e-3));
  for (std::size_t i = 1; i < *found; ++i) CHECK(orbits[i].period > orbits[i - 1].period);
  CHECK(orbits[0].stability == OrbitStability::stable);
  CHECK(orbits[5].stability == OrbitStability::stable);  // 1 rad
  CHECK(orbits[7].stability == OrbitStability::unstable);
  CHECK(orbits[7].multipliers.first.re < -1);
  const auto at = swing_orbit(p, 0, 1.3286);
  REQUIRE(at);
  CHECK(at->period == Approx(6.759).margin(1e-3));
  CHECK(at->trace_minus_4 < -2);
}

TEST_CASE("heavy swings: the compound pendulum", "[heavy]") {
  // flat about axis 3, T = 4 K(sin^2(angle/2))/c; axis 2 has the other mode
  const auto p = unit_body(.55, .8, {1, 0, 0}, 0.);
  for (const double angle : {0.1, 1.0, 2.0}) {
    for (const int mode : {0, 1}) {
      const auto orbit = swing_orbit(p, mode, angle);
      REQUIRE(orbit);
      const double m = std::sin(angle / 2) * std::sin(angle / 2), rate = mode == 0 ? 1 : std::sqrt(1 / .8);
      CHECK(orbit->period == Approx(4 * math::complete(math::Modulus<double>{m, 1 - m}).K / rate).epsilon(1e-12));
    }
  }
}

TEST_CASE("heavy swings: errors are honest", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto exact = cast<long double>(p);
  for (const double angle : {0.1, 0.9}) {
    const auto orbit = swing_orbit(p, 0, angle);
    const auto truth = swing_orbit(exact, 0, static_cast<long double>(angle));
    REQUIRE(orbit);
    REQUIRE(truth);
    CHECK(double(std::abs(truth->period - orbit->period)) <= orbit->error.period * orbit->period);
    CHECK(double(std::abs(truth->trace_minus_4 - orbit->trace_minus_4)) <= orbit->error.trace);
    CHECK(orbit->error.period < 1e-12);
  }
}

TEST_CASE("heavy swings: refusals", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  CHECK(swing_orbit(p, 2, 0.5).error() == Errc::out_of_domain);
  CHECK(swing_orbit(p, 0, 0.).error() == Errc::out_of_domain);
  CHECK(swing_orbit(p, 0, gyrostat::nan<double>).error() == Errc::out_of_domain);
  CHECK(swing_orbit(unit_body(.55, .8, {0, 0, 0}, 0.), 0, 0.5).error() == Errc::not_applicable);
  std::array<PeriodicOrbit<double>, 2> orbits;
  CHECK(swing_orbits<double>(p, 0, std::array<double, 2>{0.5, 0.4}, orbits).error() == Errc::not_increasing);
  CHECK(swing_orbits<double>(p, 0, std::array<double, 1>{0.5}, orbits).error() == Errc::out_of_domain);
}
