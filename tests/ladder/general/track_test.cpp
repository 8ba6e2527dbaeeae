// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/track.hpp"

#include "answered.hpp"

using namespace general_scenes;

namespace {

/// A state that moves, and a scene with an orbit, a vertical and a wheel.
Problem<double> everything() {
  Problem<double> p = brick();
  p.wheels = {wheel(WheelType::motor, {0, 0.6, 0.8})};
  p.wheels[0].slope = 1e-3;
  p.orbit.emplace();
  p.field.down = {0.6, 0, -0.8};
  p.torques = {torque(TorqueType::gravity_gradient, {0, 0, 0}), torque(TorqueType::constant, {0.1, 0, 0})};
  p.torques[0].gradient = 0.01;
  return p;
}

}  // namespace

TEST_CASE("columns that are made of others are what they say", "[general]") {
  Question question = question_at({0, 0.7, 3});
  question.asked = all_columns();
  const Scene scene = posed(everything(), question);
  const Answer answer = true_answer(scene);
  const auto at = [&](const char* name, std::size_t i) {
    return &answer.find(name)->values[i * std::size_t(answer.find(name)->row_width())];
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const double* x = at("attitude", i);
    const Quat<double> q{x[3], x[0], x[1], x[2]};
    const Eigen::Map<const Vec3<double>> M(at("angular_momentum", i)), M_I(at("angular_momentum_inertial", i)),
        down(at("down", i)), w(at("angular_velocity", i)), tau(at("torque", i));
    CHECK((rotate<double>(q, M) - M_I).norm() < 1e-14);
    CHECK(*at("angular_momentum_norm", i) == Approx(M.norm()));
    CHECK((rotate<double>(conjugate(q), Vec3<double>(0.6, 0, -0.8)) - down).norm() < 1e-15);
    const auto& wheels = scene.wheels();
    const double p = 0.05 * (*at("rotor_rate", i) + Vec3<double>(0, 0.6, 0.8).dot(w));
    CHECK(*at("energy", i) == Approx(w.dot(wheels.reduced * w) / 2 + p * p / 0.1));
    const Vec3<double> pull = 0.01 * Vec3<double>(down).cross(wheels.whole * down) + Vec3<double>(0.1, 0, 0);
    CHECK((tau - pull).norm() < 1e-15);
    // the body seen from the axes of the orbit: x along it, y against its normal, z to the centre
    const double* y = at("attitude_orbit", i);
    const double t = question.times[i];
    const Vec3<double> outward(std::cos(t), std::sin(t), 0);
    const Vec3<double> centre_B = rotate<double>(conjugate(q), Vec3<double>(-outward));
    CHECK((rotate<double>(Quat<double>{y[3], y[0], y[1], y[2]}, centre_B) - Vec3<double>(0, 0, 1)).norm() < 1e-14);
  }
  CHECK(answer.find("attitude")->values[3] == everything().attitude.w);
}

TEST_CASE("what a rung does not know has no value and an infinite error", "[general]") {
  Question question = question_at({1});
  question.asked = all_columns();
  const Scene scene = posed(everything(), question);
  Track track;
  track.states.resize(1);
  track.off[primitive::attitude] = 1e-9;
  Answer answer;
  fill(answer, scene, track);
  CHECK(answer.find("attitude")->error == 1e-9);
  CHECK(answer.find("down")->error >= 1e-9);
  for (const char* name : {"angular_velocity", "angular_momentum_inertial", "rotor_rate", "torque", "energy"}) {
    CHECK(answer.find(name)->error == infinity<double>);
    CHECK(std::isnan(answer.find(name)->values[0]));
  }
}

TEST_CASE("the error of a torque is what the errors of the motion make of it", "[general]") {
  Question question = question_at({1});
  question.asked = {{column::torque}};
  const Scene scene = posed(everything(), question);
  Answer exact, off;
  Track track;
  const std::vector<long double> wide{1};
  track.states.push_back(general_truth::cast<double>(
      general_truth::motion<long double>(general_truth::cast<long double>(scene.problem()), wide, 1e-16L)[0]));
  track.off.fill(1e-3);
  fill(exact, scene, track);
  track.states[0].attitude = normalised(track.states[0].attitude * Quat<double>{1, 4e-4, 2e-4, 0});
  fill(off, scene, track);
  const double apart = column_error(off.columns[0], exact.columns[0]);
  CHECK(apart > 0);
  CHECK(apart < exact.columns[0].error);
  CHECK(exact.columns[0].error < 30 * apart);
}

TEST_CASE("what a law keeps is as far off as it has gone from the start, however far the phase is", "[general]") {
  Problem<double> problem = brick();
  problem.wheels = {wheel(WheelType::free, {0, 0.6, 0.8}), wheel(WheelType::held, {1, 0, 0})};
  problem.wheels[0].rate = 3, problem.wheels[1].rate = -2;
  Question question = question_at({3});
  question.asked = {{column::angular_momentum_inertial}, {column::angular_momentum_norm}, {column::energy}};
  const auto answered = [&](const Quat<double>& turn) {
    const Scene scene = posed(problem, question);
    Track track;
    const std::vector<long double> wide{3};
    track.states.push_back(general_truth::cast<double>(
        general_truth::motion<long double>(general_truth::cast<long double>(scene.problem()), wide, 1e-16L)[0]));
    track.states[0].attitude = normalised(turn * track.states[0].attitude);
    track.off.fill(1e-3);
    Answer answer;
    fill(answer, scene, track);
    return answer;
  };
  const Answer exact = answered({});
  for (const Column& column : exact.columns) {
    CAPTURE(column.name());
    CHECK(column.error < 1e-14);
    CHECK(column.error > 4 * epsilon<double>);
  }
  const Answer off = answered({1, 4e-7, 2e-7, 0});
  const double apart = column_error(off.columns[0], exact.columns[0]);
  CHECK(apart > 1e-8);
  CHECK(off.columns[0].error >= apart);
  CHECK(off.columns[0].error < 1.0001 * apart);
  problem.wheels[0].type = WheelType::motor, problem.wheels[0].slope = 1e-3;
  CHECK(answered({}).find("angular_momentum_norm")->error < 1e-14);
  CHECK(answered({}).find("energy")->error > 1e-4);
  problem.torques = {torque(TorqueType::constant, {0.1, 0, 0})};
  for (const Column& column : answered({}).columns) CHECK(column.error > 1e-4);
}

TEST_CASE("angles of the attitude count turns, and state an error that holds for each of them") {
  Problem<double> problem = brick();
  problem.angular_velocity = {0.1, 0.2, 1.4};
  std::vector<double> times;
  for (int i = 0; i <= 200; ++i) times.push_back(0.25 * i);
  for (const EulerAxes& axes : {EulerAxes{2, 1, 0}, EulerAxes{2, 0, 2}, EulerAxes{0, 1, 2}}) {
    const Scene scene = posed(problem, question_at(times, 1e-7)).told_by(axes);
    const Answer answer = solved(scene);
    const Column& euler = *answer.find("euler");
    const Column& attitude = *answer.find("attitude");
    double turned = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double* a = &euler.values[3 * i];
      const double* q = &attitude.values[4 * i];
      const auto told = quaternion_from_euler<double>(axes, {a[0], a[1], a[2]});
      CHECK(angle_between<double>(told, {q[3], q[0], q[1], q[2]}) < 2e-15 + 4e-16 * (std::abs(a[0]) + std::abs(a[2])));
      if (i > 0) CHECK(std::abs(a[0] - a[-3]) < 3.1416);
      turned = std::max({turned, std::abs(a[0]), std::abs(a[2])});
    }
    CHECK(turned > 20);
    CHECK(euler.error >= attitude.error);
    CHECK(euler.error < 100 * attitude.error);
    const Answer truth = true_answer(scene);
    CHECK(column_error(euler, *truth.find("euler")) <= euler.error);
  }
}

TEST_CASE("angles at their lock have no error, and one that may be a turn off has none either") {
  Problem<double> problem = brick();
  problem.angular_velocity = {0, 0, 1};
  problem.attitude = {1, 0, 0, 0};
  const Answer locked = solved(posed(problem, question_at({0, 1}, 1e-7)).told_by({2, 0, 2}));
  CHECK(locked.find("euler")->error == infinity<double>);
  CHECK(locked.warns("gimbal-lock"));
  CHECK(!locked.met);
  CHECK(solved(posed(problem, question_at({0, 1}, 1e-7)).told_by({2, 1, 0})).met);
  // half a turn from one time to the next
  const Answer half = solved(posed(problem, question_at({0, pi<double>}, 1e-7)).told_by({2, 1, 0}));
  CHECK(half.find("euler")->error == infinity<double>);
  CHECK(!half.warns("gimbal-lock"));
}
