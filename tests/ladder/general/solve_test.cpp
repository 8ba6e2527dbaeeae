// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/solve.hpp"

#include <string_view>

#include "answered.hpp"

using namespace general_scenes;

TEST_CASE("the ladder of a general scene asks the families first, and says what was found", "[general]") {
  Question question = question_at({0, 100, 4000}, 1e-9);
  question.asked = {{column::attitude}, {scalar::recognised, true}};
  const Answer free = solved(posed(brick(), question));
  CHECK(std::string_view(free.model) == "free:closed-form");
  CHECK(free.met);
  CHECK(free.quantity("recognised")->values[0] == 1);
  auto p = brick();
  p.wheels = {wheel(WheelType::torque, {0, 0, 1})};
  p.wheels[0].torque = 1e-3;
  question.times = {0, 10};
  const Answer full = solved(posed(p, question));
  CHECK(std::string_view(full.model) == "full");
  CHECK(full.quantity("recognised")->values[0] == 0);
  REQUIRE(full.tried.size() == 1);  // families that it is none of are not worth a line
}

TEST_CASE("by default attitude, rates and wheels are asked for", "[general]") {
  auto p = brick();
  p.wheels = {wheel(WheelType::held, {0, 0, 1})};
  const Answer answer = solved(posed(p, question_at({1})));
  REQUIRE(answer.columns.size() == 4);
  for (const char* name : {"attitude", "angular_velocity", "rotor_rate", "rotor_angle"}) CHECK(answer.find(name));
}

TEST_CASE("what a family does not know is given by the full equations", "[general]") {
  auto p = brick();
  p.wheels = {wheel(WheelType::free, {0, 0, 1})};
  p.torques = {damping(0.01 * Mat3<double>::Identity(), Opposed::momentum)};
  const Answer angles = solved(posed(p, question_at({5})));  // of a wheel that turns freely under drag
  CHECK(std::string_view(angles.model) == "full");
  CHECK(angles.met);
  Question question = question_at({5});
  question.asked = {{column::attitude}, {column::rotor_rate}};
  CHECK(std::string_view(solved(posed(p, question)).model).starts_with("deceleration"));
}

TEST_CASE("warnings of a general scene", "[general]") {
  auto p = brick();
  p.inertia = Vec3<double>(3, 4, 6.9).asDiagonal();
  p.wheels = {wheel(WheelType::motor, {1, 0, 0}, 100)};
  p.wheels[0].axial_inertia = 0.5, p.wheels[0].slope = 1e-3, p.wheels[0].no_load_rate = 50;
  p.torques = {damping(-1e-3 * Mat3<double>::Identity(), Opposed::angular_velocity)};
  const Answer answer = solved(posed(p, question_at({1})));
  for (const char* code : {"not-realisable", "driven-damping", "wheel-beyond-no-load"}) CHECK(answer.warns(code));
}

TEST_CASE("a body at rest that nothing moves stays, one that a torque moves turns", "[general]") {
  auto p = brick();
  p.angular_velocity.setZero();
  const Answer rest = solved(posed(p, question_at({0, 10})));
  CHECK(rest.met);
  for (const double w : rest.find("angular_velocity")->values) CHECK(w == 0);
  p.torques = {torque(TorqueType::constant, {0.1, 0, 0})};
  p.torques[0].axes = Axes::inertial;
  const Scene turned = posed(p, question_at({10}, 1e-9));
  check_honest(turned, solved(turned));
}
