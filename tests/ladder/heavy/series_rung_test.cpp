// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/series_rung.hpp"

#include <cstring>

#include "catch.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "honest.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("rung series answers to the tolerance with honest errors", "[heavy]") {
  Tops random(7);
  int met = 0;
  for (int i = 0; i < 24; ++i) {
    const double tolerance = i % 3 == 0 ? 1e-4 : i % 3 == 1 ? 1e-7 : 1e-10;
    CAPTURE(i, tolerance);
    const auto scene =
        periodic(random.body(), random.log_any(5, 100), random.any(-0.9, 0.9), 20, tolerance, rung::series);
    const Track track = series_track(scene, nullptr);
    if (track.failure != Errc::ok) continue;
    met += track.error.greatest() <= tolerance;
    check_honest(scene, track);
  }
  CHECK(met > 16);
}

TEST_CASE("rung series and full agree on period, stability and precession", "[heavy]") {
  const auto p = *Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 4.6e-6);
  const Track track = series_track(periodic(p, 150, 0.1, 5, 1e-10), nullptr);
  REQUIRE(track.failure == Errc::ok);
  const auto orbit = periodic_orbit<double>(p, 150, 0.1);
  REQUIRE(orbit);
  CHECK(track.periodicity.period == Approx(orbit->period).epsilon(1e-12));
  CHECK(std::abs(track.periodicity.trace - orbit->trace_minus_4) < track.periodicity.trace_error);
  CHECK(track.periodicity.trace_error < 0.1);
}

TEST_CASE("rung series takes a given start for the forced one only where it is", "[heavy]") {
  const auto p = *Problem<double>::make({0.0011, 0.0014, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 0);
  const auto orbit = periodic_orbit<double>(p, 150, 0.1);
  REQUIRE(orbit);
  Question question;
  question.wants_attitude = true;
  question.tolerance = 1e-8;
  const auto scene = posed(p, orbit->start, 0.5, question);
  const Track track = series_track(scene, nullptr);
  REQUIRE(track.failure == Errc::ok);
  CHECK(track.error.greatest() < 1e-8);
  check_honest(scene, track);

  auto off = orbit->start;
  off.angular_velocity[0] += 1e-6;
  CHECK(series_track(posed(p, off, 0.5, question), nullptr).failure == Errc::not_applicable);
  question.rung = rung::series;
  const auto by_name = posed(p, off, 0.5, question);
  const Track named = series_track(by_name, nullptr);
  REQUIRE(named.failure == Errc::ok);
  CHECK(named.error.greatest() > 1e-8);
  check_honest(by_name, named);
  off.angular_velocity[0] += 10;
  const Track other = series_track(posed(p, off, 0.5, question), nullptr);
  CHECK(other.failure == Errc::not_applicable);
  CHECK(std::strstr(other.refusal, "free nutation"));
}

TEST_CASE("rung series refuses a spin too slow for its terms to fall", "[heavy]") {
  const auto p = *Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 0);
  const Track slow = series_track(periodic(p, 4, 0.1, 1, 1e-3, rung::series), nullptr);
  CHECK(slow.failure == Errc::no_convergence);
  CHECK(std::strstr(slow.refusal, "do not fall"));
}
