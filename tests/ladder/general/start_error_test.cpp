// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/start_error.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "answered.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::general;
using namespace general_scenes;

namespace {

Question all_at(std::vector<double> times, double tolerance) {
  Question question = question_at(std::move(times), tolerance);
  question.asked = all_columns();
  for (auto& each : question.asked) each.needed = false;
  return question;
}

Problem<double> driven() {
  Problem<double> made = brick();
  Torque<double> push;
  push.vector = {0.02, -0.01, 0.03};
  push.factor.on = {{1, 4}};
  made.torques.push_back(push);
  made.wheels.push_back({WheelType::friction, Vec3<double>(0.6, 0, 0.8), 0.2, 12, 0, 0, 0.05, 0, 0, {}});
  return made;
}

/// Another start within the error.
Problem<double> within(const Problem<double>& of, const StartError& error, int which) {
  const double angle = 0.7 * which;
  const Vec3<double> u(std::cos(angle), std::sin(angle) * std::cos(3 * angle), std::sin(angle) * std::sin(3 * angle));
  Problem<double> made = of;
  made.angular_velocity += error.angular_velocity * Vec3<double>(u[2], u[0], u[1]);
  const Vec3<double> half = error.attitude / 2 * u;
  made.attitude = normalised(of.attitude * Quat<double>{1, half[0], half[1], half[2]});
  for (auto& wheel : made.wheels) wheel.rate += (which % 2 ? 1 : -1) * error.rotor_rate;
  return made;
}

}  // namespace

namespace {

/// How often a monitor is asked before it stops the work.
int asked_before_stop = 0;

}  // namespace

TEST_CASE("a work that is cancelled while the start is displaced has no answer") {
  StartError error;
  error.attitude = 1e-3, error.angular_velocity = 1e-4;
  const auto scene = posed(driven(), all_at({0, 3, 11, 40}, 1e-9)).known_within(error);
  int stopped = 0, answered = 0;
  for (int times = 0; times < 200 && answered == 0; times += 1 + times / 4) {
    asked_before_stop = times;
    Monitor monitor;
    monitor.stop = []() noexcept { return asked_before_stop-- == 0; };  // once, as a signal
    Refusal refusal;
    const Answer answer = solve(scene, refusal, &monitor);
    CAPTURE(times);
    if (refusal.code == Errc::cancelled) {
      CHECK(answer.columns.empty());
      ++stopped;
    } else {
      REQUIRE(refusal.code == Errc::ok);
      CHECK(answer.error < 1);
      ++answered;
    }
  }
  CHECK(stopped > 2);
  CHECK(answered == 1);
}

TEST_CASE("what an error of the start makes of an answer is stated, and not far too large") {
  for (const double size : {1e-3, 1e-6, 1e-10})
    for (const auto& problem : {brick(), driven()}) {
      StartError error;
      error.attitude = size, error.angular_velocity = size / 5, error.rotor_rate = 3 * size;
      const Question question = all_at({0, 3, 11, 40}, 0.1 * size > 1e-11 ? 0.1 * size : 1e-11);
      const Answer answer = solved(posed(problem, question).known_within(error));
      const Answer alone = solved(posed(problem, question));
      std::vector<double> most(answer.columns.size());
      for (int which = 0; which < 12; ++which) {
        const Answer truth = true_answer(posed(within(problem, error, which), question));
        for (std::size_t i = 0; i < most.size(); ++i)
          most[i] = std::max(most[i], column_error(answer.columns[i], *truth.find(answer.columns[i].name())));
      }
      for (std::size_t i = 0; i < most.size(); ++i) {
        CAPTURE(size, answer.columns[i].name(), most[i], answer.columns[i].error, alone.columns[i].error);
        CHECK(most[i] <= answer.columns[i].error * (1 + 1e-9));
        CHECK(answer.columns[i].error <= 8 * most[i] + 2 * alone.columns[i].error);
      }
    }
}

TEST_CASE(
    "angles of a sequence are off by what the start's attitude makes of them, though nothing feels how the body is "
    "turned") {
  StartError error;
  error.attitude = 1e-5;
  Question question = question_at({0, 3, 11}, 1e-8);
  question.asked = {{column::euler}, {column::attitude}};
  const auto told = [&](const Problem<double>& problem) { return posed(problem, question).told_by({2, 1, 0}); };
  const Answer answer = solved(told(brick()).known_within(error));
  double most = 0;
  for (int which = 0; which < 12; ++which)
    most =
        std::max(most, column_error(*answer.find("euler"), *solved(told(within(brick(), error, which))).find("euler")));
  CAPTURE(most, answer.find("euler")->error);
  CHECK(most > 1e-6);
  CHECK(most <= answer.find("euler")->error);
  CHECK(answer.find("euler")->error <= 8 * most);
}

TEST_CASE("many wheels that go along do not make the error of their angles larger") {
  Problem<double> problem = brick();
  problem.torques.clear();
  for (const Vec3<double>& axis : {Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0), Vec3<double>(0, 0, 1)})
    problem.wheels.push_back({WheelType::held, axis, 0.01, 3, 0, 0, 0, 0, 0, {}});
  StartError error;
  error.rotor_angle = 1e-6;
  const Answer answer = solved(posed(problem, all_at({0, 3}, 1e-8)).known_within(error));
  const Column& angles = *answer.find("rotor_angle");
  CHECK(angles.error * size_of(angles) >= 1e-6);
  CHECK(angles.error * size_of(angles) <= 1.001e-6);
}

TEST_CASE("the tolerance holds for the start's error and the answer's own together") {
  const Question question = question_at({0, 20}, 1e-4);
  StartError error;
  error.attitude = 8e-5;
  const Answer near = solved(posed(driven(), question).known_within(error));
  CHECK(near.met);
  CHECK(near.find("attitude")->error >= 8e-5);
  CHECK(near.find("attitude")->error <= 1e-4);
  CHECK(!near.warns("start-uncertain"));
  error.attitude = 2e-4;
  const Answer far = solved(posed(driven(), question).known_within(error));
  CHECK(!far.met);
  CHECK(far.warns("start-uncertain"));
  CHECK(far.tolerance == 1e-4);
}

TEST_CASE("a start beside an unstable rotation states an error that has grown") {
  Problem<double> problem = brick();
  problem.angular_velocity = {0, 1, 0};
  StartError error;
  error.angular_velocity = 1e-9;
  // the rate of growth is sqrt((5 - 4)(4 - 3)/(3 5)), so that 1e-9 becomes some 1e-3 in 54 s
  const Answer answer = solved(posed(problem, question_at({0, 54}, 1e-8)).known_within(error));
  CHECK(answer.find("angular_velocity")->error > 3e-4);
  CHECK(answer.find("angular_velocity")->error < 1e-1);
}

TEST_CASE("a start that may be nearer to an unstable rotation, or farther, states what either side makes") {
  Problem<double> problem;
  problem.inertia = Vec3<double>(1, 2, 3).asDiagonal();
  for (const auto& [off, share, time] :
       {std::array{1e-2, 0.99, 20.}, {1e-3, 0.99, 20.}, {1e-4, 0.99, 30.}, {1e-2, 0.7, 40.}}) {
    problem.angular_velocity = {off, 1, 0};
    StartError error;
    error.angular_velocity = share * off;
    const Question question = all_at({time}, 0.3);
    const Answer answer = solved(posed(problem, question).known_within(error));
    for (const double side : {-1., 1.}) {
      Problem<double> other = problem;
      other.angular_velocity[0] += side * error.angular_velocity;
      const Answer truth = true_answer(posed(other, question));
      for (const char* name : {"angular_velocity", "attitude"}) {
        CAPTURE(off, share, side, name);
        const Column& column = *answer.find(name);
        CHECK(column_error(column, *truth.find(name)) <= column.error);
      }
    }
  }
}

TEST_CASE("wheels that may all turn faster add up") {
  Problem<double> problem;
  problem.inertia = Vec3<double>(1, 1.2, 1.5).asDiagonal();
  problem.angular_velocity = {0, 0, 0.1};
  for (int i = 0; i < 4; ++i)
    problem.wheels.push_back({WheelType::free, Vec3<double>(0, 0, 1), 0.01, 100, 0, 0, 0, 0, 0, {}});
  StartError error;
  error.rotor_rate = 0.1;
  const Question question = all_at({10}, 1e-2);
  const Answer answer = solved(posed(problem, question).known_within(error));
  for (auto& wheel : problem.wheels) wheel.rate += error.rotor_rate / 2;  // four make the whole length
  const Answer truth = true_answer(posed(problem, question));
  const Column& column = *answer.find("angular_momentum");
  const double off = column_error(column, *truth.find("angular_momentum"));
  CHECK(off <= column.error * (1 + 1e-9));
  CHECK(column.error < 1.1 * off);
}

TEST_CASE("errors of path and wheel angles go along") {
  StartError error;
  error.position = 2, error.velocity = 0.5, error.rotor_angle = 0.125;
  Problem<double> problem = driven();
  problem.velocity = {1, 0, 0};
  const Scene scene = posed(problem, all_at({0, 10}, 1e-6)).known_within(error);
  const Answer answer = solved(scene);
  const auto absolute = [&](const char* name) { return answer.find(name)->error * size_of(*answer.find(name)); };
  CHECK(std::abs(absolute("position") - 7) < 1e-3);
  CHECK(std::abs(absolute("velocity") - 0.5) < 1e-3);
  CHECK(std::abs(absolute("rotor_angle") - 0.125) < 1e-3);
}

TEST_CASE("a torque of the caller's own may see how the body is turned") {
  const auto pull = [](double, const Seen<double>& seen) noexcept -> Vec3<double> {
    return rotate<double>(conjugate(seen.attitude), Vec3<double>(0, 0, 0.2));
  };
  StartError error;
  error.attitude = 1e-3;
  Question question = question_at({0, 10}, 1e-6);
  const Scene scene = posed(brick(), question).driven_by(OwnTorque::of(pull, {20}));
  const Answer answer = solved(scene.known_within(error)), alone = solved(scene);
  CHECK(alone.find("angular_velocity")->error < 1e-6);
  CHECK(answer.find("angular_velocity")->error > 1e-4);
}

TEST_CASE("motions that have parted are told so where they are near again at the asked time") {
  Problem<double> problem;
  problem.inertia = Vec3<double>(0.3707108262898389, 0.8612564649290942, 1).asDiagonal();
  problem.angular_velocity = {0, 1, 0};
  StartError error;
  error.angular_velocity = 0.005617898550954795;
  const Answer answer = solved(posed(problem, question_at({58.944893596808846}, 0.3)).known_within(error));
  CHECK(!answer.met);
  CHECK(answer.find("angular_velocity")->error > 1);
}

TEST_CASE("what two errors of the start do together, and none by itself, is stated") {
  Problem<double> problem;
  problem.inertia = Vec3<double>(1, 2, 2.5).asDiagonal();
  problem.angular_velocity = {0, 0, 1};
  problem.wheels.push_back({WheelType::free, Vec3<double>(0, 0, 1), 0.01, 0.1, 0, 0, 0, 0, 0, {}});
  StartError error;
  error.angular_velocity = 0.05;
  for (const double t : {0.02, 5.}) {
    const Question question = all_at({t}, 1e-2);
    const Answer answer = solved(posed(problem, question).known_within(error));
    for (const double side : {-1., 1.}) {
      Problem<double> other = problem;
      other.angular_velocity += error.angular_velocity * std::sqrt(0.5) * Vec3<double>(1, side, 0);
      const Answer truth = true_answer(posed(other, question));
      for (const char* name : {"rotor_rate", "rotor_angle"}) {
        CAPTURE(t, side, name);
        CHECK(column_error(*answer.find(name), *truth.find(name)) <= answer.find(name)->error);
      }
    }
  }
}

TEST_CASE("what a start may be off is taken over the least that the true column may be") {
  Problem<double> problem;
  problem.inertia = Mat3<double>::Identity();
  problem.angular_velocity = {0, 0, 1};
  problem.wheels.push_back({WheelType::motor, Vec3<double>(0, 0, 1), 0.1, 1, 0, 0, 0, 0, 0, {}});
  StartError error;
  error.rotor_rate = 0.4;
  const Question question = all_at({0.1}, 0.5);
  const Answer answer = solved(posed(problem, question).known_within(error));
  problem.wheels[0].rate = 0.6;
  const double off =
      column_error(*answer.find("rotor_rate"), *true_answer(posed(problem, question)).find("rotor_rate"));
  CHECK(off > 0.66);
  CHECK(off <= answer.find("rotor_rate")->error * (1 + 1e-12));
}
