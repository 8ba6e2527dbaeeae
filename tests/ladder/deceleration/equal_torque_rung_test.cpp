// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/equal_torque_rung.hpp"

#include "scenes.hpp"

using namespace scenes;

TEST_CASE("equal-torque rung: the cheapest answer, exact at any tolerance", "[deceleration]") {
  for (const double eps : {1e-4, 1e-2, 1.}) {
    Case c(eps, .8 / eps);
    c.data.control.setConstant(eps);
    const Answer truth = c.truth();
    c.data.tolerance = 1e-11;
    c.data.asked = all_but_attitude();
    const Answer answer = c.solve();
    CHECK(std::strcmp(answer.model, "equal-torque") == 0);
    CHECK(answer.tried.size() == 1);
    check_honest(answer, truth, 1e-10);
    CHECK(distance(answer, truth, "angular_momentum") < 1e-9);
    CHECK(distance(answer, truth, "energy") < 1e-10);
  }
}

TEST_CASE("equal-torque rung: says why it does not apply", "[deceleration]") {
  const auto why = [](const Case& c) {
    const Track track = equal_torque_track<math::Native>(c.scene());
    CHECK(track.failure == Errc::not_applicable);
    return std::string(track.refusal);
  };
  Case c(1e-3, 100);
  CHECK(why(c).find("not equal") != std::string::npos);
  c.data.control.setConstant(1e-3);
  CHECK(equal_torque_track<math::Native>(c.scene()).failure == Errc::ok);
  Case rotor = c, rest = c;
  rotor.data.rotor_momentum = V(0, 0, 1e-9);
  CHECK(why(rotor).find("rotor") != std::string::npos);
  rest.data.momentum.setZero();
  CHECK(why(rest).find("rest") != std::string::npos);
  Case separatrix = c;  // exactly: the differences of 1/J are 1/6 and 1/6
  separatrix.moments = V(3, 2, 1.5);
  separatrix.data.momentum = V(.5, .3, .5);
  CHECK(equal_torque_track<math::Native>(separatrix.scene()).failure == Errc::separatrix);
}

TEST_CASE("equal-torque rung: also under actuators off the principal axes", "[deceleration]") {
  Mat3<double> J;
  J << 1.4, .1, 0, .1, 1, .05, 0, .05, .8;
  Asked data = Case(1e-3, 300).data;
  data.control.setConstant(1e-3);
  Refusal refusal;
  const Answer answer = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  data.rung = rung::full;
  data.tolerance = 1e-11;
  const Answer truth = deceleration::solve<>(*make_scene(*Inertia<double>::from_tensor(J), data), refusal);
  CHECK(std::strcmp(answer.model, "equal-torque") == 0);
  check_honest(answer, truth);
}
