// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/full_rung.hpp"

#include <string_view>

#include "../../models/general/scenes.hpp"
#include "answered.hpp"

TEST_CASE("the full general equations through the ladder are honest in every column", "[general]") {
  using namespace general_scenes;
  Scenes scenes(23);
  int answered = 0;
  for (int i = 0; i < 30; ++i) {
    const auto made = scenes.next(2);
    for (const double tolerance : {1e-3, 1e-9}) {
      Question question = question_at({0.4 * made.span, made.span}, tolerance, rung::full);
      question.asked = all_columns();
      const auto scene = Scene::make(made.problem, question);
      REQUIRE(scene);
      gyrostat::Refusal refusal;
      const Answer answer = general::solve(*scene, refusal);
      if (refusal.code != Errc::ok) continue;
      CAPTURE(i, made.kind, tolerance);
      check_honest(*scene, answer);
      ++answered;
    }
  }
  CHECK(answered > 50);
}

TEST_CASE("energy and momentum balance with work and impulse", "[general]") {
  using namespace general_scenes;
  Problem<double> p = brick();
  p.wheels = {wheel(WheelType::torque, {1, 0, 0}), wheel(WheelType::motor, {0, 1, 1})};
  p.wheels[0].torque = 0.02, p.wheels[1].slope = 1e-3, p.wheels[1].no_load_rate = 50;
  p.torques = {torque(TorqueType::constant, {0.1, -0.1, 0.2}),
               damping(0.05 * Mat3<double>::Identity(), Opposed::angular_velocity)};
  p.torques[0].axes = Axes::inertial;
  p.torques[0].factor.on = {{1, 3}};
  Question question = question_at({2, 7}, 1e-10, rung::full);
  question.asked = {{scalar::energy_balance, true}, {scalar::momentum_balance, true}, {scalar::recognised, true}};
  const Answer answer = solved(posed(p, question));
  CHECK(answer.quantity("energy_balance")->values[0] < 1e-12);
  CHECK(answer.quantity("momentum_balance")->values[0] < 1e-12);
  CHECK(answer.quantity("recognised")->values[0] == 0);
}

TEST_CASE(
    "the full general equations refuse a stop, wheels that settle too fast beside one, and what grows without end",
    "[general]") {
  using namespace general_scenes;
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::brake, {1, 1, 2}), torque(TorqueType::constant, {1e-3, 0, 0})};
  p.torques[0].opposed = Opposed::momentum;
  gyrostat::Refusal refusal;
  general::solve(posed(p, question_at({100})), refusal);
  CHECK(std::string_view(refusal.why) == why_stopped_by_brake);
  Problem<double> stiff = brick();
  stiff.wheels = {wheel(WheelType::motor, {1, 0, 0}), wheel(WheelType::motor, {0, 1, 0})};
  for (auto& each : stiff.wheels) each.slope = 1e6, each.no_load_rate = 10;
  const Answer answered = solved(posed(stiff, question_at({1000})));
  CHECK(answered.columns[0].error < 1e-6);
  // damping as fast as the wheels is stiff in another way
  stiff.torques = {damping(1e6 * Mat3<double>::Identity(), Opposed::angular_velocity)};
  general::solve(posed(stiff, question_at({1000})), refusal);
  CHECK(std::string_view(refusal.why) == too_stiff);
  // a motion that grows without end
  Problem<double> driven = brick();
  driven.torques = {damping(-0.1 * Mat3<double>::Identity(), Opposed::angular_velocity)};
  general::solve(posed(driven, question_at({1e5})), refusal);
  CHECK(std::string_view(refusal.why) == why_outgrown);
  Problem<double> humming = brick();
  humming.torques = {torque(TorqueType::constant, {0.1, 0, 0})};
  humming.torques[0].factor.amplitude = 1, humming.torques[0].factor.rate = 1e10;
  general::solve(posed(humming, question_at({1})), refusal);
  CHECK(std::string_view(refusal.why) == forcing_lost);
}
