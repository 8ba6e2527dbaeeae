// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/forced_track.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include "catch.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "honest.hpp"
#include "models/heavy/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

const Problem<double> heavy_stone =
    *Problem<double>::make({0.0011, 0.0014, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 0);

}  // namespace

TEST_CASE("a start is near the forced motion where rates and phase are", "[heavy]") {
  const double spin = 150;
  State<double> start = Series2<double>::make(heavy_stone, spin, 0.1)->at(0);
  CHECK(heavy::detail::near_forced(posed(heavy_stone, start, 1)));
  State<double> turned = start;
  turned.down = {-start.down[0], 0, start.down[2]};
  CHECK_FALSE(heavy::detail::near_forced(posed(heavy_stone, turned, 1)));
  start.angular_velocity[0] += 0.05 * spin;
  CHECK_FALSE(heavy::detail::near_forced(posed(heavy_stone, start, 1)));
  start.angular_velocity[2] = 0;
  CHECK_FALSE(heavy::detail::near_forced(posed(heavy_stone, start, 1)));
}

TEST_CASE("what a start departs by is in the error of a forced motion", "[heavy]") {
  const auto motion = *Series2<double>::make(heavy_stone, 150, 0.1);
  const auto asked = heavy::detail::forced_error(periodic(heavy_stone, 150, 0.1, 10), motion);
  State<double> start = motion.at(0);
  const auto given = heavy::detail::forced_error(posed(heavy_stone, start, 10 * motion.period()), motion);
  CHECK(given.down > asked.down);
  CHECK(given.down < 100 * asked.down);
  start.angular_velocity[1] += 0.1;
  CHECK(heavy::detail::forced_error(posed(heavy_stone, start, 10 * motion.period()), motion).down > 1e-3);
}

TEST_CASE("forced tracks give up early, unless asked for by name", "[heavy]") {
  const auto motion = *Series2<double>::make(heavy_stone, 50, 0.1);
  const Track early = heavy::detail::forced_track(periodic(heavy_stone, 50, 0.1, 10, 1e-9), motion, rung::series_2);
  CHECK(early.failure == Errc::not_applicable);
  CHECK(early.refusal == nullptr);
  CHECK(early.known_error > 1e-9);
  CHECK(early.states.empty());
  const Track named =
      heavy::detail::forced_track(periodic(heavy_stone, 50, 0.1, 10, 1e-9, rung::series_2), motion, rung::series_2);
  CHECK(named.failure == Errc::ok);
  CHECK(named.states.size() == 10);
  CHECK(named.periodicity.period == motion.period());
}

TEST_CASE("around half a nutation a turn the series decide on stability where they can, and as shooting does",
          "[heavy]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int stable = 0, unstable = 0, open = 0;
  for (int n = 0; n < 800; ++n) {
    const double spin = n % 4 == 0 ? 10 : n % 4 == 1 ? 20 : n % 4 == 2 ? 40 : 80;
    Draw d = draw(random);
    const double across = 6 * unit(random) - 3;  // off the middle of the tongue, in half widths
    double omega2 = 0.25;
    for (int i = 0; i < 20; ++i) {
      d.b = (1 - d.a) / (1 - d.a + omega2 * d.a);
      if (!(d.b > 0) || d.a + d.b < 1.02 || std::abs(d.a - d.b) > 0.98 || std::abs(1 - d.b) < 0.05) break;
      const Floquet<double> floquet(*Scaled<double>::make(d.body(), spin, d.G0));
      omega2 += std::pow(0.5 + across * floquet.tongue, 2) - floquet.squared;
    }
    if (!(d.b > 0) || d.a + d.b < 1.02 || std::abs(d.a - d.b) > 0.98 || std::abs(1 - d.b) < 0.05) continue;
    const auto motion = Series2<double>::make(d.body(), spin, d.G0);
    const auto orbit = periodic_orbit<double>(d.body(), spin, d.G0);
    REQUIRE(motion);
    if (!orbit || orbit->stability == OrbitStability::undecided) continue;
    const Track track =
        heavy::detail::forced_track(periodic(d.body(), spin, d.G0, 1, 1e-3, rung::series_2), *motion, rung::series_2);
    const double told = track.periodicity.stable;
    CAPTURE(d.a, d.b, spin, across, orbit->trace_minus_4);
    if (std::isnan(told)) {
      ++open;
      continue;
    }
    CHECK((told == 1) == (orbit->stability == OrbitStability::stable));
    CHECK(std::abs(track.periodicity.trace - orbit->trace_minus_4) < track.periodicity.trace_error);
    ++(told == 1 ? stable : unstable);
  }
  CHECK(unstable > 25);
  CHECK(stable > 100);
  CHECK(open > 20);
}

TEST_CASE("the trace of the series has an error that covers growth they may have missed", "[heavy]") {
  const auto p = unit_body(1.156995, 1.8003033, {-0.62, -0.24, -0.75}, 69.9455);
  const double spin = 6.37005, cosine = -0.237773;
  const auto motion = Series2<double>::make(p, spin, cosine);
  const auto orbit = periodic_orbit<double>(p, spin, cosine);
  REQUIRE(motion);
  REQUIRE(orbit);
  const Track track =
      heavy::detail::forced_track(periodic(p, spin, cosine, 1, 1e-3, rung::series_2), *motion, rung::series_2);
  CHECK(orbit->trace_minus_4 > 1e4);
  CHECK(std::abs(track.periodicity.trace - orbit->trace_minus_4) < track.periodicity.trace_error);
  CHECK(std::isnan(track.periodicity.stable));
}

TEST_CASE("series that do not hold say so", "[heavy]") {
  const auto motion = *Series2<double>::make(heavy_stone, 15, 0.1);
  const Track track =
      heavy::detail::forced_track(periodic(heavy_stone, 15, 0.1, 10, 1e-3, rung::series_2), motion, rung::series_2);
  CHECK_FALSE(track.in_domain);
  REQUIRE(track.warnings.size() == 1);
  CHECK(track.warnings[0].code() == "beyond-validity");
  CHECK(track.periodicity.precession_error == infinity<double>);
  CHECK(track.periodicity.period_error == infinity<double>);
  for (const Errc why : {Errc::not_applicable, Errc::no_convergence, Errc::out_of_domain, Errc::not_finite})
    CHECK(std::strlen(heavy::detail::no_series(why)) > 10);
}
