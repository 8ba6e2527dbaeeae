// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/spinning/track.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("a spinning track becomes the columns of the contract", "[spinning]") {
  Question question;
  question.times = {0, 1};
  const auto scene = Scene::make({}, question);
  REQUIRE(scene);
  State<double> state;
  state.angular_velocity = {1, 2, 3};
  state.angles = {4, 5, 6};
  state.attitude = {0.5, 0.5, -0.5, 0.5};
  state.momentum_I = {7, 8, 9};
  state.velocity = {10, 11, 12};
  state.position = {13, 14, 15};
  Track track;
  track.states = {state, state};
  track.error = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
  Answer answer;
  fill(answer, *scene, track);
  judge(answer, scene->question(), tables);
  const char* names[] = {"angular_velocity",          "euler_312", "attitude",
                         "angular_momentum_inertial", "velocity",  "position"};
  REQUIRE(answer.columns.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(answer.columns[i].name() == names[i]);
    CHECK(answer.columns[i].values.size() == 2 * std::size_t(answer.columns[i].kind->width));
    CHECK(answer.columns[i].error == Approx(std::pow(10, -1.0 - double(i))));
  }
  CHECK(answer.find("euler_312")->values[5] == 6);
  CHECK(answer.find("attitude")->values[3] == 0.5);
  CHECK(answer.find("attitude")->values[1] == -0.5);
  CHECK(answer.find("angular_momentum_inertial")->values[0] == 7);
  CHECK(answer.find("position")->values[4] == 14);
  CHECK(answer.error == 1e-1);
}
