// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/full_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <vector>

#include "../../models/general/cases.hpp"
#include "../../models/general/scenes.hpp"
#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "runs.hpp"

namespace general_full_motion_test {

using namespace general_runs;
using ode::Status;

/// A body turned about its middle axis, which is told in turned axes to a rounding: after some 60 s it has left it.
Problem<double> about_middle_axis() {
  const Mat3<double> R = to_matrix(as_unit(Quat<double>{0.3, -0.5, 0.7, 0.4}));
  Problem<double> p;
  const Mat3<double> J = R * Vec3<double>(1, 2, 3).asDiagonal() * R.transpose();
  p.inertia = (J + J.transpose()) / 2;
  p.angular_velocity = R * Vec3<double>(0, 1, 0);
  return p;
}

TEST_CASE("no steps are so short that they hold a body on an unstable axis", "[general]") {
  for (const std::size_t pieces : {1u, 300u, 3000u, 10000u}) {
    auto p = about_middle_axis();
    p.torques.resize(1);
    p.torques[0].type = TorqueType::table;
    auto& table = p.torques[0].table;
    for (std::size_t i = 0; i <= pieces; ++i) {
      table.times.push_back(130 * double(i) / double(pieces));
      table.values.insert(table.values.end(), {0, 1e-60, 0});
    }
    CAPTURE(pieces);
    const auto made = run(p, {120}, 1e-4);
    CHECK(!made.answer.met);
    CHECK(made.answer.error[full_column::angular_velocity] > 0.1);
  }
}

TEST_CASE("the reference motions of general scenes", "[general]") {
  for (const auto& one : general_cases::cases<double>()) {
    const auto made = run(one.problem, one.times, 1e-11);
    CAPTURE(one.id);
    REQUIRE(made.answer.status == Status::reached);
    CHECK(made.answer.met);
    const auto error = apart(one.problem, one.times, one.truth, made.states);
    for (std::size_t i = 0; i < (one.has_path ? 7U : 5U); ++i) {
      CAPTURE(full_columns[i].name, error[i], made.answer.error[i]);
      CHECK(error[i] <= std::max(1e-12, 64 * one.one_ulp[i]));
      CHECK(error[i] <= made.answer.error[i]);
    }
    const auto sums = balance<double>(one.problem, one.times.back(), 1e-14, false);
    CHECK(sums.energy < 1e-12);
    CHECK(sums.momentum < 1e-13);
  }
}

TEST_CASE("stated errors of the full general equations bound the true ones", "[general]") {
  constexpr double tolerances[] = {1e-3, 1e-6, 1e-9, 1e-12};
  general_scenes::Scenes source(81);
  std::vector<double> ratios;
  int met = 0, all = 0;
  for (int i = 0; i < (slow_build ? 10 : 60); ++i) {
    const auto made = source.next(3);
    std::vector<double> times{0};
    for (int k = 1; k < 8 && i % 3 != 0; ++k) times.push_back(made.span * k / 8);
    times.push_back(made.span);
    const auto right = truth(made.problem, times);
    if (right.empty()) continue;
    const auto of = run(made.problem, times, tolerances[i % 4]);
    if (of.answer.status == Status::event) continue;
    CAPTURE(i, made.span, of.answer.outgrown, of.answer.counts.steps);
    REQUIRE(of.answer.status == Status::reached);
    const auto error = apart(made.problem, times, right, of.states);
    ++all, met += of.answer.met;
    double least = infinity<double>;
    for (std::size_t k = 0; k < std::size(full_columns); ++k) {
      CAPTURE(i, made.kind, full_columns[k].name, error[k], of.answer.error[k]);
      CHECK(error[k] <= of.answer.error[k]);
      if (error[k] > 0) least = std::min(least, of.answer.error[k] / error[k]);
    }
    if (i % 4 != 3) ratios.push_back(least);
  }
  std::sort(ratios.begin(), ratios.end());
  CHECK(ratios[ratios.size() / 2] < 20);
  CHECK(met > all * 8 / 10);
}

TEST_CASE("a run by itself is the motion, for less, and tells no errors", "[general]") {
  general_scenes::Scenes source(83);
  std::uint64_t steps = 0, steps_beside = 0;
  for (int i = 0; i < (slow_build ? 10 : 40); ++i) {
    const auto made = source.next(3);
    const std::vector<double> times{0, made.span / 3, made.span};
    const auto beside = run(made.problem, times, 1e-6), alone = run(made.problem, times, 1e-6, true);
    CAPTURE(i, made.kind);
    CHECK(alone.answer.status == beside.answer.status);
    if (alone.answer.status != Status::reached) continue;
    CHECK(alone.answer.met);
    CHECK(alone.answer.error.greatest() == 0);
    check_within(apart(made.problem, times, beside.states, alone.states), beside.answer.error);
    REQUIRE(alone.answer.rests.size() == beside.answer.rests.size());
    if (!alone.answer.rests.empty()) CHECK(std::abs(alone.answer.stop - beside.answer.stop) <= beside.answer.stop_off);
    steps += alone.answer.counts.steps, steps_beside += beside.answer.counts.steps;
  }
  CHECK(2 * steps < steps_beside);
}

TEST_CASE("the balances of energy and momentum hold over every kind of piece", "[general]") {
  general_scenes::Scenes source(82);
  for (int i = 0; i < (slow_build ? 10 : 60); ++i) {
    const auto made = source.next(2);
    const auto sums = balance<double>(made.problem, made.span, 1e-15, false);
    CAPTURE(i, made.kind, sums.energy, sums.momentum);
    if (std::isnan(sums.energy)) continue;  // a stop
    CHECK(sums.energy < 1e-12);
    CHECK(sums.momentum < 1e-13);
  }
}

TEST_CASE("stated errors hold where errors of the steps add up in the rhythm of a wave", "[general]") {
  Problem<double> problem;
  problem.inertia = Vec3<double>(3.8623853002576709, 2.9852334256520101, 2.9883542126617701).asDiagonal();
  problem.angular_velocity = {-0.012378858846069466, -0.075057929512032315, 0.070684410677873538};
  auto& drag = problem.torques.emplace_back();
  drag.type = TorqueType::damping;
  drag.matrix = Vec3<double>(0.0026718218687744682, 0.0079709779971234001, 0.00834381871610149).asDiagonal();
  drag.factor.mean = 0.30782586915981414, drag.factor.amplitude = 0.17683024456620378;
  drag.factor.rate = 53.307121155064657, drag.factor.phase = 3.5337755929954224;
  const std::vector<double> times = {562.77659250690431};
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    CAPTURE(tolerance);
    const auto made = run(problem, times, tolerance);
    check_within(apart(problem, times, made.states, run(problem, times, 1e-13).states), made.answer.error);
  }
}

TEST_CASE("stated errors hold over many pulses, with a torque in space between them", "[general]") {
  // a ball about one axis: w0 t + c t^2/2, and of the pulse at [i, i + 1/2] c' (T - i)/2 - c'/8
  constexpr int pulses = 1000;
  Problem<double> p;
  p.inertia = Mat3<double>::Identity();
  p.angular_velocity = {0, 0, 0.01};
  auto& steady = p.torques.emplace_back();
  steady.axes = Axes::inertial, steady.vector = {0, 0, 1e-3};
  auto& pulsed = p.torques.emplace_back();
  pulsed.vector = {0, 0, 1e-12};
  for (int i = 0; i < pulses; ++i) pulsed.factor.on.push_back({double(i), i + 0.5});
  const std::vector<double> times{pulses};
  const auto made = run(p, times, 1e-9);
  const long double T = pulses, step = 1e-12, c = 1e-3, w0 = 0.01;
  const long double wanted = w0 + c * T + step * T / 2;
  const double rate = double(std::abs(made.states[0].angular_velocity[2] - wanted) / wanted);
  const long double angle = w0 * T + c * T * T / 2 + step * (T * (T + 1) / 4 - T / 8);
  const Quat<long double> turned{std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
  const auto& q = made.states[0].attitude;
  const auto off = conjugate(turned) * Quat<long double>{q.w, q.x, q.y, q.z};
  CHECK(rate <= made.answer.error[full_column::angular_velocity]);
  CHECK(2 * double(std::abs(off.z)) <= made.answer.error[full_column::attitude]);
  CHECK(rate < 4e-16);
}

TEST_CASE("stated errors hold where a body that carries a wheel all but rests in an unstable balance", "[general]") {
  // The equations keep the momentum, and most of a slow rate is lost in its rounding beside the wheel's: when the body falls hangs on that.
  std::mt19937_64 random(1);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int wrong = 0, answers = 0;
  for (int i = 0; i < 400; ++i) {
    Problem<double> p;
    p.inertia = Vec3<double>(1.3, 1.7, 2.1).asDiagonal();
    p.mass = 1, p.centre_of_mass = {0, 0, 0.1}, p.fixed = true, p.field.gravity = 9.8, p.field.down = {0, 0, -1};
    p.torques.resize(1);
    p.torques[0].type = TorqueType::weight;
    const double slow = std::pow(10, any(-16, -1));
    p.angular_velocity = slow * Vec3<double>(any(-1, 1), any(-1, 1), 0);
    p.wheels.resize(1);
    p.wheels[0].type = i % 2 == 0 ? WheelType::held : WheelType::free;
    p.wheels[0].axis = i % 3 == 0 ? Vec3<double>(0, 0.6, 0.8) : Vec3<double>(0, 1, 0);
    p.wheels[0].axial_inertia = std::pow(10, any(-4, -1)), p.wheels[0].rate = std::pow(10, any(0, 2));
    const std::vector<double> times{any(3, 25)};
    const auto made = run(p, times, std::pow(10, -2 * any(1, 4.5)));
    const auto error = apart(p, times, made.states, truth(p, times));
    wrong += error[full_column::attitude] > made.answer.error[full_column::attitude];
    ++answers;
  }
  CHECK(answers == 400);
  CHECK(wrong == 0);
}

TEST_CASE("stated errors hold where a body begins at rest in an unstable balance, in turned axes", "[general]") {
  // Whether it falls, and when, hangs on what the turned direction of the weight rounds to: computed from the numbers of some attitudes the torque is
  // zero, and exactly it is not.
  std::mt19937_64 random(2);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int wrong = 0, answers = 0, resting = 0;
  for (int i = 0; i < 600; ++i) {
    CAPTURE(i);
    Problem<double> p;
    p.inertia = Vec3<double>(1, 2, 2.5).asDiagonal();
    p.attitude = as_unit(Quat<double>{any(-1, 1), any(-1, 1), i % 4 == 0 ? 0 : any(-1, 1), any(-1, 1)});
    p.torques.resize(1);
    if (i % 2 == 0) {
      p.torques[0].type = TorqueType::weight;
      p.mass = 1, p.centre_of_mass = {0, 0, 0.25}, p.fixed = true, p.field.gravity = 5;
      p.field.down = rotate<double>(p.attitude, {0, 0, -1});
    } else {
      p.torques[0].type = TorqueType::magnetic, p.torques[0].vector = {0, 0, 1.25};
      p.field.magnetic = MagneticField::uniform, p.field.flux_density = rotate<double>(p.attitude, {0, 0, -1});
    }
    if (i % 3 == 0) p.angular_velocity = {0, 0, std::pow(10, any(-12, 0))};
    const std::vector<double> times{any(10, 30)};
    const auto made = run(p, times, 1e-3);
    const std::vector<long double> wide(times.begin(), times.end());
    std::vector<State<long double>> right(1);
    FullMotionOptions<long double> alone;
    alone.tolerance = 1e-17L, alone.alone = true;
    auto exact = general_truth::cast<long double>(p);
    exact.field.down.normalize();
    exact.attitude = as_unit(exact.attitude);
    const auto done = full_motion<long double>(exact, wide, right, alone);
    CAPTURE(message(done.error()));
    REQUIRE(done);
    ++answers;
    resting += made.states[0].angular_velocity.isZero(0);
    wrong += apart(p, times, made.states, {general_truth::cast<double>(right[0])})[full_column::attitude] >
             made.answer.error[full_column::attitude];
  }
  CHECK(answers > 200);
  CHECK(resting > 5);
  CHECK(wrong == 0);
}

TEST_CASE("motions have parted where their attitudes are half a radian apart, of either sign", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(1, 2, 2.5).asDiagonal();
  const FullRow<double> row(Prepared<double>(p, 1.));
  const Comparison rows(row);
  const auto turned = [&](double angle, double sign) {
    State<double> state;
    state.attitude = {sign * std::cos(angle / 2), 0, sign * std::sin(angle / 2), 0};
    return rows.row(state);
  };
  for (const double sign : {1., -1.}) {
    CHECK_FALSE(row.has_parted(turned(0.2, 1), turned(0.65, sign)));
    CHECK(row.has_parted(turned(0.2, 1), turned(0.75, sign)));
    CHECK(row.has_parted(turned(0.2, 1), turned(3, sign)));
  }
}

TEST_CASE("a scene that is chaotic says so", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(0.6, 0.5, 0.3).asDiagonal();
  p.fixed = true, p.mass = 10, p.centre_of_mass = {0.1, 0.05, -0.2}, p.field.gravity = 9.8;
  p.attitude = normalised(Quat<double>{1, 2, 0.3, 0});
  p.angular_velocity = {2, 1, 3};
  p.torques.resize(1);
  p.torques[0].type = TorqueType::weight;
  const auto brief = run(p, {1.}, 1e-10), late = run(p, {400.}, 1e-10);
  CHECK(brief.answer.met);
  CHECK(late.answer.status == Status::reached);
  CHECK_FALSE(late.answer.met);
  CHECK(late.answer.error[full_column::attitude] > 1e-6);
}

TEST_CASE("rest, and turning about an axis, stay in general scenes", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  const auto rest = run(p, {0, 10, 1000}, 1e-12);
  CHECK(rest.answer.met);
  CHECK(rest.states[2].angular_velocity.isZero(0));
  CHECK(rest.states[2].attitude == Quat<double>{});
  // about the middle axis, with a wheel and a torque along it
  p.angular_velocity = {0, 2, 0};
  p.wheels.resize(1);
  p.wheels[0].type = WheelType::motor, p.wheels[0].axis = {0, 1, 0}, p.wheels[0].axial_inertia = 0.1;
  p.wheels[0].slope = 0.01, p.wheels[0].no_load_rate = 5;
  p.torques.resize(1);
  p.torques[0].vector = {0, 0.01, 0};
  const auto axis = run(p, {0, 100, 300}, 1e-10);
  CHECK(axis.answer.met);
  CHECK(axis.states[2].angular_velocity[0] == 0);
  CHECK(axis.states[2].angular_momentum[1] == Approx(2 * 2 + 3));
}

TEST_CASE("what the full general equations cannot answer is refused", "[general]") {
  Problem<double> good;
  good.angular_velocity = {1, 2, 3};
  std::vector<State<double>> states(2);
  const auto error = [&](std::vector<double> times, const Problem<double>& problem, double tolerance = 1e-9) {
    FullMotionOptions<double> options;
    options.tolerance = tolerance;
    return full_motion<double>(problem, times, states, options).error();
  };
  constexpr double no = gyrostat::nan<double>;
  CHECK(error({1, 2}, good) == Errc::ok);
  CHECK(error({1}, good) == Errc::out_of_domain);
  CHECK(error({2, 1}, good) == Errc::not_increasing);
  CHECK(error({1, infinity<double>}, good) == Errc::not_finite);
  CHECK(error({1, 2}, good, no) == Errc::not_finite);
  auto bad = good;
  bad.inertia(2, 2) = 9;
  CHECK(error({1, 2}, bad) == Errc::triangle_inequality);
  bad = good;
  bad.torques.resize(1);
  bad.torques[0].type = TorqueType::weight;
  CHECK(error({1, 2}, bad) == Errc::not_applicable);
  bad = good;
  bad.angular_velocity = {1e308, 1e308, 1e308};
  CHECK(error({1, 2}, bad) == Errc::not_finite);
  bad = good;
  bad.torques.resize(1);
  bad.torques[0].factor.amplitude = 1, bad.torques[0].factor.rate = 1e9;
  CHECK(error({1e-8, 2e-8}, bad) == Errc::ok);
  CHECK(error({0.01, 2}, bad) == Errc::out_of_domain);
  CHECK(full_motion<double>(good, {}, {})->met);

  FullMotionOptions<double> options;
  options.step_cap = 5;
  const std::vector<double> times{0.01, 1e6};
  const auto capped = full_motion<double>(good, times, states, options);
  REQUIRE(capped);
  CHECK(capped->status == Status::step_limit);
  CHECK(std::isfinite(states[0].work));
  CHECK(std::isnan(states[1].work));
}

TEST_CASE("a motion that grows without end is given up before the budget of steps", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {0.1, 0.2, 0.3};
  auto& drive = p.torques.emplace_back();
  drive.type = TorqueType::damping, drive.matrix = -0.1 * Mat3<double>::Identity();
  std::vector<State<double>> states(2);
  FullMotionOptions<double> options;
  options.tolerance = 1e-10;
  const std::vector<double> times{50, 1e6};
  const auto answer = full_motion<double>(p, times, states, options);
  REQUIRE(answer);
  CHECK(answer->status == Status::step_limit);
  CHECK(answer->outgrown);
  CHECK(answer->counts.steps < step_budget / 10);
  CHECK(states[0].angular_velocity.norm() > 1);
  CHECK(std::isnan(states[1].angular_velocity[0]));
  // what is foreseen is followed, though it grows
  const std::vector<double> brief{50, 150};
  const auto early = full_motion<double>(p, brief, states, options);
  CHECK((early->status == Status::reached && !early->outgrown));
}

TEST_CASE("a body that a torque spins up beyond all budgets is given up early", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(1, 1, 1e-3).asDiagonal();
  auto& drive = p.torques.emplace_back();
  drive.type = TorqueType::constant, drive.vector = {0, 0, 1};
  std::vector<State<double>> states(1);
  FullMotionOptions<double> options;
  options.tolerance = 1e-4;
  const std::vector<double> times{5000};  // 1e10 rad
  const auto answer = full_motion<double>(p, times, states, options);
  REQUIRE(answer);
  CHECK(answer->status == Status::step_limit);
  CHECK(answer->outgrown);
  CHECK(answer->counts.steps < step_budget / 10);
  // and one that slackens is followed: as many turns at the start, by far fewer later
  p.torques.clear();
  p.angular_velocity = {0, 0, 5e5};
  auto& damping = p.torques.emplace_back();
  damping.type = TorqueType::damping, damping.matrix = Vec3<double>(1, 1, 1e-3).asDiagonal();
  const auto damped = full_motion<double>(p, times, states, options);
  REQUIRE(damped);
  CHECK(damped->status == Status::reached);
  CHECK(states[0].angular_velocity.norm() < 1);
}

TEST_CASE("the full general equations can be watched and stopped", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {1, 0.5, -0.7};
  std::vector<State<double>> states(2);
  Monitor monitor;
  FullMotionOptions<double> options;
  options.monitor = &monitor;
  const std::vector<double> times{0, 400};
  CHECK(full_motion<double>(p, times, states, options)->met);
  CHECK(monitor.fraction == 1);
  monitor.cancel = true;
  CHECK(full_motion<double>(p, times, states, options)->status == Status::cancelled);
}

TEST_CASE("the full general equations meet the tolerance of long double", "[general]") {
  using S = long double;
  Problem<S> p;
  p.inertia = Vec3<S>(3, 2, 1.5L).asDiagonal();
  p.angular_velocity = {1, 0.5L, -0.7L};
  std::vector<State<S>> states(1);
  FullMotionOptions<S> options;
  options.tolerance = 4000 * epsilon<S>;
  const std::vector<S> times{5};
  CHECK(full_motion<S>(p, times, states, options)->met);
}

TEST_CASE("a stiff wheel moves as the family rotor says, however stiff", "[general]") {
  std::vector<double> times;
  for (int i = 0; i <= 12; ++i) times.push_back(i * 0.5);
  std::uint64_t fewest = 100'000'000, most = 0;
  for (const double slope : {350., 3500., 1e5, 1e8}) {
    const auto p = wheel_on_a_carrier(slope);
    const auto& wheel = p.wheels[0];
    const auto body =
        rotor::Gyrostat<double>::make(p.inertia, wheel.axis, wheel.axial_inertia, slope, wheel.no_load_rate);
    REQUIRE(body);
    rotor::State<double> start;
    start.momentum = p.inertia * p.angular_velocity + wheel.axial_inertia * wheel.rate * wheel.axis;
    start.axial_momentum = wheel.axial_inertia * (wheel.rate + wheel.axis.dot(p.angular_velocity));
    std::vector<rotor::State<double>> right(times.size());
    rotor::FullMotionOptions<double> tight;
    tight.tolerance = 1e-13;
    REQUIRE(rotor::full_motion<double>(*body, start, times, right, tight));
    for (const double tolerance : {1e-4, 1e-8, 1e-11}) {
      const auto made = run(p, times, tolerance);
      CAPTURE(slope, tolerance);
      REQUIRE(made.answer.status == Status::reached);
      CHECK(made.answer.used == Integrator::radau);
      CHECK(made.answer.met);
      auto states = made.states;
      for (std::size_t i = 0; i < times.size(); ++i) {
        const auto w = body->angular_velocity(right[i].momentum, right[i].axial_momentum);
        states[i].attitude = right[i].attitude, states[i].angular_momentum = right[i].momentum;
        states[i].angular_velocity = w;
        states[i].rotor_rate[0] = body->rotor_rate(right[i].axial_momentum, w);
        states[i].rotor_angle[0] = right[i].rotor_angle;
      }
      auto stated = made.answer.error;
      for (std::size_t k = 0; k < 5; ++k) stated[k] += 1e-12;  // the other's own error
      check_within(apart(p, times, states, made.states), stated);
      if (tolerance == 1e-8)
        fewest = std::min(fewest, made.answer.counts.rhs), most = std::max(most, made.answer.counts.rhs);
    }
  }
  CHECK(most < 2 * fewest);
}

TEST_CASE("wheels of every speed under waves, orbits, tables and breakpoints: stated errors bound the true ones",
          "[general]") {
  const std::vector<double> times{0, 0.3, 0.7, 1, 1.5, 2, 3.2, 4};
  for (const double slope : {0.1, 5., 500.}) {
    const auto p = three_wheels(slope);
    const auto right = truth(p, times);
    REQUIRE(right.size() == times.size());
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      std::vector<State<double>> states(times.size());
      FullMotionOptions<double> options;
      options.tolerance = tolerance, options.integrator = Integrator::radau;
      const auto answer = full_motion<double>(p, times, states, options);
      REQUIRE(answer);
      REQUIRE(answer->status == Status::reached);
      CAPTURE(slope, tolerance);
      CHECK((answer->met || tolerance < 1e-11));
      check_within(apart(p, times, right, states), answer->error);
    }
  }
  // too fast for any explicit method: by the limit, in which wheels hold the rates that their motors bring them to
  for (const double slope : {1e6, 1e8}) {
    auto p = three_wheels(slope);
    p.wheels[0].slope = 10 * slope;
    p.wheels[2].table = {};
    auto held = p;
    for (auto& wheel : held.wheels) {
      wheel.rate = wheel.type == WheelType::motor ? wheel.no_load_rate : wheel.torque / wheel.friction;
      wheel.type = WheelType::held, wheel.torque = wheel.friction = wheel.slope = 0;
    }
    // the same momentum, which the wheels shared out at once
    const auto wheels = Wheels<double>::of(p);
    const Vec3<double> M = wheels.reduced * p.angular_velocity + wheels.momentum_of_wheels();
    held.angular_velocity = held.inertia.inverse() * (M - Wheels<double>::of(held).momentum_of_wheels());
    const std::vector<double> later{0.3, 1, 2, 4};
    const auto made = run(p, later, 1e-10), limit = run(held, later, 1e-12);
    REQUIRE(made.answer.status == Status::reached);
    CHECK(made.answer.met);
    for (std::size_t i = 0; i < later.size(); ++i) {
      CAPTURE(slope, later[i]);
      CHECK((made.states[i].angular_velocity - limit.states[i].angular_velocity).norm() < 300 / slope);
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(std::abs(made.states[i].rotor_rate[k] - held.wheels[k].rate) < 300 / slope);
    }
  }
}

TEST_CASE("stated errors bound the true ones where wheels settle thousands of times", "[general][length]") {
  constexpr double tolerances[] = {1e-3, 1e-6, 1e-9, 1e-12};
  general_scenes::Scenes source(83);
  int collocated = 0, met = 0, all = 0;
  for (int i = 0; i < (slow_build ? 4 : at_length(8, 24)); ++i) {
    const auto made = source.stiff(2, source.scale(2e3, 2e4));
    const std::vector<double> times{0, 0.3 * made.span, made.span};
    const auto right = truth(made.problem, times);
    if (right.empty()) continue;
    const auto of = run(made.problem, times, tolerances[i % 4]);
    if (of.answer.status == Status::event) continue;
    REQUIRE(of.answer.status == Status::reached);
    CAPTURE(i, made.kind, tolerances[i % 4]);
    ++all, met += of.answer.met, collocated += of.answer.used == Integrator::radau;
    check_within(apart(made.problem, times, right, of.states), of.answer.error);
  }
  CAPTURE(all, met, collocated);
  CHECK(collocated > all / 2);
  CHECK(met > all * 7 / 10);
}

}  // namespace general_full_motion_test
