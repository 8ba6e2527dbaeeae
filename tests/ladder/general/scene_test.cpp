// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/scene.hpp"

#include "answered.hpp"

using namespace general_scenes;

TEST_CASE("a general scene has the columns that body, wheels and surroundings give a meaning", "[general]") {
  Problem<double> p = brick();
  const auto has = [&](std::size_t column) { return posed(p, question_at({1})).has_column(column); };
  CHECK_FALSE(has(column::rotor_rate));
  CHECK_FALSE(has(column::attitude_orbit));
  CHECK_FALSE(has(column::down));
  CHECK(has(column::velocity));
  p.wheels.push_back(wheel(WheelType::held, {0, 0, 1}));
  p.orbit.emplace();
  p.fixed = true;
  p.torques.push_back(torque(TorqueType::weight, {0, 0, 0}));
  CHECK(has(column::rotor_rate));
  CHECK(has(column::attitude_orbit));
  CHECK(has(column::down));
  CHECK_FALSE(has(column::velocity));
  Question asked = question_at({1});
  const Scene by_default = posed(p, asked);
  CHECK(by_default.gives(column::attitude));
  CHECK_FALSE(by_default.gives(column::energy));
  asked.asked = {{column::energy}};
  CHECK(by_default.asked(asked).gives(column::energy));
  CHECK_FALSE(by_default.asked(asked).gives(column::attitude));
}

TEST_CASE("the scales of a general scene are those of its start", "[general]") {
  Problem<double> p = brick();
  const double w = p.angular_velocity.norm();
  CHECK(posed(p, question_at({1})).scales()[column::angular_velocity] == Approx(w));
  p.angular_velocity.setZero();
  p.wheels.push_back(wheel(WheelType::held, {0, 0, 1}, 100));
  const auto scale = posed(p, question_at({1})).scales();
  CHECK(scale[column::angular_velocity] == Approx(1e-3 * 5 / 5));
  CHECK(scale[column::rotor_rate] == Approx(0.1));
  CHECK(scale[column::angular_momentum] == Approx(5e-3));
  p.torques = {torque(TorqueType::constant, {0, 3, 4})};
  CHECK(posed(p, question_at({1})).scales()[column::torque] == Approx(5e-3));
  // torques that begin later, and cancel, have a size too
  p.torques.assign(2, {});
  p.torques[0].vector = {3, 0, 4}, p.torques[1].vector = {-3, 0, -4};
  for (auto& torque : p.torques) torque.factor.on = {{.2, .4}};
  CHECK(posed(p, question_at({1})).scales()[column::torque] == Approx(10e-3));
}

TEST_CASE("a general scene refuses what is not physical", "[general]") {
  Problem<double> p = brick();
  const auto error = [&](const Question& question = question_at({1})) { return Scene::make(p, question).error(); };
  CHECK(error(question_at({1, 0.5})) == Errc::not_increasing);
  CHECK(error(question_at({1}, 2)) == Errc::out_of_domain);
  p.wheels = {wheel(WheelType::free, {0, 0, 1})};
  p.wheels[0].axial_inertia = 6;
  CHECK(error() == Errc::not_positive);
  p = brick();
  p.torques = {torque(TorqueType::weight, {0, 0, 0})};
  CHECK(error() == Errc::not_applicable);  // of a free body
}
