// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/track.hpp"

#include "../../models/rotor/bodies.hpp"
#include "asked.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

TEST_CASE("a rotor track becomes the columns of the contract", "[rotor]") {
  const auto body = reference_body(0.05, 30);
  Asked data;
  data.times = {0.5, 1};
  const auto scene = make_scene(body, data);
  REQUIRE(scene);
  Track track;
  const Vec3<double> Omega(0.1, -0.2, 0.3);
  State<double> state = body.state({0.5, 0.5, -0.5, 0.5}, Omega, 7);
  track.states = {state, state};
  track.states[1].rotor_angle = 7;
  track.error = {{1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}};
  track.counts.steps = 12;
  Answer answer;
  fill(answer, *scene, track);
  judge(answer, scene->question(), tables);
  const char* names[] = {"attitude", "angular_velocity", "angular_momentum", "rotor_rate", "rotor_angle", "lyapunov"};
  const int widths[] = {4, 3, 3, 1, 1, 1};
  REQUIRE(answer.columns.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(answer.columns[i].name() == names[i]);
    CHECK(answer.columns[i].kind->width == widths[i]);
    CHECK(answer.columns[i].values.size() == 2 * std::size_t(widths[i]));
  }
  CHECK(answer.find("attitude")->values[3] == 0.5);  // x, y, z, w
  CHECK(answer.find("attitude")->values[1] == -0.5);
  CHECK(answer.find("angular_velocity")->values[4] == Approx(-0.2));
  CHECK(answer.find("rotor_rate")->values[0] == Approx(7));
  CHECK(answer.find("rotor_angle")->values[1] == 7);
  CHECK(answer.find("lyapunov")->values[0] == Approx(body.lyapunov(state.momentum, state.axial_momentum)));
  CHECK(answer.error == 1e-3);
  CHECK(answer.counts.steps == 12);
}
