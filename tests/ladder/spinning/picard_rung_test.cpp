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

TEST_CASE("rung picard states what rounding of a large spin angle costs, and a last sweep that moves little by chance",
          "[spinning]") {
  Problem<double> p;
  p.inertia = {1132.0630297921973, 1132.0917629432736, 543.5339377670994};
  p.mass = 94.68392106416042;
  p.torque = {0.4807311981368295, 0.4807311981368295, 0};
  p.force = {0, 0, 397.6126199850623};
  p.angular_velocity = {0.01024258402711947, 0, 1.0365541441833768};
  p.angles.theta = -91.35443954181082;
  const auto turned = posed(p, 7.160638066378442, 1e-9, rung::picard, 956);
  check_honest(turned, picard_track(turned, nullptr));
  p.inertia = {78.36256809459421, 78.36092548596476, 103.91722604200412};
  p.mass = 1072.148970709003;
  p.rotor_momentum = -8.171551047717324;
  p.torque = {0.0058584603884326535, 0.0058584603884326535, 0};
  p.force = {0, 0, 254.0840826307396};
  p.angular_velocity = {-0.00016630366262456085, 0, -0.53538474211284};
  p.angles = {0.06294914698270158, -1.7370628208768457e-05, 0.41120701838003093};
  const auto little = posed(p, 43.25961068447089, 1e-9, rung::picard, 1);
  check_honest(little, picard_track(little, nullptr));
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
