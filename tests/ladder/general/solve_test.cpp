// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/solve.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "answered.hpp"
#include "special_scenes.hpp"

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

TEST_CASE("the full equations do not stand before those of a family that was found", "[general]") {
  SpecialScenes scenes(23);
  for (int i = 0; i < 300; ++i) {
    const auto family = Special(i % int(specials));
    const auto made = scenes.of(family, i % 4 == 0 ? 3 : 100);
    Question question = question_at({made.span}, i % 3 == 0 ? 1e-2 : i % 3 == 1 ? 1e-6 : 1e-9);
    question.asked = {{column::angular_velocity}};
    const Answer answer = solved(posed(made.problem, question));
    CAPTURE(i, special_words[std::size_t(family)], answer.model);
    if (std::string_view(answer.model) != "full") continue;
    // where the full equations of the family have been asked in vain
    CHECK(std::any_of(answer.tried.begin(), answer.tried.end(), [](const Attempt& each) {
      return std::string_view(each.model).ends_with(":full") && each.spent > 0;
    }));
  }
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

TEST_CASE("a gradient that is not that of the orbit, and an orbit inside its planet", "[general]") {
  auto p = brick();
  p.orbit.emplace();
  p.orbit->radius = 7e6, p.orbit->mu = 4e14;
  const double N = 3 * p.orbit->mu / std::pow(p.orbit->radius, 3);
  p.torques = {torque(TorqueType::gravity_gradient, {0, 0, 0})};
  const auto warns = [&](double gradient) {
    p.torques[0].gradient = gradient;
    return solved(posed(p, question_at({1}))).warns("orbit-mismatch");
  };
  CHECK(warns(1.0011 * N));
  CHECK(!warns(1.0009 * N));
  CHECK(!warns(0.9991 * N));
  CHECK(warns(0.9989 * N));
  // on an ellipse it is that of some place
  p.orbit->eccentricity = 0.1;
  CHECK(warns(1.0011 * N));
  CHECK(!warns(0.9 * N));
  CHECK(!warns(N / std::pow(1.1 / 0.9, 3) * 0.9991));
  CHECK(warns(N / std::pow(1.1 / 0.9, 3) * 0.9989));
  p.torques[0].gradient.reset();
  CHECK(!solved(posed(p, question_at({1}))).warns("orbit-mismatch"));

  p.orbit->true_anomaly = pi<double> / 2;     // the lowest point is at 1/1.1 of the distance here
  p.orbit->surface = (7e6 / 1.1 + 1) / 1.01;  // a hundredth of it is too low
  CHECK(solved(posed(p, question_at({1}))).warns("inside-planet"));
  p.orbit->surface -= 2;
  CHECK(!solved(posed(p, question_at({1}))).warns("inside-planet"));
}

TEST_CASE("a body that is not small against its orbit", "[general]") {
  auto p = brick();
  p.orbit.emplace();
  p.orbit->radius = 7e6, p.orbit->mu = 4e14;
  p.mass = 2;
  const auto warns = [&](double size) {
    p.inertia *= p.mass * size * size / p.inertia.maxCoeff();
    return solved(posed(p, question_at({1}))).warns("wide-in-orbit");
  };
  p.torques = {torque(TorqueType::gravity_gradient, {0, 0, 0})};
  CHECK(warns(7001));
  CHECK(!warns(6999));
  p.mass = 1, p.mass_given = false;
  CHECK(!warns(7001));
  p.mass = 2;
  p.torques = {torque(TorqueType::constant, {1, 0, 0})};
  CHECK(!warns(7001));
}

TEST_CASE("torques that come and go and leave the start a thousandth", "[general]") {
  auto p = brick();
  p.angular_velocity = {1e-3, 0, 0};
  p.torques = {torque(TorqueType::constant, {3, 0, 0})};
  const auto warns = [&](double last) { return solved(posed(p, question_at({last}))).warns("torque-outruns"); };
  CHECK(!warns(1.1));  // it always acts
  p.torques[0].factor.on = {{0, 10}};
  CHECK(!warns(0.998));
  CHECK(warns(1.0));
}

TEST_CASE("a held wheel that stands still where the table of its rate ends", "[general]") {
  auto p = brick();
  Wheel<double> wheel;
  wheel.axis = {0, 0, 1}, wheel.axial_inertia = 0.01, wheel.type = WheelType::held;
  wheel.table.times = {0, 2}, wheel.table.values = {0, 5};
  p.wheels = {wheel};
  const auto warns = [&](double last) { return solved(posed(p, question_at({last}))).warns("held-table-ends"); };
  CHECK(!warns(2));
  CHECK(warns(2.5));
  p.wheels[0].table.holds = true;
  CHECK(!warns(2.5));
  p.wheels[0].table = {{0, 1, 2}, {0, 5, 0}};
  CHECK(!warns(2.5));
}

TEST_CASE("a torque that opposes the whole momentum leaves the body turning against its wheels", "[general]") {
  auto p = brick();
  Torque<double> damping;
  damping.type = TorqueType::damping;
  damping.matrix = 0.01 * Mat3<double>::Identity();
  damping.opposed = Opposed::momentum;
  p.torques = {damping};
  const Question question = question_at({0, 10}, 1e-6);
  CHECK_FALSE(solved(posed(p, question)).warns("brakes-wheels"));
  p.wheels = {wheel(WheelType::held, {0, 0, 1})};
  p.wheels[0].rate = 50;
  const Answer answer = solved(posed(p, question));
  CHECK(answer.warns("brakes-wheels"));
  p.torques[0].opposed = Opposed::angular_velocity;
  CHECK_FALSE(solved(posed(p, question)).warns("brakes-wheels"));
}

TEST_CASE("motions that part are told as chaotic, those that drift are not", "[general]") {
  auto p = brick();
  p.inertia = Vec3<double>(0.6, 0.5, 0.3).asDiagonal();
  p.fixed = true, p.mass = 10, p.centre_of_mass = {0.1, 0.05, -0.2}, p.field.gravity = 9.8;
  p.attitude = normalised(Quat<double>{1, 2, 0.3, 0});
  p.angular_velocity = {2, 1, 3};
  p.torques = {torque(TorqueType::weight, {0, 0, 0})};
  const auto warns = [&](double last, int rung) {
    return solved(posed(p, question_at({last}, 1e-6, rung))).warns("chaotic");
  };
  CHECK(!warns(15, rung::full));
  CHECK(warns(25, rung::full));
  // a free body over many turns drifts
  p.fixed = false, p.torques.clear();
  CHECK(!warns(2e3, rung::full));
}

TEST_CASE("what is dropped to find a family is told from one rounding on", "[general]") {
  constexpr double eps = epsilon<double>;
  auto p = brick();
  p.torques = {torque(TorqueType::constant, {1, 0, 0}), torque(TorqueType::constant, {-1, 0, 0})};
  const auto answer = [&](double over) {
    p.torques[1].vector[0] = -(1 + over);
    return solved(posed(p, question_at({1})));
  };
  const Answer exact = answer(0), half = answer(eps), one = answer(3 * eps), none = answer(20 * eps);
  for (const Answer* each : {&exact, &half, &one}) CHECK(std::string_view(each->model).starts_with("free:"));
  CHECK(!exact.warns("recognised-with-rounding"));
  CHECK(!half.warns("recognised-with-rounding"));
  CHECK(one.warns("recognised-with-rounding"));
  CHECK(!none.warns("recognised-with-rounding"));
  // of two matrices that are nearly multiples
  p.torques = {damping(0.01 * p.inertia, Opposed::angular_velocity)};
  CHECK(!solved(posed(p, question_at({1}))).warns("recognised-with-rounding"));
  p.torques[0].matrix(0, 1) = 3 * eps * p.torques[0].matrix(2, 2);
  p.torques[0].matrix(1, 0) = p.torques[0].matrix(0, 1);
  CHECK(solved(posed(p, question_at({1}))).warns("recognised-with-rounding"));
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
