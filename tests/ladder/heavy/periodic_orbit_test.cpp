// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"

#include "at_length.hpp"
#include "catch.hpp"

#include <utility>

#include "allocations.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"
#include "models/heavy/reference_table.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("heavy periodic orbit: reference motions", "[heavy]") {
  for (const auto& row : reference_rows("periodic")) {
    const auto p = row.problem();
    const auto& x = row.number;
    const auto orbit = periodic_orbit(p, x[9], x[10]);
    INFO(row.id);
    REQUIRE(orbit);
    const auto& w = orbit->start.angular_velocity;
    CHECK(w[2] == x[9]);
    CHECK(orbit->start.down[1] == 0);
    CHECK(orbit->start.down[2] == x[10]);
    CHECK(std::hypot(w[0] - x[11], w[1] - x[12]) < 1e-13 * std::abs(x[9]));
    CHECK(std::abs(orbit->period / x[13] - 1) < 1e-13);
    CHECK(std::abs(orbit->trace_minus_4 - x[14]) < 1e-12);
    CHECK(orbit->stability == OrbitStability::stable);
    CHECK(orbit->closure < 1e-14);
    CHECK(gap(p, orbit->start, orbit->period) < 1e-13);
    CHECK((rotate<double>(conjugate(orbit->start.attitude), {0, 0, -1}) - orbit->start.down).norm() < 1e-15);
  }
}

TEST_CASE("heavy periodic orbit: the stability table around half a nutation a turn", "[heavy]") {
  for (const auto& row : reference_rows("floquet", false)) {
    const auto& x = row.number;
    const auto orbit = periodic_orbit(unit_body(.55, x[1], {.6, .48, .64}, 0.), 1 / x[0], .1);
    REQUIRE(orbit);
    CHECK(std::abs(orbit->trace_minus_4 - x[2]) < 1e-11);
    CHECK(std::abs(orbit->period / x[0] - x[3]) < 1e-12);
    CHECK(std::abs(orbit->start.angular_velocity[0] - x[4]) < 1e-12);
    CHECK(std::abs(orbit->start.angular_velocity[1] - x[5]) < 1e-12);
    CHECK(orbit->stability == (x[2] < -2 ? OrbitStability::unstable : OrbitStability::stable));
    if (x[2] < -2) CHECK(orbit->multipliers.first.re < -1);
  }
}

TEST_CASE("heavy periodic orbit: 500 random bodies at c/r0 = 0.05 close", "[heavy]") {
  std::mt19937 random(5);
  int shots = 0;
  for (int i = 0; i < 500; ++i) {
    const Draw d = draw(random);
    const auto p = d.body();
    const auto orbit = periodic_orbit(p, i % 7 == 0 ? -20. : 20., d.G0);
    REQUIRE(orbit);
    CHECK(orbit->method == OrbitMethod::shooting);
    CHECK(orbit->closure < 1e-13);
    CHECK(orbit->error.period < 1e-13);
    shots += orbit->shots;
    if (i % 10 == 0) CHECK(gap(p, orbit->start, orbit->period) < 1e-13);
  }
  CHECK(shots < 500 * 5);
}

TEMPLATE_TEST_CASE("heavy periodic orbit: in every precision", "[heavy]", float, double, long double) {
  using S = TestType;
  const auto p = unit_body<S>(S(.55L), S(.8L), Vec3<S>(S(.6L), S(.48L), S(.64L)), S(.7L));
  const auto fine =
      unit_body<long double>(S(.55L), S(.8L), Vec3<S>(S(.6L), S(.48L), S(.64L)).template cast<long double>(), S(.7L));
  for (const int spin : {3, 10}) {
    const auto orbit = periodic_orbit(p, S(spin), S(.1L));
    const auto truth = periodic_orbit<long double>(fine, spin, S(.1L));
    REQUIRE(orbit);
    REQUIRE(truth);
    CHECK(orbit->closure < 64 * epsilon<S>);
    CHECK(gap(p, orbit->start, orbit->period) < 256 * epsilon<S>);
    CHECK(std::abs(orbit->period - truth->period) <= orbit->error.period * orbit->period);
    CHECK(std::abs(orbit->trace_minus_4 - truth->trace_minus_4) <= orbit->error.trace);
  }
}

TEST_CASE("heavy periodic orbit: errors are honest", "[heavy]") {
  std::mt19937 random(6);
  for (int i = 0; i < 24; ++i) {
    const Draw d = draw(random);
    const double spin = i % 4 == 3 ? 2.5 : i % 4 == 2 ? 4 : 30;
    const auto orbit = periodic_orbit(d.body(), spin, d.G0);
    if (!orbit) {
      CHECK(i % 4 >= 2);
      continue;
    }
    const auto exact = cast<long double>(d.body());
    const auto rate = static_cast<long double>(spin);
    const auto truth = close_orbit<long double>(exact, cast<long double>(orbit->start), orbit->period, rate,
                                                AtSpin<long double>{rate}, 1e-15L);
    REQUIRE(truth);
    CHECK(double(std::abs(truth->period - orbit->period)) <= orbit->error.period * orbit->period);
    CHECK(double(std::abs(truth->shot.derivative.trace() - 4 - orbit->trace_minus_4)) <= orbit->error.trace);
    const double moved =
        double((truth->start.angular_velocity - orbit->start.angular_velocity.cast<long double>()).norm()) /
        rate_size(d.body(), orbit->start);
    CHECK(moved <= orbit->error.start);
    CHECK(orbit->error.period < 1e-11);
  }
}

TEST_CASE("heavy periodic orbit: slow spins, along the family", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const std::size_t before = allocations();
  const auto orbit = periodic_orbit(p, 0.65, .1);
  CHECK(allocations() == before);
  REQUIRE(orbit);
  CHECK(orbit->method == OrbitMethod::continuation);
  CHECK(orbit->start.angular_velocity[2] == 0.65);
  CHECK(gap(p, orbit->start, orbit->period) < 1e-11);
  CHECK(orbit->stability == OrbitStability::unstable);
  CHECK(orbit->multipliers.first.re > 100);
  CHECK(periodic_orbit(p, 0.5, .1).error() == Errc::step_limit);
}

TEST_CASE("heavy periodic orbit: the flat pendulum", "[heavy]") {
  // T = 4 K(m)/r0, m = (2 c/r0)^2, for r0 > 2 c; none below
  const auto p = unit_body(.55, .8, {1, 0, 0}, 0.);
  for (const double spin : {10.0, 4.0, 2.1, 2.01}) {
    const auto orbit = periodic_orbit(p, spin, 0.);
    REQUIRE(orbit);
    CHECK(orbit->start.angular_velocity.head<2>().norm() < 1e-12);
    const double m = 4 / (spin * spin);
    const double period = 4 * math::complete(math::Modulus<double>{m, 1 - m}).K / spin;
    CHECK(std::abs(orbit->period / period - 1) < 1e-13 + orbit->error.period);
  }
  CHECK(periodic_orbit(p, 1.9, 0.).error() == Errc::no_convergence);
}

TEST_CASE("heavy periodic orbit: spin and vertical mirrored", "[heavy]") {
  // a half turn of the body about axis 1, and time reversed
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7), mirrored = unit_body(.55, .8, {.6, -.48, -.64}, .7);
  const auto a = periodic_orbit(p, 5., .1), b = periodic_orbit(mirrored, -5., -.1), c = periodic_orbit(p, -5., .1);
  REQUIRE(a);
  REQUIRE(b);
  REQUIRE(c);
  CHECK(std::abs(a->period / b->period - 1) < 1e-14);
  CHECK(std::abs(a->start.angular_velocity[0] - b->start.angular_velocity[0]) < 1e-13);
  CHECK(std::abs(a->start.angular_velocity[1] + b->start.angular_velocity[1]) < 1e-13);
  CHECK(std::abs(a->period / c->period - 1) < 1e-14);
  CHECK((a->start.angular_velocity + c->start.angular_velocity).norm() < 1e-13);
  CHECK(std::abs(a->trace_minus_4 - c->trace_minus_4) < 1e-12);
}

TEST_CASE("heavy periodic orbit: laminas, whose nutation keeps step with the spin", "[heavy]") {
  // p/c ~ eps^(1/3), far from the first order, which is of the order eps
  const auto p = unit_body(.65625, .34375, {.99, -.14, 0}, 0.);
  double before = 0;
  for (const double spin : {30., 240., 1920.}) {
    const auto orbit = periodic_orbit(p, spin, -.87);
    REQUIRE(orbit);
    CHECK(orbit->closure < 1e-13);
    CHECK(orbit->error.start < 1e-5);
    CHECK(gap(p, orbit->start, orbit->period) < 1e-13);
    const double amplitude = orbit->start.angular_velocity.head<2>().norm();
    CHECK(amplitude * std::cbrt(spin) == Approx(2.3).epsilon(.2));
    if (before > 0) CHECK(amplitude / before == Approx(.5).epsilon(.1));
    before = amplitude;
  }
}

TEST_CASE("heavy periodic orbit: a weakly held one errs within what it states", "[heavy][length]") {
  // a lamina whose axis 3 is nearly vertical: a closure of some roundings leaves the start open by a million of them
  const auto orbit = [](auto real, double inclination, double spin) {
    using S = decltype(real);
    const auto body = Problem<S>::make({1.75, 1.734375, 3.484375}, 0.234375, {0.2703125, -0.371875, 0}, 15.71875, 0);
    return periodic_orbit<S>(body.value(), spin, inclination);
  };
  std::vector given{std::pair{0.999, 20.}};
  if (at_length()) given.emplace_back(0.99993, 90.5);
  for (const auto& [inclination, spin] : given) {
    const auto made = orbit(0., inclination, spin);
    const auto truth = orbit(0.0L, inclination, spin);
    REQUIRE((made && truth));
    const auto off = (made->start.angular_velocity.cast<long double>() - truth->start.angular_velocity).norm() / spin;
    CHECK(off < made->error.start);
    CHECK(std::abs(made->period / truth->period - 1) < made->error.period);
  }
}

TEST_CASE("heavy periodic orbit: all but a sphere, of which the start is hardly known, and so the period", "[heavy]") {
  const auto p = Problem<double>::make({1.0000000036010073, 1.0000000043500314, 0.9999999985676594}, 7.6789884873588985,
                                       {0, -0.22504779756512763, -0.06662623567290918}, 9.80665, 0);
  REQUIRE(p);
  const auto orbit = periodic_orbit<double>(*p, 1664.4588838972422, 0);
  REQUIRE(orbit);
  CHECK(orbit->error.start > 1e-4);
  CHECK(4 * orbit->error.period >
        4.6e-7);  // what it errs, by Newton's method in 33 digits; the ladder states four times the estimate
}

TEST_CASE("heavy periodic orbit: limits and refusals", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  CHECK(periodic_orbit(p, 0., .1).error() == Errc::out_of_domain);
  CHECK(periodic_orbit(p, 5., 1.).error() == Errc::out_of_domain);
  CHECK(periodic_orbit(p, gyrostat::nan<double>, .1).error() == Errc::not_finite);
  CHECK(periodic_orbit(unit_body(1., .8, {.6, .48, .64}, .7), 5., .1).error() == Errc::not_applicable);
  // the intermediate axis: a hyperbolic motion
  const auto between = periodic_orbit(unit_body(.7, 1.3, {.6, .48, .64}, .7), 20., .1);
  REQUIRE(between);
  CHECK(between->stability == OrbitStability::unstable);
  CHECK(between->multipliers.first.re > 1);
  // without torque: turning about axis 3, and a free nutation beside it
  const auto free = periodic_orbit(unit_body(.55, .8, {0, 0, 0}, 0.), 3., .1);
  REQUIRE(free);
  CHECK(free->start.angular_velocity.head<2>().norm() < 1e-14);
  CHECK(free->period == Approx(2 * pi<double> / 3).epsilon(1e-14));
  CHECK(free->trace_minus_4 == Approx(2 * std::cos(2 * pi<double> * std::sqrt(.45 * .2 / .44))).epsilon(1e-12));
}
