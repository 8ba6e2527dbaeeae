// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/segments_rung.hpp"

#include <cmath>
#include <vector>

#include "answered.hpp"

using namespace general_scenes;

namespace {

Torque<double> pulse(double from, double to, const Vec3<double>& by) {
  Torque<double> made = torque(TorqueType::constant, by);
  made.factor.on = {{from, to}};
  return made;
}

/// Coasts, is pushed, coasts.
Problem<double> pushed() {
  Problem<double> made = brick();
  made.torques = {pulse(300, 310, {0.05, -0.02, 0.03})};
  return made;
}

std::vector<double> every(double step, double last) {
  std::vector<double> made;
  for (double t = 0; t <= last; t += step) made.push_back(t);
  return made;
}

Answer by(int rung, const Problem<double>& problem, std::vector<double> times, double tolerance) {
  Question question = question_at(std::move(times), tolerance, rung);
  question.asked = all_columns();
  for (auto& each : question.asked) each.needed = false;
  return solved(posed(problem, question));
}

void check_within(const Answer& answer, const Answer& truth) {
  for (const Column& column : answer.columns) {
    if (column.error == infinity<double>) continue;
    const Column& its = *truth.find(column.name());
    CAPTURE(column.name(), column_error(column, its), column.error, its.error);
    CHECK(column_error(column, its) <= column.error + its.error);
  }
}

}  // namespace

TEST_CASE("a coast, a pulse and a coast are three segments, answered each by its family") {
  const auto problem = pushed();
  const auto times = every(25, 1000);
  const Answer answer = by(rung::segments, problem, times, 1e-6);
  const Answer full = by(rung::full, problem, times, 1e-12);
  CHECK(answer.met);
  check_within(answer, full);
  CHECK(answer.find("attitude")->error < 1e-7);
  CHECK(answer.find("energy") != nullptr);
}

TEST_CASE("the ladder takes segments where coasts are long, and the full equations where they are short") {
  const auto problem = pushed();
  Problem<double> far = problem;
  const Answer slow = solved(posed(far, question_at({0, 2e5}, 1e-6)));
  CHECK(std::string_view(slow.model) == "segments");
  CHECK(slow.met);
  Problem<double> near = brick();
  for (int i = 0; i < 20; ++i) near.torques.push_back(pulse(i + 0.2, i + 0.4, {0.05, -0.02, 0.03}));
  const Answer quick = solved(posed(near, question_at({0, 20}, 1e-6)));
  CHECK(std::string_view(quick.model) == "full");
}

TEST_CASE("the value at a listed time is that behind a step, and the momentum stays where a held rate steps") {
  Problem<double> problem = brick();
  problem.wheels = {wheel(WheelType::held, {0, 0.6, 0.8}), wheel(WheelType::free, {1, 0, 0})};
  problem.wheels[0].axial_inertia = 0.3, problem.wheels[1].axial_inertia = 0.2;
  problem.wheels[1].rate = 3;
  auto& table = problem.wheels[0].table;
  table.times = {0, 10, 20}, table.values = {2, 7, -4}, table.between = Between::step, table.holds = true;
  problem.wheels[0].rate = 2;
  const std::vector<double> times = {0, 5, 10, 15, 20, 33};
  const Answer answer = by(rung::segments, problem, times, 1e-8);
  const Answer full = by(rung::full, problem, times, 1e-12);
  check_within(answer, full);
  CHECK(answer.find("rotor_rate")->values[4] == 7);
  const auto& norm = answer.find("angular_momentum_norm")->values;
  CHECK(std::abs(norm[5] / norm[0] - 1) < 1e-12);
}

TEST_CASE("a segment between neighbours among the doubles keeps its own law") {
  Problem<double> problem = brick();
  problem.wheels = {wheel(WheelType::held, {0, 0.6, 0.8})};
  const double first = std::nextafter(3.7, 4), second = std::nextafter(first, 4);  // their mean rounds to the second
  REQUIRE(first + (second - first) / 2 == second);
  auto& table = problem.wheels[0].table;
  table.times = {0, first, second}, table.values = {2, 7, -400}, table.between = Between::step, table.holds = true;
  problem.wheels[0].rate = 2;
  const std::vector<double> times = {1, first, second, 5};
  const Answer answer = by(rung::segments, problem, times, 1e-6);
  check_within(answer, by(rung::full, problem, times, 1e-12));
  const Column& rates = *answer.find("rotor_rate");
  CHECK(rates.values[1] == 7);
  CHECK(rates.values[2] == -400);
}

TEST_CASE("thrust moves the mass centre from segment to segment") {
  Problem<double> problem = brick();
  problem.inertia = Vec3<double>(3, 3, 2).asDiagonal();
  problem.angular_velocity = {0.01, 0.02, 2};
  problem.mass = 5;
  for (const double at : {2.0, 20.0, 37.0}) {
    auto thrust = torque(TorqueType::thrust, {0.1, 0, 3});
    thrust.point = {0, 0, -0.4};
    thrust.factor.on = {{at, at + 3}};
    problem.torques.push_back(thrust);
  }
  const std::vector<double> times = {0, 1, 3, 10, 22, 39, 60};
  const Answer answer = by(rung::segments, problem, times, 1e-9);
  check_within(answer, by(rung::full, problem, times, 1e-12));
  CHECK(answer.find("position")->error < 1e-6);
}

TEST_CASE("what is not steady in segments is left to the full equations, and says so by name") {
  const auto refused = [](const Problem<double>& problem) {
    const Scene scene = posed(problem, question_at({0, 1000}, 1e-6, rung::segments));
    gyrostat::Refusal refusal;
    (void)general::solve(scene, refusal);
    CHECK(refusal.code == Errc::not_applicable);
    return std::isnan(cost_of_segments(scene));
  };
  CHECK(refused(brick()));
  Problem<double> waving = pushed();
  waving.torques[0].factor.amplitude = 0.5, waving.torques[0].factor.rate = 1;
  CHECK(refused(waving));
  Problem<double> ramp = brick();
  ramp.torques = {torque(TorqueType::table, {0, 0, 0})};
  ramp.torques[0].table = {{0, 10, 20}, {0, 0, 0, 0.1, 0, 0, 0, 0, 0}, Between::linear, false};
  CHECK(refused(ramp));
  Problem<double> braked = pushed();
  braked.torques.push_back(torque(TorqueType::brake, {1e-4, 1e-4, 1e-4}));
  braked.torques.back().opposed = Opposed::momentum;
  CHECK(refused(braked));
  Problem<double> driven = pushed();
  driven.wheels = {wheel(WheelType::torque, {0, 0.6, 0.8})};
  driven.wheels[0].torque = 0.01;
  CHECK(refused(driven));
  Problem<double> often = brick();
  for (int i = 0; i < 40; ++i) often.torques.push_back(pulse(10 + 20 * i, 20 + 20 * i, {0.01, 0, 0}));
  CHECK(refused(often));
}

TEST_CASE("an error grows from segment to segment no less than the motion makes it") {
  // beside the unstable rotation, so that what the first segments leave grows
  Problem<double> problem = brick();
  problem.angular_velocity = {1e-3, 1, 1e-3};
  problem.torques = {pulse(10, 11, {1e-3, 0, 1e-3}), pulse(20, 21, {1e-3, 0, -1e-3})};
  const auto times = every(5, 60);
  const Answer answer = by(rung::segments, problem, times, 1e-4);
  check_within(answer, by(rung::full, problem, times, 1e-12));
}

TEST_CASE("segments end where too little is known of where the next begins") {
  // pushed for long, ever faster
  Problem<double> problem = brick();
  problem.inertia = Vec3<double>(0.49, 0.74, 0.87).asDiagonal();
  problem.angular_velocity = {-1.2, -1.7, 0.54};
  problem.torques = {pulse(36, 145, {-0.018, 0.007, -0.003}),  pulse(165, 213, {0.002, 0.009, 0.18}),
                     pulse(247, 266, {0, -0.005, -0.015}),     pulse(346, 353, {-0.004, 0.015, -0.005}),
                     pulse(382, 462, {-0.01, -0.014, -0.002}), pulse(465, 485, {0, 0, 0.005})};
  const Scene alone = posed(problem, question_at({0, 514}, 1e-6, rung::segments));
  gyrostat::Refusal refusal;
  (void)general::solve(alone, refusal);
  CHECK(refusal.code == Errc::not_applicable);
  CHECK(refusal.why == errors_grew);
  const Answer answer = solved(posed(problem, question_at({0, 514}, 1e-6)));
  CHECK(std::string_view(answer.model) == "full");
  check_within(answer, by(rung::full, problem, {0, 514}, 1e-12));
}

TEST_CASE("a segment in which a torque drives the body fast is foreseen to be as dear") {
  // about its middle axis, which no family follows in closed form
  Problem<double> problem = brick();
  problem.angular_velocity = {-0.65, 1.58, -0.3};
  problem.torques = {pulse(1700, 3600, {0, 0.2, 0.05})};
  const Scene scene = posed(problem, question_at({0, 4000}, 1e-4));
  CHECK(cost_of_segments(scene) > cost_of_full(scene));
  const Answer answer = solved(scene);
  CHECK(std::string_view(answer.model) == "full");
  for (const Attempt& attempt : answer.tried)
    if (!attempt.accepted) CHECK(attempt.spent == 0);
}

TEST_CASE("a segment whose closed form refuses is foreseen to be as dear as the full equations that answer it") {
  // damping in proportion to the inertia, which equal-torque follows in closed form, but not beside a wheel
  Problem<double> problem = brick();
  problem.inertia = Vec3<double>(3, 4, 5).asDiagonal();
  problem.angular_velocity = {0.2, 0.1, 0.3};
  auto& wheel = problem.wheels.emplace_back();
  wheel.type = WheelType::held, wheel.axis = {0.6, 0, 0.8}, wheel.axial_inertia = 0.1, wheel.rate = 20;
  problem.torques.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    problem.torques[i].type = TorqueType::damping;
    problem.torques[i].matrix = double(i + 1) * 1e-3 * problem.inertia;
  }
  problem.torques[0].factor.on = {{0, 150}}, problem.torques[1].factor.on = {{150, 1000}};
  const Scene scene = posed(problem, question_at({0, 200, 400}, 1e-8));
  CHECK(cost_of_segments(scene) > 10 * cost_of_full(scene));
  CHECK(std::string_view(solved(scene).model) == "full");
}

TEST_CASE("segments that would take minutes are refused before they are begun") {
  // a slim body that a torque spins up to 1e7 rad/s: by name they took over a minute
  Problem<double> problem = brick();
  problem.inertia = Vec3<double>(100, 3.55e-5, 100.00001).asDiagonal();
  problem.angular_velocity = {-2.5, -1.5, 2.1};
  problem.torques = {pulse(0.11, 1.4, {400, -423, -166})};
  const Scene scene = posed(problem, question_at({2.2}, 1e-9, rung::segments));
  CHECK(cost_of_segments(scene) > longest_segments);
  Refusal refusal;
  const Answer none = solve(scene, refusal);
  CHECK(refusal.code == Errc::step_limit);
  CHECK(std::string_view(refusal.why) == too_long_in_segments);
  CHECK(none.columns.empty());
}
