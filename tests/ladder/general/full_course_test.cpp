// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/full_course.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "../../models/general/cases.hpp"
#include "../../models/general/scenes.hpp"
#include "at_length.hpp"
#include "catch.hpp"
#include "runs.hpp"

namespace general_full_course_test {

using namespace general_runs;
using ode::Status;

TEST_CASE("every breakpoint ends a step", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.torques.resize(1);
  p.torques[0].vector = {1, 0.5, -0.3};
  p.torques[0].factor.on = {{0.7, 1.9}, {2.2, 3.1}};
  const auto cuts = breakpoints(p, 4.);
  REQUIRE(cuts.size() == 4);
  general::detail::FullCourse<general::detail::Series<double, false>> course(p, 4, 1, {1e-6, 1e-6}, 1000);
  std::vector<double> ends;
  while (course.time() < 4) {
    REQUIRE(course.step(4) == Status::reached);
    ends.push_back(course.time());
  }
  for (const double cut : cuts) CHECK(std::count(ends.begin(), ends.end(), cut) == 1);
}

TEST_CASE("at a time where laws change the state is that by the new one", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.wheels.resize(1);
  p.wheels[0].axial_inertia = 0.1;
  p.wheels[0].table = {{0, 1, 2}, {10, 20, 30}, Between::step, true};
  p.torques.resize(1);
  p.torques[0].vector = {0, 0, 1};
  p.torques[0].factor.on = {{1, 2}};
  const std::vector<double> at{0, 0.999999, 1, 1.5, 2, 3};
  const auto made = run(p, at, 1e-10);
  CHECK(made.answer.met);
  const double rates[] = {10, 10, 20, 20, 30, 30}, torques[] = {0, 0, 1, 1, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(made.states[i].rotor_rate[0] == Approx(rates[i]));
    const State<double>& s = made.states[i];
    const Pose<double> pose{s.attitude, s.angular_velocity, s.angular_momentum};
    CHECK(load_at(p, pose, at[i], at[i]).torque[2] == torques[i]);
  }
  // the momentum does not jump where the rate does
  CHECK((made.states[1].angular_momentum - made.states[2].angular_momentum).norm() < 1e-5);
  CHECK(made.states[1].angular_velocity[2] - made.states[2].angular_velocity[2] == Approx(1 / 1.5).epsilon(1e-4));
  CHECK(made.states[5].rotor_angle[0] == Approx(10 + 20 + 30));
}

TEST_CASE("a law that changes before any step ends holds from the start", "[general]") {
  Problem<double> problem;
  problem.inertia = Vec3<double>(0.8, 1.9, 2).asDiagonal(), problem.angular_velocity = {-0.25, 0.8, -0.5};
  auto& push = problem.torques.emplace_back();
  push.type = TorqueType::table;
  push.table = {{0, 1e-300, 2}, {0, 0, 0, 0.3, -0.1, 0.2, 0, 0, 0}, Between::step, true};
  const auto early = run(problem, {1, 3}, 1e-9).states;
  push.table = {{0, 2}, {0.3, -0.1, 0.2, 0, 0, 0}, Between::step, true};
  const auto right = run(problem, {1, 3}, 1e-9).states;
  for (const std::size_t i : {0U, 1U}) CHECK((early[i].angular_velocity - right[i].angular_velocity).norm() < 1e-12);
}

TEST_CASE("times of a table that are neighbours among the doubles", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.wheels.resize(1);
  p.wheels[0].axial_inertia = 0.1;
  const std::vector<double> at{0, 0.5, 1.5, 4};
  p.wheels[0].table = {{0, 1, 3}, {10, 30, 20}, Between::step, true};
  const auto one_step = run(p, at, 1e-9);
  for (const Between between : {Between::step, Between::linear}) {
    // through 15, or straight, within a rounding of the time
    const double now = 1, next = std::nextafter(now, 2.), last = std::nextafter(3., 4.);
    if (between == Between::step) p.wheels[0].table = {{0, now, next, 3}, {10, 15, 30, 20}, between, true};
    else p.wheels[0].table = {{0, now, next, 3, last}, {10, 10, 30, 30, 20}, between, true};
    const auto made = run(p, at, 1e-9);
    CAPTURE(int(between), made.answer.error[full_column::attitude]);
    CHECK(made.answer.status == Status::reached);
    CHECK(made.answer.met);
    const Comparison<FullRow<double>> rows(FullRow<double>(Prepared<double>(p, at.back())));
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto off = rows.apart(rows.row(made.states[i]), rows.row(one_step.states[i]));
      CHECK(off[full_column::angular_velocity] <= 1e-12);
      CHECK(off[full_column::rotor_angle] <= 1e-12);
    }
  }
}

Problem<double> braked(double limit) {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.torques.resize(1);
  p.torques[0].type = TorqueType::brake, p.torques[0].opposed = Opposed::momentum;
  p.torques[0].vector = {limit, limit, limit};
  return p;
}

TEST_CASE("a body that a brake has stopped rests", "[general]") {
  auto p = braked(0.1);
  for (const bool about_an_axis : {true, false}) {
    p.angular_velocity = about_an_axis ? Vec3<double>(0, 0, 0.4) : Vec3<double>(0.1, 0.2, 0.3);
    const double stop = (p.inertia * p.angular_velocity).norm() / 0.1;
    for (const double tolerance : {1e-4, 1e-11}) {
      CAPTURE(about_an_axis, tolerance);
      const auto past = run(p, {stop / 2, 2 * stop, 3 * stop}, tolerance);
      CHECK(past.answer.status == Status::reached);
      CHECK(past.answer.met);
      REQUIRE(past.answer.rests.size() == 1);
      CHECK(std::abs(past.answer.stop - stop) <= past.answer.stop_off);
      CHECK(past.answer.stop_off < std::max(1e-8, 10 * tolerance) * stop);
      CHECK(past.states[0].angular_momentum.norm() == Approx(0.05 * stop));
      CHECK(past.states[1].angular_velocity.isZero(0));
      CHECK(past.states[2].attitude == past.states[1].attitude);
      CHECK(run(p, {0.9 * stop}, tolerance).answer.met);
      if (!about_an_axis) continue;
      const double off = std::abs(2 * std::atan2(past.states[1].attitude.z, past.states[1].attitude.w) - 0.4 * 6 / 2);
      CHECK(off <= past.answer.error[full_column::attitude]);
      CHECK(off < 1e-13);
    }
    const auto sums = balance<double>(p, 2 * stop, 1e-14, false);
    CHECK(sums.energy < 1e-12);
    CHECK(sums.momentum < 1e-13);
  }
}

/// The momentum along the push, N m s, of a body that turns with `first` under one brake and pushes F_i from t_i on.
double pushed(double first, double limit, const std::vector<std::array<double, 2>>& pushes, double t) {
  double m = first;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const double force = pushes[i][1], end = i + 1 < pushes.size() ? std::min(t, pushes[i + 1][0]) : t;
    for (double now = pushes[i][0]; now < end;) {
      if (m == 0 && std::abs(force) <= limit) break;
      const double rate = force - std::copysign(limit, m == 0 ? force : m);
      const double stop = rate * m < 0 ? now - m / rate : infinity<double>;
      m = stop <= end ? 0 : m + rate * (end - now);
      now = std::min(stop, end);
    }
  }
  return m;
}

TEST_CASE("a push in space stops a tumbling body, holds it, and takes it on as along one axis", "[general]") {
  auto p = braked(0.1);
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  p.angular_velocity = {0.1, 0.2, 0.3};
  const Vec3<double> L = rotate<double>(p.attitude, p.inertia * p.angular_velocity), u = L.normalized();
  const double m = L.norm();
  struct Case {
    std::vector<std::array<double, 2>> pushes;
    std::size_t rests;
  };
  const Case cases[] = {{{{0, 0}, {10, 0.3}, {15, -0.05}}, 2},     // rests, leaves at a switch, rests again
                        {{{0, -0.08}, {5, 0.09}, {12, -0.2}}, 1},  // held by two pushes in turn, then leaves
                        {{{0, -0.3}}, 0},                          // never rests
                        {{{0, -0.3}, {6, 0.05}}, 1},               // through zero, and back to it
                        {{{0, 0.1}, {20, 0.}}, 1}};                // keeps its momentum, then stops
  for (const auto& each : cases) {
    p.torques.resize(1);
    auto& push = p.torques.emplace_back();
    push.type = TorqueType::table, push.axes = Axes::inertial;
    push.table.between = Between::step, push.table.holds = true;
    for (const auto& [t, force] : each.pushes) {
      push.table.times.push_back(t);
      for (int i = 0; i < 3; ++i) push.table.values.push_back(force * u[i]);
    }
    const std::vector<double> times{1, 3, 5, 6.5, 8, 10, 10.001, 11, 12, 12.5, 14, 17, 20, 25, 40};
    for (const double tolerance : {1e-5, 1e-10}) {
      const auto made = run(p, times, tolerance);
      CAPTURE(&each - cases, tolerance);
      REQUIRE(made.answer.status == Status::reached);
      CHECK(made.answer.met);
      CHECK(made.answer.rests.size() == each.rests);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const auto& state = made.states[i];
        const double right = pushed(m, 0.1, each.pushes, times[i]);
        const Vec3<double> off = rotate<double>(state.attitude, state.angular_momentum) - right * u;
        const double stated = made.answer.error[full_column::attitude] * std::abs(right) +
                              made.answer.error[full_column::angular_momentum] * std::max(m, 4.);
        CAPTURE(times[i], right, off.norm());
        CHECK(off.norm() <= stated);
        CHECK((right != 0 || state.angular_velocity.isZero(0)));
      }
    }
  }
}

TEST_CASE("the edge of a brake: 8 roundings over are held, 9 not followed, a thousandth leaves", "[general]") {
  constexpr double eps = epsilon<double>;
  auto p = braked(0.1);
  auto& push = p.torques.emplace_back();
  const auto with = [&](double over) {
    push.vector = {0, 0, 0.1 * (1 + over)};
    return run(p, {50, 100}, 1e-9);
  };
  const auto below = with(-40 * eps), held = with(8 * eps), left = with(9 * eps), leaves = with(1e-3);
  CHECK(below.answer.met);
  CHECK(below.states[1].angular_velocity.isZero(0));
  CHECK(below.answer.stop == 0);
  CHECK(below.answer.stop_off == 0);
  CHECK(held.answer.met);
  CHECK(held.states[1].angular_velocity.isZero(0));
  // what really happens there: the body leaves with eight roundings of the torque
  const double given = 0.1 * 8 * eps * 100, angle = given / 1.5 * 50;
  CHECK(held.answer.error[full_column::attitude] > angle);
  CHECK(held.answer.error[full_column::attitude] < 100 * angle);
  CHECK(below.answer.error[full_column::attitude] < held.answer.error[full_column::attitude]);
  CHECK(left.answer.status == Status::event);
  CHECK(left.answer.at_stop == AtStop::barely);
  REQUIRE(leaves.answer.status == Status::reached);
  CHECK(leaves.answer.met);
  CHECK(leaves.states[1].angular_momentum[2] == Approx(0.1 * 1e-3 * 100).epsilon(1e-9));
  CHECK(leaves.answer.counts.steps <
        40'000);  // steps are no longer than some of the times in which its direction settles
}

TEST_CASE("steps that lengthen with what a brake opposes do not jump over the stop where it shrinks again",
          "[general]") {
  for (const double span : {1e-3, 1.0, 30.0}) {
    auto p = braked(0.1);
    const double first = 1e-6 * span;
    p.angular_velocity = {0, 0, first / 1.5};
    auto& push = p.torques.emplace_back();
    push.vector = {0, 0, 0.25};
    push.factor.table = {{0, 0.65 * span}, {1, -0.3}, Between::linear, true};
    // d|M|/dt = 0.15 - 0.5 t/span, from the first on
    const double stop = (0.15 + std::sqrt(0.0225 + first / span)) * 2 * span;
    const auto made = run(p, {0.3 * span, 0.64 * span}, 1e-9);
    CAPTURE(span, stop, made.answer.stop, made.answer.stop_off, made.answer.counts.steps);
    REQUIRE(made.answer.status == Status::reached);
    REQUIRE(made.answer.rests.size() == 1);
    CHECK(std::abs(made.answer.stop - stop) <= made.answer.stop_off + 4 * epsilon<double> * stop);
    CHECK(made.states[0].angular_momentum[2] == Approx(first + 0.0225 * span).epsilon(1e-9));
    CHECK(made.states[1].angular_velocity.isZero(0));
  }
}

TEST_CASE("stated errors hold before a stop, of its time, and behind it", "[general]") {
  general_scenes::Scenes random(83);
  const auto vector = [&](double size) {
    return Vec3<double>(size * (random.unit() - 0.5), size * (random.unit() - 0.5), size * (random.unit() - 0.5));
  };
  constexpr double tolerances[] = {1e-3, 1e-6, 1e-9};
  int compared = 0;
  for (int i = 0; i < (slow_build ? 6 : 40); ++i) {
    Problem<double> p;
    p.inertia = Vec3<double>(2 + random.unit(), 2 + random.unit(), 1.5 + random.unit()).asDiagonal();
    p.angular_velocity = vector(2);
    auto& brake = p.torques.emplace_back();
    brake.type = TorqueType::brake, brake.opposed = i % 2 == 0 ? Opposed::momentum : Opposed::carrier_momentum;
    brake.vector = {random.scale(0.02, 0.1), random.scale(0.02, 0.1), random.scale(0.02, 0.1)};
    if (i % 4 == 1) p.rotor_momentum = vector(1);
    if (i % 3 == 0) p.torques.emplace_back().vector = vector(0.02);
    if (i % 5 == 0) p.torques.emplace_back().vector = vector(0.02), p.torques.back().axes = Axes::inertial;
    const auto first = run(p, {2e3}, 1e-12);
    REQUIRE(first.answer.status == Status::reached);
    REQUIRE(first.answer.rests.size() == 1);
    // truth until all but a moment before the stop, and over that moment at the rate of the brake, which may change by its own size
    const double stop = first.answer.stop, near = stop * (1 - 1e-10), nearer = stop * (1 - 5e-11);
    const auto right = truth(p, {stop / 3, near, nearer});
    REQUIRE(right.size() == 3);
    const auto size = [&](const State<double>& s) {
      return i % 2 == 0 ? s.angular_momentum.norm() : (p.inertia * s.angular_velocity).norm();
    };
    const double U = size(right[1]), V = size(right[2]), true_stop = nearer + V / (U - V) * (nearer - near);
    const auto made = run(p, {stop / 3, nearer, 2 * stop}, tolerances[i % 3]);
    REQUIRE(made.answer.status == Status::reached);
    CAPTURE(i, stop, true_stop, made.answer.stop, made.answer.stop_off);
    CHECK(std::abs(made.answer.stop - true_stop) <= made.answer.stop_off + 5e-11 * stop);
    const auto before = apart(p, {stop / 3, nearer}, {right[0], right[2]}, {made.states[0], made.states[1]});
    check_within(before, made.answer.error);
    CHECK((i % 2 == 0 ? made.states[2].angular_momentum : made.states[2].angular_velocity).isZero(0));
    if (i % 2 == 0) continue;
    // at rest the attitude is that of the stop
    const auto behind = apart(p, {2 * stop}, {right[2]}, {made.states[2]});
    CHECK(behind[full_column::attitude] <= made.answer.error[full_column::attitude] + 1e-15);
    ++compared;
  }
  CHECK(compared >= (slow_build ? 3 : 20));
}

TEST_CASE("wheels turn a body on whose momentum a brake has taken, and forces move its centre", "[general]") {
  auto p = braked(0.1);
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.wheels.push_back({WheelType::held, Vec3<double>(0.6, 0, 0.8), 0.1, 1, 0, 0, 0, 0, 0, {}});
  p.wheels.push_back({WheelType::free, Vec3<double>(0, 1, 0), 0.1, 2, 0, 0, 0, 0, 0, {}});
  const Wheels<double> wheels = Wheels<double>::of(p);
  const Vec3<double> w = wheels.inverse * Vec3<double>(-wheels.momentum_of_wheels());
  const auto turned = run(p, {40, 43}, 1e-10);
  REQUIRE(turned.answer.met);
  CHECK((turned.states[1].angular_velocity - w).norm() < 1e-14);
  const auto q = conjugate(turned.states[0].attitude) * turned.states[1].attitude;
  const Vec3<double> half(q.x, q.y, q.z);
  CHECK((half - std::sin(1.5 * w.norm()) * w.normalized()).norm() < 1e-12);
  CHECK(turned.states[1].rotor_angle[0] - turned.states[0].rotor_angle[0] == Approx(3));
  const double free_rate = wheels.laws[1].momentum / 0.1 - w[1];
  CHECK(turned.states[1].rotor_angle[1] - turned.states[0].rotor_angle[1] == Approx(3 * free_rate));

  p.wheels.clear(), p.mass = 2;
  auto& thrust = p.torques.emplace_back();
  thrust.type = TorqueType::thrust, thrust.vector = {1, 0, 0};
  const auto moved = run(p, {40, 41, 42}, 1e-10);
  REQUIRE(moved.answer.met);
  const auto& s = moved.states;
  const Vec3<double> bend = s[2].position - 2 * s[1].position + s[0].position;
  CHECK((bend - rotate<double>(s[0].attitude, {0.5, 0, 0})).norm() < 1e-10);
}

TEST_CASE("a body at rest is let go by its brake, by a table, and by a held wheel that steps", "[general]") {
  auto p = braked(0.1);
  p.torques[0].opposed = Opposed::carrier_momentum;
  auto& push = p.torques.emplace_back();
  push.vector = {0, 0, 0.06};
  p.torques[0].factor.on = {{0, 10}, {20, 100}};
  // free from 10 s to 20 s, then braked by what the brake has over the push
  const double held = 0.06 * 10, stop = 20 + held / 0.04;
  const auto off = run(p, {10, 15, 20, 30, 50}, 1e-10);
  REQUIRE(off.answer.met);
  CHECK(off.states[0].angular_velocity.isZero(0));
  CHECK(off.states[1].angular_momentum[2] == Approx(held / 2));
  CHECK(off.states[2].angular_momentum[2] == Approx(held));
  CHECK(off.states[3].angular_momentum[2] == Approx(held - 0.04 * 10));
  REQUIRE(off.answer.rests.size() == 2);
  CHECK(std::abs(off.answer.rests[1][0] - stop) <= off.answer.rest_off);
  CHECK(off.states[4].angular_velocity.isZero(0));
  // a ramp that stays below the brake, and a step at its end
  p.torques[0].factor.on.clear();
  p.torques[1].vector = {0, 0, 1};
  p.torques[1].factor.table = {{0, 10, 10.5}, {-0.09, 0.09, 0.2}, Between::linear, true};
  CHECK(run(p, {10}, 1e-10).answer.met);
  // beyond, from where it reaches the brake, as the square of the time since
  const double begin = 10 + 0.5 * 0.01 / 0.11;
  const std::vector<double> asked{10, begin, 10.2, 10.4};
  const auto grown = run(p, asked, 1e-10);
  REQUIRE(grown.answer.met);
  REQUIRE(grown.answer.rests.size() == 1);
  CHECK(grown.answer.rests[0][1] == Approx(begin).epsilon(1e-13));
  for (std::size_t i = 1; i < 4; ++i) {
    const double since = asked[i] - begin;
    CHECK(std::abs(grown.states[i].angular_momentum[2] - 0.11 * since * since) < 1e-14);
  }
  p.torques[1].factor.table = {{0, 10, 10.5}, {-0.09, 0.2, 0.2}, Between::step, true};
  CHECK(run(p, {20}, 1e-10).states[0].angular_momentum[2] == Approx(0.1 * 10));
  // a wheel that is brought to another rate throws the body, which its brake stops again
  p.torques.pop_back();
  p.wheels.push_back({WheelType::held, Vec3<double>(0, 0, 1), 0.1, 0, 0, 0, 0, 0, 0, {}});
  p.wheels[0].table = {{0, 5}, {0, 20}, Between::step, true};
  const auto thrown = run(p, {4, 5, 20, 30}, 1e-10);
  REQUIRE(thrown.answer.met);
  CHECK(thrown.states[0].angular_velocity.isZero(0));
  CHECK(thrown.states[1].angular_velocity[2] == Approx(-2 / 1.5));
  CHECK(thrown.states[2].angular_velocity[2] == Approx(-(2 - 0.1 * 15) / 1.5));
  CHECK(thrown.states[3].angular_velocity.isZero(0));
  CHECK(thrown.answer.rests.size() == 2);
}

TEST_CASE("a body leaves its rest where a table outgrows brakes that differ by axis", "[general]") {
  for (const auto opposed : {Opposed::momentum, Opposed::carrier_momentum}) {
    Problem<double> p;
    p.inertia << 2, 0.2, 0, 0.2, 3, 0.1, 0, 0.1, 4;
    if (opposed == Opposed::carrier_momentum) p.rotor_momentum = {0.5, -0.3, 0.4};
    p.torques.resize(3);
    auto &brake = p.torques[0], &damping = p.torques[1], &push = p.torques[2];
    brake.type = TorqueType::brake, brake.opposed = opposed, brake.vector = {0.1, 0.2, 0.3};
    damping.type = TorqueType::damping, damping.matrix = 0.05 * Mat3<double>::Identity();
    push.vector = {0.3, 0.5, 0.8}, push.factor.table = {{0, 10, 20}, {0, 0.6, 0.8}, Between::linear, true};
    const std::vector<double> asked{3, 3.55, 4, 7, 12};
    const auto loose = run(p, asked, 1e-6), tight = run(p, asked, 1e-13);
    REQUIRE(loose.answer.met);
    CHECK(loose.states[0].angular_velocity.isZero(0));
    CHECK(loose.answer.rests[0][1] == Approx(10 / 0.6 / Vec3<double>(3, 2.5, 8 / 3.).norm()).epsilon(1e-13));
    double size = 0, off = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      size = std::max(size, tight.states[i].angular_velocity.norm());
      off = std::max(off, (loose.states[i].angular_velocity - tight.states[i].angular_velocity).norm());
    }
    CHECK(off <= loose.answer.error[full_column::angular_velocity] * size);
    // from the rest on by small steps of another method, a moment after it
    const double t = 3.55;
    const auto& at = loose.states[1];
    Vec3<double> w = at.angular_velocity;
    const int steps = 4000;
    const double h = (4 - t) / steps;
    const auto rate = [&](double now, const Vec3<double>& v) {
      const Vec3<double> M = p.inertia * v + p.rotor_momentum, Jw = p.inertia * v;
      const Vec3<double> n = (opposed == Opposed::momentum ? M : Jw).normalized();
      const Vec3<double> torque = 0.06 * now * push.vector - 0.05 * v - brake.vector.cwiseProduct(n);
      return Vec3<double>(p.inertia.inverse() * (M.cross(v) + torque));
    };
    for (int k = 0; k < steps; ++k) {
      const double now = t + k * h;
      const Vec3<double> a = rate(now, w), b = rate(now + h / 2, w + h / 2 * a), c = rate(now + h / 2, w + h / 2 * b);
      w += h / 6 * (a + 2 * b + 2 * c + rate(now + h, w + h * c));
    }
    CHECK((w - loose.states[2].angular_velocity).norm() < 1e-10);
  }
}

TEST_CASE("a torque that is more than the brake turns a body back from the very time of its stop", "[general]") {
  Problem<double> problem;
  const double moment = 1.7, rate = 0.93, push = 0.0517, brake = 0.0313;
  problem.inertia = Vec3<double>(2, 1.9, moment).asDiagonal(), problem.angular_velocity = {0, 0, rate};
  auto& constant = problem.torques.emplace_back();
  constant.type = TorqueType::constant, constant.vector = {0, 0, -push};
  auto& holds = problem.torques.emplace_back();
  holds.type = TorqueType::brake, holds.opposed = Opposed::momentum, holds.vector = {brake, brake, brake};
  const double stop = moment * rate / (push + brake);
  const std::vector<double> times = {stop + 1, stop + 20};
  for (const double tolerance : {1e-3, 1e-9}) {
    const auto made = run(problem, times, tolerance);
    for (const std::size_t i : {0U, 1U}) {
      const double right = -(push - brake) * (times[i] - stop) / moment;
      CAPTURE(tolerance, times[i]);
      CHECK(std::abs(made.states[i].angular_velocity[2] - right) <= 8 * epsilon<double> * stop * push / moment);
    }
  }
}

TEST_CASE("a body with a great wheel leaves its rest, however little a moment gains beside what the wheel holds",
          "[general]") {
  // M is 102 N m s, and a moment of the nutation, 3e-5 s, gave less than its last digit: the body stopped again in every step
  Problem<double> p;
  p.inertia = Vec3<double>(0.003, 0.002, 0.003).asDiagonal();
  p.wheels.resize(1);
  p.wheels[0].axis = Vec3<double>(0.22, 0.94, -0.25).normalized();
  p.wheels[0].axial_inertia = 1e-4, p.wheels[0].rate = 1.026e6;
  p.torques.resize(2);
  p.torques[0].type = TorqueType::brake, p.torques[0].opposed = Opposed::carrier_momentum;
  p.torques[0].vector = {0.0099, 0.0138, 0.0138};
  p.torques[1].vector = {-0.0102, 0.0026, -0.008};
  p.torques[1].factor.on = {{0.89, 1.09}};
  p.angular_velocity = {2.785, 0, 0};
  const std::vector<double> times{0.8, 0.95, 1.2};
  const auto made = run(p, times, 1e-3);
  CHECK(made.answer.status == Status::reached);
  CHECK(made.answer.counts.steps < 200'000);
  CHECK(made.states[0].angular_velocity.norm() == 0);
  CHECK(made.states[1].angular_velocity.norm() > 0);
  CHECK(made.states[2].angular_velocity.norm() == 0);
  // the wheel's axis goes with the push, less what the brake takes of it: in space by at most the one and at least the difference over M
  const auto direction = [&](std::size_t i) { return rotate<double>(made.states[i].attitude, p.wheels[0].axis); };
  const double turned = (direction(2) - direction(0)).norm();
  CHECK(turned < 0.2 * 0.0133 / 102.6);
  CHECK(turned > 0);
}

TEST_CASE("a stop is none because a far greater torque acted before", "[general]") {
  auto p = braked(1e-9);
  p.angular_velocity = {0, 0, 1e-5};
  auto& push = p.torques.emplace_back();
  push.vector = {0, 0, 1e8}, push.factor.on = {{0, 1e-14}};
  const auto made = run(p, {1e3, 1e4}, 1e-9);
  REQUIRE(made.answer.met);
  CHECK(made.states[0].angular_momentum[2] == Approx(1.6e-5 - 1e-6));
  CHECK(made.states[1].angular_momentum[2] == Approx(1.6e-5 - 1e-5));
  CHECK(made.answer.rests.empty());
}

TEST_CASE("a stop that is not gone through says why", "[general]") {
  const auto why = [](const Problem<double>& p) {
    const auto made = run(p, {1, 100}, 1e-6);
    CHECK(made.answer.status == Status::event);
    CHECK_FALSE(made.answer.met);
    CHECK(std::isnan(made.states[1].angular_velocity[0]));
    return made.answer.at_stop;
  };
  auto p = braked(0.1);
  p.angular_velocity = {0.1, 0.2, 0.3};
  p.torques.emplace_back().vector = {0.01, 0, 0};
  p.torques[1].factor.amplitude = 0.1, p.torques[1].factor.rate = 0.3;
  CHECK(why(p) == AtStop::varying);
  p.torques[1].factor = {};
  p.torques[1].factor.table = {{0, 40}, {0, 20}, Between::linear, false};
  auto standing = p;
  standing.angular_velocity.setZero(), standing.torques[0].vector[0] = 0;
  CHECK(why(standing) == AtStop::later);
  p.torques.pop_back();
  p.wheels.push_back({WheelType::motor, Vec3<double>(0.6, 0, 0.8), 0.1, 1, 0, 0, 0, 0.01, 20, {}});
  CHECK(why(p) == AtStop::turning);
  p.angular_velocity.setZero(), p.wheels[0].rate = 0;
  CHECK(why(p) == AtStop::turning);

  // at rest but for the rounding of a wheel's momentum along no axis
  Problem<double> askew;
  askew.inertia = Vec3<double>(0.4, 0.39, 0.31).asDiagonal();
  auto& brake = askew.torques.emplace_back();
  brake.type = TorqueType::brake, brake.opposed = Opposed::carrier_momentum, brake.vector.setConstant(0.0048);
  askew.wheels.push_back(
      {WheelType::friction, Vec3<double>(-0.3, 1, 0.15).normalized(), 0.0009, -3.6, 0, 0, 0.00075, 0, 0, {}});
  CHECK(why(askew) == AtStop::turning);
  askew.wheels[0].type = WheelType::held, askew.wheels[0].friction = 0;
  const auto made = run(askew, {1, 100}, 1e-6);
  CHECK(made.answer.met);
  CHECK(made.states[1].angular_velocity.norm() < 1e-15);
}

TEST_CASE("breakpoints, balances and stops of scenes with stiff wheels", "[general]") {
  const auto p = three_wheels(1e5);
  const auto cuts = breakpoints(p, 4.);
  general::detail::FullCourse<general::detail::Collocation<double, 4>> course(p, 4, 1, {1e-9, 1e-8}, 10'000);
  std::vector<double> ends;
  while (course.time() < 4) {
    REQUIRE(course.step(4) == Status::reached);
    ends.push_back(course.time());
  }
  for (const double cut : cuts) CHECK(std::count(ends.begin(), ends.end(), cut) == 1);
  const auto sums = balance<double>(p, 4, 1e-13, false);
  // the power of a stiff motor is its slope times a small difference
  CHECK(sums.energy < 1e-8);
  CHECK(sums.momentum < 1e-11);
  // what a brake opposes is the whole momentum, wheels or not
  auto braked = wheel_on_a_carrier(1e6);
  auto& brake = braked.torques.emplace_back();
  brake.type = TorqueType::brake, brake.opposed = Opposed::momentum, brake.vector = {1, 1, 1};
  const auto& wheel = braked.wheels[0];
  const double M = (braked.inertia * braked.angular_velocity + wheel.axial_inertia * wheel.rate * wheel.axis).norm();
  const auto stopped = run(braked, {M / 2, 2 * M}, 1e-8);
  CHECK(stopped.answer.used == Integrator::radau);
  CHECK(stopped.answer.status == Status::event);
  CHECK(stopped.answer.stop == Approx(M).epsilon(2e-6));
  CHECK(stopped.states[0].angular_momentum.norm() == Approx(M / 2));
  // of the carrier alone: the wheel keeps its share, and brings it back through the motor
  braked.torques[0].opposed = Opposed::carrier_momentum;
  const auto carrier = run(braked, {0.5, 1}, 1e-8);
  CHECK(carrier.answer.used == Integrator::radau);
  CHECK(carrier.answer.status == Status::reached);
  auto soft = braked;
  soft.wheels[0].slope = 100;
  std::vector<State<double>> states(2);
  FullMotionOptions<double> options;
  options.tolerance = 1e-9, options.integrator = Integrator::radau;
  const std::vector<double> times{0.5, 1};
  const auto answer = full_motion<double>(soft, times, states, options);
  REQUIRE(answer);
  check_within(apart(soft, times, truth(soft, times), states), answer->error);
}

TEST_CASE("a brake on a body that wheels push off from rest keeps up with its turn", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(1.44, 2.93, 2.02).asDiagonal();
  p.angular_velocity = {1.3e-10, 4.3e-11, 5.5e-11};
  // a motor reverses what is left of the turn within 1e-10 s
  p.wheels.push_back({WheelType::motor, Vec3<double>(0, -0.6, 0.8), 9e-4, -38, 0, 0, 0, 0.04, 15, {}});
  p.wheels.push_back({WheelType::friction, Vec3<double>(0.6, 0.64, 0.48), 0.5, 0, 0, 0, 320, 0, 0, {}});
  auto& brake = p.torques.emplace_back();
  brake.type = TorqueType::brake, brake.opposed = Opposed::carrier_momentum, brake.vector = {7e-6, 2.5e-5, 1.4e-5};
  std::vector<State<double>> states(2);
  FullMotionOptions<double> options;
  options.tolerance = 1e-12, options.integrator = Integrator::radau;
  const std::vector<double> times{3, 8};
  const auto answer = full_motion<double>(p, times, states, options);
  REQUIRE(answer);
  REQUIRE(answer->status == Status::reached);
  const auto off = apart(p, times, truth(p, times), states);
  check_within(off, answer->error);
  CHECK(off[full_column::attitude] < 1e-14);
}

TEST_CASE("a brake that stops the body within a rounding of the time holds it", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2.4, 2).asDiagonal();
  p.angular_velocity = {-2.8e-5, 2.4e-5, -1e-6};
  auto& brake = p.torques.emplace_back();
  brake.type = TorqueType::brake;
  brake.opposed = Opposed::momentum;
  brake.vector = {1.6e12, 5.4e11, 3.5e11};
  brake.factor.on = {{2e-7, 4e-7}};
  const std::vector<double> times{1e-7, 5e-7};
  std::vector<State<double>> states(2);
  FullMotionOptions<double> options;
  options.step_cap = 10'000;
  const auto answer = full_motion<double>(p, times, states, options);
  REQUIRE(answer);
  CHECK(answer->status == ode::Status::reached);
  CHECK(answer->stop == Approx(2e-7));
  CHECK(states[1].angular_velocity.isZero(0));
}

}  // namespace general_full_course_test
