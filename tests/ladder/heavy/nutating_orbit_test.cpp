// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/nutating_orbit.hpp"

#include "catch.hpp"

#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

/// omega = 2/5.
Problem<double> nutating_body(double k = .7) { return unit_body(.55, .45 / .538, {.6, .48, .64}, k); }

}  // namespace

TEST_CASE("heavy nutating orbits: close after five turns, and after no fewer", "[heavy]") {
  const auto p = nutating_body();
  for (const int which : {0, 1}) {
    const auto found = nutating_orbit(p, 10., .1, 2, 5, which);
    REQUIRE(found);
    const auto& orbit = found->orbit;
    CHECK(orbit.closure < 1e-12);
    CHECK(gap(p, orbit.start, orbit.period) < 1e-11);
    CHECK(orbit.period == Approx(5 * 2 * pi<double> / 10).epsilon(0.01));
    for (const int turns : {1, 2, 3, 4}) CHECK(gap(p, orbit.start, turns * orbit.period / 5) > 0.02);
    CHECK(orbit.trace_minus_4 == Approx(2).margin(1e-5));
    CHECK(orbit.start.angular_velocity[2] == 10);
  }
  const double stable = nutating_orbit(p, 10., .1, 2, 5, 0)->orbit.trace_minus_4,
               unstable = nutating_orbit(p, 10., .1, 2, 5, 1)->orbit.trace_minus_4;
  CHECK((stable - 2) * (unstable - 2) < 0);
}

TEST_CASE("heavy nutating orbits: the amplitude is the predicted one but for the first order", "[heavy]") {
  double off[2];
  for (const int i : {0, 1}) {
    const auto found = nutating_orbit(nutating_body(), i == 0 ? 10. : 20., .1, 2, 5);
    REQUIRE(found);
    CHECK(found->predicted_amplitude == Approx(0.854084).epsilon(1e-5));
    off[i] = found->amplitude - found->predicted_amplitude;
  }
  CHECK(std::log2(off[0] / off[1]) == Approx(1).margin(0.15));
}

TEST_CASE("heavy nutating orbits: refusals", "[heavy]") {
  CHECK(nutating_orbit(nutating_body(), 10., .1, 2, 4).error() == Errc::out_of_domain);
  CHECK(nutating_orbit(nutating_body(), 10., .1, 0, 5).error() == Errc::out_of_domain);
  CHECK(nutating_orbit(nutating_body(), 10., .1, 2, 5, 2).error() == Errc::out_of_domain);
  // far from the resonance, on the side without and on the side with a large amplitude
  CHECK(nutating_orbit(nutating_body(), 10., .1, 1, 2).error() == Errc::not_applicable);
  CHECK(nutating_orbit(nutating_body(), 10., .1, 1, 5).error() == Errc::not_applicable);
  CHECK(nutating_orbit(unit_body(.7, 1.3, {.6, .48, .64}, .7), 20., .1, 2, 5).error() == Errc::not_applicable);
}
