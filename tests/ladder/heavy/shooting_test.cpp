// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/shooting.hpp"

#include "catch.hpp"

#include "allocations.hpp"
#include "gyrostat/ladder/heavy/orbit_walk.hpp"
#include "ladder/heavy/orbits.hpp"
#include "models/heavy/bodies.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

/// From p0 = q0 = 0 and a period of 2 pi/r0.
Result<Closed<double>> from_nothing(const Problem<double>& p, double spin) {
  State<double> start;
  start.angular_velocity = {0, 0, spin};
  start.down = {std::sqrt(0.99), 0, 0.1};
  return close_orbit(p, start, 2 * pi<double> / spin, spin, AtSpin<double>{spin});
}

}  // namespace

TEST_CASE("heavy shooting: the derivative is that of the end by the start", "[heavy]") {
  Tops random(41);
  for (int i = 0; i < 5; ++i) {
    const auto p = random.body();
    const auto s = random.start(2);
    const auto shot = shoot(p, s, 1.5);
    CHECK(shot.status == ode::Status::reached);
    const auto end = later(p, s, 1.5);
    CHECK((shot.end.angular_velocity - end.angular_velocity).norm() < 1e-14);
    CHECK((shot.end.down - end.down).norm() < 1e-14);
    for (int j = 0; j < 6; ++j) {
      State<double> near[2] = {s, s};
      constexpr double h = 1e-5;
      for (const int side : {0, 1})
        (j < 3 ? near[side].angular_velocity[j] : near[side].down[j - 3]) += side == 0 ? h : -h;
      const auto a = later(p, near[0], 1.5), b = later(p, near[1], 1.5);
      CHECK((shot.derivative.col(j).head<3>() - (a.angular_velocity - b.angular_velocity) / (2 * h)).norm() < 1e-8);
      CHECK((shot.derivative.col(j).tail<3>() - (a.down - b.down) / (2 * h)).norm() < 1e-8);
    }
  }
}

TEST_CASE("heavy shooting: closes from a coarse guess, in few shots and without heap", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  for (const double spin : {4.0, 8.0, 20.0}) {
    const std::size_t before = allocations();
    const auto closed = from_nothing(p, spin);
    CHECK(allocations() == before);
    REQUIRE(closed);
    CHECK(closed->closure < 4e-15);
    CHECK(closed->shots <= 7);
    CHECK(closed->start.angular_velocity[2] == spin);
    CHECK(gap(p, closed->start, closed->period) < 1e-14);
  }
}

TEST_CASE("heavy shooting: what does not close is refused", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  State<double> start;
  start.angular_velocity = {0, 0, 4};
  start.down = {std::sqrt(0.99), 0, 0.1};
  const AtSpin<double> space{4};
  CHECK(close_orbit(p, start, 1.5, 4.0, space, 1e-9, 1).error() == Errc::no_convergence);
  CHECK_FALSE(close_orbit(p, start, gyrostat::nan<double>, 4.0, space));
  CHECK_FALSE(close_orbit(p, start, -1.0, 4.0, space));
  start.angular_velocity[0] = gyrostat::nan<double>;
  CHECK_FALSE(close_orbit(p, start, 1.5, 4.0, space));
}

TEST_CASE("heavy shooting: errors are honest", "[heavy]") {
  const auto p = unit_body(.55, .8, {.6, .48, .64}, .7);
  const auto exact = cast<long double>(p);
  for (const double spin : {4.0, 8.0}) {
    const auto closed = from_nothing(p, spin);
    REQUIRE(closed);
    ode::Counts counts;
    const auto error = orbit_error(p, *closed, spin, AtSpin<double>{spin}, counts);
    CHECK(counts.steps > 0);
    const auto truth = close_orbit<long double>(exact, cast<long double>(closed->start), closed->period, spin,
                                                AtSpin<long double>{spin}, 1e-15L);
    REQUIRE(truth);
    const auto off = [](long double a, long double b) { return double(std::abs(a - b)); };
    CHECK(off(truth->period, closed->period) <= error.period * closed->period);
    CHECK(off(truth->shot.derivative.trace(), closed->shot.derivative.trace()) <= error.trace);
    CHECK(error.period < 1e-13);
    CHECK(error.trace < 1e-12);
  }
}
