// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/cvode_motion.hpp"

#include "catch.hpp"

#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

Scene scene(const Problem<double>& problem, const std::vector<double>& times) {
  Question question;
  question.times = times;
  question.tolerance = 1e-6;
  question.full_equations = &full_by_cvode;
  const auto made = Scene::make(problem, question);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("CVODE finds the reference motions within what it states", "[spinning]") {
  for (const auto& c : reference_cases<double>()) {
    CAPTURE(c.name);
    const Track track = full_track(scene(c.problem, c.times), nullptr);
    REQUIRE(track.failure == Errc::ok);
    Comparison<double> comparison;
    for (std::size_t i = 0; i < c.times.size(); ++i) comparison.add(c.states[i], track.states[i]);
    const auto error = comparison.relative(comparison.difference());
    CHECK(error.angular_velocity <= track.error.angular_velocity);
    CHECK(error.angles <= track.error.angles);
    CHECK(error.attitude <= track.error.attitude);
    CHECK(error.momentum <= track.error.momentum);
    CHECK(error.velocity <= track.error.velocity);
    CHECK(error.position <= track.error.position);
    CHECK(error.greatest() < 1e-7);
    CHECK(track.error.greatest() < 1e-6);
  }
}

TEST_CASE("CVODE at the start, at rest, and cancelled", "[spinning]") {
  Problem<double> p;
  CHECK(full_by_cvode(scene(p, {0}), nullptr).states.size() == 1);
  const Track rest = full_by_cvode(scene(p, {0, 10}), nullptr);
  CHECK(rest.failure == Errc::ok);
  CHECK(rest.error.angular_velocity == 0);
  p.angular_velocity = {0, 0.1, 1};
  Monitor monitor;
  monitor.cancel = true;
  CHECK(full_by_cvode(scene(p, {0, 100}), &monitor).failure == Errc::cancelled);
}
