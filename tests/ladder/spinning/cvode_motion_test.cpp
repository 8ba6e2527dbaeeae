// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/cvode_motion.hpp"

#include <utility>

#include "catch.hpp"

#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

namespace {

Scene scene_of(const Problem<double>& problem, const std::vector<double>& times) {
  Question question;
  question.times = times;
  question.tolerance = 1e-6;
  auto made = Scene::make(problem, question);
  REQUIRE(made);
  Scene scene = std::move(made).value();
  scene.full_equations = &full_by_cvode;
  return scene;
}

}  // namespace

TEST_CASE("CVODE finds the reference motions within what it states", "[spinning]") {
  for (const auto& c : reference_cases<double>()) {
    CAPTURE(c.name);
    const Track track = full_track(scene_of(c.problem, c.times), nullptr);
    REQUIRE(track.failure == Errc::ok);
    Comparison comparison(Row<double>{scales(c.problem, c.times.back())});
    for (std::size_t i = 0; i < c.times.size(); ++i) comparison.add(c.states[i], track.states[i]);
    const auto error = comparison.relative(comparison.difference());
    for (std::size_t i = 0; i < std::size(column_kinds); ++i) {
      CAPTURE(column_kinds[i].name);
      CHECK(error[i] <= track.error[i]);
    }
    CHECK(error.greatest() < 1e-7);
    CHECK(track.error.greatest() < 1e-6);
  }
}

TEST_CASE("CVODE at the start, at rest, and cancelled", "[spinning]") {
  Problem<double> p;
  CHECK(full_by_cvode(scene_of(p, {0}), nullptr).states.size() == 1);
  const Track rest = full_by_cvode(scene_of(p, {0, 10}), nullptr);
  CHECK(rest.failure == Errc::ok);
  CHECK(rest.error[column::angular_velocity] == 0);
  p.angular_velocity = {0, 0.1, 1};
  Monitor monitor;
  monitor.cancel = true;
  CHECK(full_by_cvode(scene_of(p, {0, 100}), &monitor).failure == Errc::cancelled);
}
