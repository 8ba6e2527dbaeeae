// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/picard_rung.hpp"

#include <cstring>

#include "catch.hpp"
#include "honest.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("rung picard by name sweeps until it meets the tolerance", "[spinning]") {
  Spinners random(17);
  std::uint64_t few = 0, many = 0;
  int met = 0;
  for (int i = 0; i < 8; ++i) {
    CAPTURE(i);
    const auto p = random.spinner(0.01);
    if (p.nutation_squared() < 0) continue;
    for (const double tolerance : {1e-2, 1e-9}) {
      const auto scene = posed(p, 20 / std::abs(p.spin()), tolerance, rung::picard);
      const Track track = picard_track(scene, nullptr);
      REQUIRE(track.failure == Errc::ok);
      met += track.error.greatest() <= tolerance;
      check_honest(scene, track);
      (tolerance > 1e-3 ? few : many) += track.counts.rhs;
    }
  }
  CHECK(met > 8);
  CHECK(few > 0);
  CHECK(many > few);
}

TEST_CASE("rung picard leaves the ladder to the full equations", "[spinning]") {
  const auto p = Spinners(17).spinner(0.01);
  const Track track = picard_track(posed(p, 1), nullptr);
  CHECK(track.failure == Errc::not_applicable);
  CHECK(track.refusal != nullptr);
}

TEST_CASE("rung picard refuses what it cannot answer", "[spinning]") {
  auto p = Spinners(17).spinner(1);
  const double turn = 6.3 / std::abs(p.spin());
  const auto why = [&](double span) {
    const Track track = picard_track(posed(p, span, 1e-6, rung::picard), nullptr);
    CHECK(track.refusal != nullptr);
    return track.failure;
  };
  CHECK(why(200 * turn) == Errc::no_convergence);
  CHECK(why(1e7 * turn) == Errc::step_limit);
  Monitor monitor;
  monitor.cancel = true;
  CHECK(picard_track(posed(p, turn, 1e-6, rung::picard), &monitor).failure == Errc::cancelled);
  p.torque[2] = 0.1;
  CHECK(why(turn) == Errc::not_applicable);
}
