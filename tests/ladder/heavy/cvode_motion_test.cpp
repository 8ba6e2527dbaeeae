// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/heavy/cvode_motion.hpp"

#include "catch.hpp"
#include "gyrostat/ladder/heavy/full_rung.hpp"
#include "models/heavy/tops.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

Scene scene(const Problem<double>& p, const State<double>& start, std::vector<double> times, bool attitude) {
  Question question;
  question.times = std::move(times);
  question.wants_attitude = attitude;
  const auto made = Scene::make(Body{p}, {start}, question);
  REQUIRE(made);
  Scene scene = *made;
  scene.full_equations = &full_by_cvode;
  return scene;
}

}  // namespace

TEST_CASE("CVODE finds the motions of heavy bodies within what it states", "[heavy]") {
  Tops random(3);
  for (int i = 0; i < 8; ++i) {
    const auto p = random.body(i % 3 == 0 ? 0 : 1, i % 2 == 0 ? 0 : 0.5);
    const bool attitude = i % 2 == 0;
    const Scene s = scene(p, random.start(3), {0, 1, 10, 30}, attitude);
    const Track track = full_track(s, nullptr);
    REQUIRE(track.failure == Errc::ok);
    std::vector<State<double>> truth(4);
    FullMotionOptions<double> options;
    options.tolerance = 1e-12;
    options.attitude = attitude;
    REQUIRE(full_motion<double>(s.problem(), s.start(), s.question().times, truth, options));
    Comparison both(Row<double>{});
    for (std::size_t k = 0; k < 4; ++k) both.add(truth[k], track.states[k]);
    const auto error = both.relative(both.difference());
    CAPTURE(i);
    CHECK(error[column::angular_velocity] <= track.error[column::angular_velocity]);
    CHECK(error[column::down] <= track.error[column::down]);
    CHECK(error[column::attitude] <= track.error[column::attitude]);
    CHECK(track.error.greatest() < 1e-6);
    CHECK((track.error[column::attitude] > 0) == attitude);
  }
}

TEST_CASE("CVODE with a heavy body at the start, at rest, and cancelled", "[heavy]") {
  Tops random(4);
  const auto p = Problem<double>::make({1, 1.2, 1.5}, 1, {0, 0, 0.01}, 100, 0).value();
  State<double> hanging;
  hanging.down = {0, 0, 1};
  CHECK(full_by_cvode(scene(p, hanging, {0}, false), nullptr).states.size() == 1);
  const Track rest = full_by_cvode(scene(p, hanging, {0, 10}, false), nullptr);
  CHECK(rest.failure == Errc::ok);
  // what CVODE makes of rounding is in the error, though both runs stay at rest
  CHECK(rest.error[column::angular_velocity] > 0);
  CHECK(rest.error[column::angular_velocity] < 1e-10);
  Monitor monitor;
  monitor.cancel = true;
  CHECK(full_by_cvode(scene(p, random.start(), {0, 100}, true), &monitor).failure == Errc::cancelled);
}
