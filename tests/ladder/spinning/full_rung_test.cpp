// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/full_rung.hpp"

#include "catch.hpp"

#include <string_view>

#include "honest.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

Scene scene(const Problem<double>& problem, std::vector<double> times, double tolerance = 1e-8) {
  Question question;
  question.times = std::move(times);
  question.tolerance = tolerance;
  const auto made = Scene::make(problem, question);
  REQUIRE(made);
  return *made;
}

Track stand_in(const Scene&, Monitor*) {
  Track track;
  track.refusal = "stand-in";
  return track;
}

}  // namespace

TEST_CASE("rung full of the reference cases", "[spinning]") {
  for (const auto& c : reference_cases<double>()) {
    CAPTURE(c.name);
    Monitor monitor;
    const Track track = full_track(scene(c.problem, c.times), &monitor);
    REQUIRE(track.failure == Errc::ok);
    CHECK(monitor.fraction == 1);
    CHECK(track.error.greatest() <= 1e-8);
    CHECK(track.counts.steps > 0);
    Comparison comparison(Row<double>{scales(c.problem, c.times.back())});
    for (std::size_t i = 0; i < c.times.size(); ++i) comparison.add(c.states[i], track.states[i]);
    CHECK(comparison.relative(comparison.difference()).greatest() < track.error.greatest());
  }
}

TEST_CASE("rung full says why it stops", "[spinning]") {
  const auto cases = reference_cases<double>();
  Monitor monitor;
  monitor.cancel = true;
  const auto& longest = cases[4];  // above 256 steps
  CHECK(full_track(scene(longest.problem, longest.times, 1e-12), &monitor).failure == Errc::cancelled);
}

TEST_CASE("rung full hands over to the integrator that the scene brings", "[spinning]") {
  Question question;
  question.times = {0, 1};
  const auto made = Scene::make({}, question);
  REQUIRE(made);
  Scene scene = *made;
  scene.full_equations = &stand_in;
  CHECK(std::string_view(full_track(scene, nullptr).refusal) == "stand-in");
}

TEST_CASE("rung full refuses at once what no double can hold", "[spinning]") {
  Problem<double> p;
  p.inertia = {8, 9, 12};
  p.angular_velocity = {0, 0.1, 1};
  const Track lost = full_track(scene(p, {1e9}), nullptr);
  CHECK(lost.failure == Errc::step_limit);
  REQUIRE(lost.refusal != nullptr);
  CHECK(std::string_view(lost.refusal) == phase_lost);
  // nutation turns the phase, too
  p.rotor_momentum = 8e6;
  CHECK(full_track(scene(p, {1e3}), nullptr).failure == Errc::step_limit);
}

TEST_CASE("rung full warns where theta loses a turn", "[spinning]") {
  Problem<double> p;
  p.angular_velocity = {1, 0, 0};
  const Track lost = full_track(scene(p, {0, 3}), nullptr);
  REQUIRE(lost.warnings.size() == 1);
  CHECK(lost.warnings[0].code() == "gimbal-lock");
  CHECK(lost.error.greatest() <= 1e-8);  // the attitude is as good as elsewhere
  p.angles.phi = 0.1;
  CHECK(full_track(scene(p, {0, 3}), nullptr).warnings.empty());
}

TEST_CASE("steps so loose that all runs would err alike are not taken", "[spinning]") {
  Problem<double> p;
  p.inertia = {0.12714649364685768, 0.43650254328055438, 0.46604156340318081};
  p.mass = 885.35518260560491;
  p.rotor_momentum = 0.98529570580438508;
  p.torque = {-0.0065033728313297215, 0.0025148234811936936, 0};
  p.force = {0, 0, -4.5507025692727403};
  p.angular_velocity = {0, 0, 1.4929888352999099};
  p.angles.theta = -2.7204082884987359;
  Question question;
  question.times = {27.430185024224794, 33.620101041737861, 121.12097945300282};
  question.tolerance = 1e-2;
  const auto scene = Scene::make(p, question);
  REQUIRE(scene);
  check_honest(*scene, full_track(*scene, nullptr));
}
