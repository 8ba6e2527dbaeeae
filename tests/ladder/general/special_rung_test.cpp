// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/special_rung.hpp"

#include <string_view>

#include "answered.hpp"
#include "special_scenes.hpp"

using namespace general_scenes;

TEST_CASE("rungs of the families answer their instances honestly, and say what they lack", "[general]") {
  SpecialScenes scenes(17);
  int by_family[specials] = {};
  for (int i = 0; i < 80; ++i) {
    const auto family = Special(i % int(specials));
    const auto made = scenes.of(family, 3);
    for (const double tolerance : {1e-3, 1e-8}) {
      Question question = question_at({0.3 * made.span, made.span}, tolerance);
      if (i % 2 == 0) question.asked = all_columns();
      const Scene scene = posed(made.problem, question);
      const Answer answer = solved(scene);
      CAPTURE(i, special_words[std::size_t(family)], tolerance);
      check_honest(scene, answer);
      by_family[int(family)] += std::string_view(answer.model).starts_with(special_words[std::size_t(family)]);
    }
  }
  for (const int answered : by_family) CHECK(answered > 10);
}

TEST_CASE("a rung of a family that the scene is no instance of says why", "[general]") {
  const int exact = place_of(tables.rungs, "heavy:exact");
  const Scene scene = posed(brick(), question_at({1}, 1e-6, exact));
  gyrostat::Refusal refusal;
  general::solve(scene, refusal);
  CHECK(refusal.code == Errc::not_applicable);
  CHECK(std::string_view(refusal.why) == "no weight, gradient or dipole in a field that stands still");
}

TEST_CASE("where the map is the identity the answer of the family is the answer, to the bit", "[general]") {
  const Problem<double> p = brick();
  const std::vector<double> times{0, 1, 40};
  const Answer answer = solved(posed(p, question_at(times, 1e-9, place_of(tables.rungs, "free:closed-form"))));
  free::Assembly<double> assembly;
  assembly.body.inertia = p.inertia, assembly.body.angular_velocity = p.angular_velocity;
  assembly.body.attitude = p.attitude;
  // what the general scene asks of it: states alone, which may be had side by side
  Question question = question_at(times, 1e-9, free::rung::closed_form);
  question.asked = {{free::column::attitude}, {free::column::angular_velocity}, {free::column::angular_momentum}};
  gyrostat::Refusal refusal;
  const Answer own = free::solve(*free::Scene::make(assembly, question), refusal);
  for (const char* name : {"attitude", "angular_velocity", "angular_momentum"})
    CHECK(answer.find(name)->values == own.find(name)->values);
}

TEST_CASE("a symmetric gyrostat is a top that spins faster", "[general]") {
  Problem<double> p = brick();
  p.inertia = Vec3<double>(2, 2, 1.5).asDiagonal();
  p.fixed = true;
  p.mass = 2, p.centre_of_mass = {0, 0, 0.2}, p.field.gravity = 9.8;
  p.field.down = Vec3<double>(0.6, 0, 0.8);
  p.torques = {torque(TorqueType::weight, {0, 0, 0})};
  for (const auto type : {WheelType::held, WheelType::free}) {
    p.wheels = {wheel(type, {0, 0, -1}, 200)};
    Question question = question_at({0, 0.5, 3}, 1e-9);
    question.asked = all_columns();
    if (type == WheelType::free)
      std::erase_if(question.asked, [](const auto& each) { return each.place == column::rotor_angle; });
    const Scene scene = posed(p, question);
    const Answer answer = solved(scene);
    CHECK(std::string_view(answer.model) == "heavy:exact");
    check_honest(scene, answer);
  }
}

TEST_CASE("the path of a body that forces move is known to the family that has them alone", "[general]") {
  Problem<double> p = brick();
  p.velocity = {1, 2, 3};
  p.field.gravity = 9.8;
  Question question = question_at({2}, 1e-9);
  question.asked = {{column::velocity}, {column::position}, {column::attitude}};
  const Answer falls = solved(posed(p, question));
  CHECK(std::string_view(falls.model).starts_with("free"));
  CHECK(falls.find("position")->values[2] == Approx(6 - 2 * 9.8));
  p.torques = {torque(TorqueType::thrust, {5, 0, 0})};
  p.torques[0].point = {1, 0, 0};  // through the mass centre
  const Scene pushed = posed(p, question);
  check_honest(pushed, solved(pushed));
}

TEST_CASE("a rung that is looked at on the way up refuses what it cannot meet at once", "[general]") {
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::constant, {0.3, 0, 0})};
  const Answer answer = solved(posed(p, question_at({50}, 1e-10)));
  CHECK(std::string_view(answer.model) == "spinning:full");
  for (const Attempt& attempt : answer.tried)
    if (attempt.model == std::string_view("spinning:second-order") && attempt.why != costs_more)
      CHECK(!(attempt.error < 1e-10));
}
