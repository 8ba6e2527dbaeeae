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

TEST_CASE("a torque that is asked for is judged by its own error", "[general]") {
  using namespace general_scenes;
  Scenes scenes(91);  // where what it is made of alone is looked at, two of these answers miss
  int answered = 0;
  for (int i = 0; i < 60; ++i) {
    const auto made = scenes.next(2);
    for (const double tolerance : {1e-6, 1e-9}) {
      Question question = question_at({0.4 * made.span, made.span}, tolerance, rung::full);
      question.asked = all_columns();
      for (auto& each : question.asked) each.needed = false;
      const auto scene = Scene::make(made.problem, question);
      REQUIRE(scene);
      gyrostat::Refusal refusal;
      const Answer answer = general::solve(*scene, refusal);
      if (refusal.code != Errc::ok) continue;
      CAPTURE(i, tolerance);
      CHECK(answer.find("torque")->error <= tolerance);
      ++answered;
    }
  }
  CHECK(answered > 100);
}

TEST_CASE("what is kept is known better than the phase", "[general]") {
  using namespace general_scenes;
  Problem<double> p = brick();
  p.wheels = {wheel(WheelType::free, {0, 0.6, 0.8})};
  for (const bool charged : {false, true}) {
    if (charged) p.torques = {torque(TorqueType::charge, {0.3, -0.2, 0.5})};
    Question question = question_at({50, 150}, 1e-4, rung::full);
    question.asked = all_columns();
    for (auto& each : question.asked) each.needed = false;
    const Scene scene = posed(p, question);
    const Answer answer = solved(scene);
    CAPTURE(charged);
    check_honest(scene, answer);
    CHECK(answer.find("energy")->error < 0.3 * answer.find("angular_velocity")->error);
    if (charged) continue;
    CHECK(answer.find("angular_momentum_norm")->error < 0.3 * answer.find("angular_momentum")->error);
    CHECK(answer.find("angular_momentum_inertial")->error < 0.3 * answer.find("attitude")->error);
  }
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

TEST_CASE("works of torques and motors about one axis are those of the closed form", "[general]") {
  using namespace general_scenes;
  const double J = 2, I = 0.1, T = 0.3, c = -0.4, rate = 5, w0 = 0.7, end = 3;
  Problem<double> p;
  p.inertia = Vec3<double>(1.5, 1.6, J).asDiagonal();
  p.angular_velocity = {0, 0, w0};
  p.wheels = {wheel(WheelType::torque, {0, 0, 1})};
  p.wheels[0].axial_inertia = I, p.wheels[0].rate = rate, p.wheels[0].torque = T;
  p.torques = {torque(TorqueType::constant, {0, 0, c})};
  const auto works = [&](double tolerance) {
    Question question = question_at({1, end}, tolerance);
    question.asked = {{scalar::work_torques, true}, {scalar::work_motors, true}};
    const Answer answer = solved(posed(p, question));
    CHECK(answer.met);
    return std::array{*answer.quantity("work_torques"), *answer.quantity("work_motors")};
  };
  const auto check = [&](const Quantity& work, double truth, double most) {
    CAPTURE(work.values[0], truth, work.error);
    const double size = balance<double>(p, end, 1e-13, false).size;
    CHECK(size >= std::abs(truth));
    CHECK(std::abs(work.values[0] - truth) <= work.error * size);
    CHECK(work.error < most);
  };
  const auto integral = [&](double first, double slope) { return first * end + slope * end * end / 2; };
  const double body = (c - T) / (J - I);  // its acceleration
  for (const double tolerance : {1e-6, 1e-12}) {
    const auto both = works(tolerance);
    check(both[0], c * integral(w0, body), tolerance);
    check(both[1], T * integral(rate, T / I - body), tolerance);
  }
  // what is held does no work, and what is not there
  p.wheels[0].type = WheelType::held, p.wheels[0].torque = 0;
  CHECK(works(1e-9)[1].values[0] == 0);
  CHECK(works(1e-9)[1].error == 0);
  // a rate that steps: the energy of body and locked wheel steps with it
  p.wheels[0].table.times = {0, 2, 2 * end}, p.wheels[0].table.values = {rate, -rate, -rate};
  p.wheels[0].table.between = Between::step;
  const double before = w0 + c / J * 2, after = before + 2 * rate * I / J;
  check(works(1e-9)[1], J / 2 * (after * after - before * before), 1e-12);
  p.torques.clear();
  CHECK(works(1e-9)[0].values[0] == 0);
}

TEST_CASE("the works of random scenes are what their energies change by", "[general]") {
  using namespace general_scenes;
  Scenes scenes(47);
  int answered = 0, sharp = 0;
  for (int i = 0; i < 30; ++i) {
    const auto made = scenes.next(2);
    for (const double tolerance : {1e-4, 1e-10}) {
      Question question = question_at({made.span}, tolerance, rung::full);
      question.asked = {{scalar::work_torques, true}, {scalar::work_motors, true}};
      const auto scene = Scene::make(made.problem, question);
      REQUIRE(scene);
      gyrostat::Refusal refusal;
      const Answer answer = general::solve(*scene, refusal);
      if (refusal.code != Errc::ok) continue;
      const auto true_states = general_truth::motion<long double>(
          general_truth::cast<long double>(made.problem), std::vector<long double>{0, made.span}, 1e-17L, 60'000);
      if (true_states.size() != 2) continue;
      const auto at = [&](std::size_t k) {
        return energy(scene->wheels(), general_truth::cast<double>(true_states[k]));
      };
      const double gain = at(1) - at(0), size = at(1) + at(0);
      const double all = balance<double>(made.problem, made.span, 1e-13, false).size;
      double sum = 0, off = 4 * epsilon<double> * size;
      for (const char* name : {"work_torques", "work_motors"}) {
        const auto* work = answer.quantity(name);
        REQUIRE(work);
        sum += work->values[0], off += work->error * all;
      }
      CAPTURE(i, made.kind, tolerance, sum, gain, size, off);
      CHECK(std::abs(sum - gain) <= off);
      ++answered, sharp += off < tolerance * size;
    }
  }
  CHECK(answered > 40);
  CHECK(sharp > answered * 3 / 4);
}

TEST_CASE("a brake that holds the body tells when it stopped, and that no torque is left", "[general]") {
  using namespace general_scenes;
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::brake, {1, 1, 2}), torque(TorqueType::constant, {1e-3, 0, 0})};
  p.torques[0].opposed = Opposed::momentum;
  Question question = question_at({1, 100});
  question.asked = {{column::attitude}, {column::angular_velocity}, {column::torque}, {scalar::stop_time, true}};
  const Answer answer = solved(posed(p, question));
  CHECK(answer.met);
  CHECK(answer.warns("rest"));
  const auto* stop = answer.quantity("stop_time");
  REQUIRE(stop);
  // between what the strongest and the weakest of the brakes would need
  const double M = (p.inertia * p.angular_velocity).norm();
  CHECK(stop->values[0] > M / 2 - 0.01);
  CHECK(stop->values[0] < M / 1 + 0.01);
  CHECK(stop->error < 1e-6);
  for (int i = 3; i < 6; ++i) {
    CHECK(answer.find("torque")->values[std::size_t(i)] == 0);
    CHECK(answer.find("angular_velocity")->values[std::size_t(i)] == 0);
  }
  CHECK(answer.find("torque")->error < 1e-3);
  // just before the stop nothing rests, and there is no time of a stop
  question.times = {1, stop->values[0] * (1 - 1e-6)};
  question.asked.pop_back();
  const Answer before = solved(posed(p, question));
  CHECK(!before.warns("rest"));
  CHECK(!before.quantity("stop_time"));
}

TEST_CASE(
    "the full general equations refuse a stop that they cannot tell, wheels that settle too fast beside damping, and "
    "what grows without end",
    "[general]") {
  using namespace general_scenes;
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::brake, {1, 1, 2}), torque(TorqueType::constant, {1e-3, 0, 0})};
  p.torques[0].opposed = Opposed::momentum;
  p.torques[1].factor.amplitude = 1, p.torques[1].factor.rate = 1;
  gyrostat::Refusal refusal;
  general::solve(posed(p, question_at({100})), refusal);
  CHECK(std::string_view(refusal.why) == why_not_through(AtStop::varying));
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
