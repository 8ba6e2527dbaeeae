// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/forced_track.hpp"

#include <cstring>

#include "catch.hpp"
#include "gyrostat/models/heavy/series_2.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

const Problem<double> stone = *Problem<double>::make({0.0011, 0.0014, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 0);

}  // namespace

TEST_CASE("a start is near the forced motion where rates and phase are", "[heavy]") {
  const double spin = 150;
  State<double> start = Series2<double>::make(stone, spin, 0.1)->at(0);
  CHECK(heavy::detail::near_forced(posed(stone, start, 1)));
  State<double> turned = start;
  turned.down = {-start.down[0], 0, start.down[2]};
  CHECK_FALSE(heavy::detail::near_forced(posed(stone, turned, 1)));
  start.angular_velocity[0] += 0.05 * spin;
  CHECK_FALSE(heavy::detail::near_forced(posed(stone, start, 1)));
  start.angular_velocity[2] = 0;
  CHECK_FALSE(heavy::detail::near_forced(posed(stone, start, 1)));
}

TEST_CASE("what a start departs by is in the error of a forced motion", "[heavy]") {
  const auto motion = *Series2<double>::make(stone, 150, 0.1);
  const auto asked = heavy::detail::forced_error(periodic(stone, 150, 0.1, 10), motion);
  State<double> start = motion.at(0);
  const auto given = heavy::detail::forced_error(posed(stone, start, 10 * motion.period()), motion);
  CHECK(given.down > asked.down);
  CHECK(given.down < 100 * asked.down);
  start.angular_velocity[1] += 0.1;
  CHECK(heavy::detail::forced_error(posed(stone, start, 10 * motion.period()), motion).down > 1e-3);
}

TEST_CASE("forced tracks give up early, unless asked for by name", "[heavy]") {
  const auto motion = *Series2<double>::make(stone, 50, 0.1);
  const Track early = heavy::detail::forced_track(periodic(stone, 50, 0.1, 10, 1e-9), motion, Model::series_2);
  CHECK(early.failure == Errc::not_applicable);
  CHECK(early.refusal == nullptr);
  CHECK(early.known_error > 1e-9);
  CHECK(early.states.empty());
  const Track named =
      heavy::detail::forced_track(periodic(stone, 50, 0.1, 10, 1e-9, Model::series_2), motion, Model::series_2);
  CHECK(named.failure == Errc::ok);
  CHECK(named.states.size() == 10);
  CHECK(named.periodicity.period == motion.period());
}

TEST_CASE("series that do not hold say so", "[heavy]") {
  const auto motion = *Series2<double>::make(stone, 15, 0.1);
  const Track track =
      heavy::detail::forced_track(periodic(stone, 15, 0.1, 10, 1e-3, Model::series_2), motion, Model::series_2);
  CHECK_FALSE(track.in_domain);
  REQUIRE(track.warnings.size() == 1);
  CHECK(std::strcmp(track.warnings[0].code, "beyond-validity") == 0);
  for (const Errc why : {Errc::not_applicable, Errc::no_convergence, Errc::out_of_domain, Errc::not_finite})
    CHECK(std::strlen(heavy::detail::no_series(why)) > 10);
}
