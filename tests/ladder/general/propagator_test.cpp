// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/propagator.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "../../models/general/truth.hpp"
#include "allocations.hpp"
#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"

namespace general_propagator_test {

using namespace gyrostat;
using namespace gyrostat::general;

using Random = std::mt19937_64;

double number(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
Vec3<double> vector(Random& random, double size) {
  return {number(random, -size, size), number(random, -size, size), number(random, -size, size)};
}
Quat<double> attitude(Random& random) {
  return as_unit(
      Quat<double>{number(random, -1, 1), number(random, -1, 1), number(random, -1, 1), number(random, -1, 1)});
}

/// A body with a full tensor.
Problem<double> body(Random& random) {
  Problem<double> made;
  const double a = number(random, 1, 3), b = number(random, 1, 3), c = number(random, 1, 3);
  const Mat3<double> R = to_matrix(attitude(random));
  made.inertia = R * Vec3<double>(a + b, b + c, c + a).asDiagonal() * R.transpose();
  made.inertia = ((made.inertia + made.inertia.transpose()) / 2).eval();
  return made;
}

void add_wheel(Problem<double>& problem, Random& random, WheelType type, double size) {
  Wheel<double> wheel;
  wheel.type = type;
  wheel.axis = vector(random, 1).normalized();
  wheel.axial_inertia = size;
  if (type == WheelType::torque) wheel.torque = 0.01;
  if (type == WheelType::motor) wheel.slope = 0.02, wheel.no_load_rate = 80;
  if (type == WheelType::friction) wheel.friction = 0.003;
  problem.wheels.push_back(wheel);
}

struct Truth {
  Moving state;
  MovedError apart;  ///< of another state from it
};

/// Where the problem moves from a state, in long double, and how far `other` is from it.
Truth truth_of(Problem<double> problem, const Moving& from, double dt, const Moving& other) {
  problem.attitude = as_unit(from.attitude);
  problem.angular_velocity = from.angular_velocity;
  for (std::size_t i = 0; i < problem.wheels.size(); ++i) problem.wheels[i].rate = from.rotor_rate[i];
  const auto wide = general_truth::cast<long double>(problem);
  const auto there = general_truth::motion<long double>(wide, std::vector<long double>{dt}, 1e-18L, 20'000).front();
  Truth made;
  const auto turned = vector_from_quaternion<long double>(
      conjugate(there.attitude) *
      Quat<long double>{other.attitude.w, other.attitude.x, other.attitude.y, other.attitude.z});
  made.apart.attitude = double(turned.norm());
  made.apart.angular_velocity = double((there.angular_velocity - other.angular_velocity.cast<long double>()).norm());
  long double square = 0;
  for (std::size_t i = 0; i < problem.wheels.size(); ++i)
    square += (there.rotor_rate[i] - other.rotor_rate[i]) * (there.rotor_rate[i] - other.rotor_rate[i]);
  made.apart.rotor_rate = double(std::sqrt(square));
  return made;
}

Moving start(Random& random, std::size_t wheels) {
  Moving made{attitude(random), vector(random, 1), {}};
  for (std::size_t i = 0; i < wheels; ++i) made.rotor_rate[i] = number(random, -100, 100);
  return made;
}

/// The state that a step ends with is within its stated error of the truth, and that error is within `most` times the rates.
void check_step(const Problem<double>& problem, const Moving& from, double dt, double most, bool closed) {
  const auto made = Propagator::make(problem, 1e-11);
  REQUIRE(made);
  CHECK(made->is_closed_form() == closed);
  Moving state = from;
  MovedError error;
  REQUIRE(made->advance(dt, state, &error) == Errc::ok);
  const auto apart = truth_of(problem, from, dt, state).apart;
  INFO("dt " << dt << ", attitude " << apart.attitude << " of " << error.attitude << ", rates "
             << apart.angular_velocity << " of " << error.angular_velocity << ", wheels " << apart.rotor_rate << " of "
             << error.rotor_rate);
  CHECK(apart.attitude <= error.attitude);
  CHECK(apart.angular_velocity <= error.angular_velocity);
  CHECK(apart.rotor_rate <= error.rotor_rate);
  CHECK(error.attitude <= most);
  CHECK(error.angular_velocity <= most * 100);
  Moving again = from;
  REQUIRE(made->advance(dt, again) == Errc::ok);
  CHECK(again.angular_velocity == state.angular_velocity);
}

TEST_CASE("a free step is within its stated error, whatever wheels are free, held or locked", "[general]") {
  Random random(31);
  for (int trip = 0; trip < 40; ++trip) {
    auto problem = body(random);
    problem.rotor_momentum = trip % 3 == 0 ? vector(random, 1) : Vec3<double>(0, 0, 0);
    if (trip % 2 == 0) add_wheel(problem, random, WheelType::free, 0.05);
    if (trip % 4 < 2) add_wheel(problem, random, WheelType::held, 0.02);
    auto from = start(random, problem.wheels.size());
    if (trip % 5 == 0) add_wheel(problem, random, WheelType::locked, 0.02);
    for (const double dt : {1e-3, 0.1, 5.0}) check_step(problem, from, dt, 1e-11, true);
  }
}

TEST_CASE("the stated error holds the rounding of wheels whose momenta cancel", "[general]") {
  Random random(7);
  for (int trip = 0; trip < 10; ++trip) {
    auto problem = body(random);
    add_wheel(problem, random, WheelType::held, 0.1);
    problem.wheels.push_back(problem.wheels.back());
    auto from = start(random, 0);
    from.rotor_rate[0] = number(random, 1e5, 1e6), from.rotor_rate[1] = -from.rotor_rate[0] * (1 + 1e-9);
    check_step(problem, from, 2, 1e-4, true);
    const auto made = Propagator::make(problem, 1e-9);
    Moving one = from, two = from;
    two.rotor_rate[0] = std::nextafter(from.rotor_rate[0], infinity<double>);  // a rounding of the data
    MovedError error;
    REQUIRE(made->advance(2, one, &error) == Errc::ok);
    REQUIRE(made->advance(2, two) == Errc::ok);
    CHECK((one.angular_velocity - two.angular_velocity).norm() <= error.angular_velocity);
    CHECK(error.angular_velocity > 1e-13);
  }
}

TEST_CASE("a step under torques or with driven wheels is within its stated error", "[general]") {
  Random random(5);
  for (int trip = 0; trip < 12; ++trip) {
    auto problem = body(random);
    if (trip % 3 != 0) {
      add_wheel(problem, random,
                std::array{WheelType::torque, WheelType::motor, WheelType::friction}[std::size_t(trip % 3)], 0.05);
      add_wheel(problem, random, WheelType::free, 0.03);
    }
    if (trip % 2 == 0 || problem.wheels.empty()) {
      Torque<double> damping;
      damping.type = TorqueType::damping;
      damping.matrix = 0.1 * Mat3<double>::Identity();
      Torque<double> push;
      push.vector = vector(random, 0.1);
      push.axes = trip % 4 == 0 ? Axes::inertial : Axes::body;
      problem.torques = {damping, push};
    }
    const auto from = start(random, problem.wheels.size());
    for (const double dt : {1e-3, 0.1, 5.0}) check_step(problem, from, dt, 1e-9, false);
  }
}

TEST_CASE("a force through the mass centre turns nothing, and the closed form stays", "[general]") {
  Random random(3);
  auto problem = body(random);
  Torque<double> thrust;
  thrust.type = TorqueType::thrust, thrust.vector = {5, 0, 0};
  problem.torques = {thrust};
  check_step(problem, start(random, 0), 1, 1e-12, true);
}

TEST_CASE("a closed step takes nothing from the heap, with its error and with wheels", "[general]") {
  Random random(11);
  auto problem = body(random);
  add_wheel(problem, random, WheelType::free, 0.05);
  add_wheel(problem, random, WheelType::held, 0.05);
  const auto made = Propagator::make(problem, 1e-9);
  REQUIRE(made);
  Moving state = start(random, 2);
  MovedError error;
  const std::size_t before = allocations();
  const Errc first = made->advance(0.1, state, &error), second = made->advance(0.1, state);
  const std::size_t taken = allocations() - before;
  CHECK(first == Errc::ok);
  CHECK(second == Errc::ok);
  CHECK(taken == 0);
}

TEST_CASE("a step of no length changes nothing but the length of the quaternion", "[general]") {
  Random random(2);
  const auto made = Propagator::make(body(random), 1e-9);
  Moving state = start(random, 0);
  const Moving before = state;
  state.attitude.w *= 1 + 5e-7, state.attitude.x *= 1 + 5e-7, state.attitude.y *= 1 + 5e-7,
      state.attitude.z *= 1 + 5e-7;
  MovedError error;
  REQUIRE(made->advance(0, state, &error) == Errc::ok);
  const auto turned = vector_from_quaternion<double>(conjugate(before.attitude) * state.attitude);
  CHECK(turned.norm() <= error.attitude);
  CHECK(state.angular_velocity == before.angular_velocity);
}

TEST_CASE("a body at rest stays at rest", "[general]") {
  Random random(4);
  const auto made = Propagator::make(body(random), 1e-9);
  Moving state;
  MovedError error;
  REQUIRE(made->advance(10, state, &error) == Errc::ok);
  CHECK(state.angular_velocity.norm() <= error.angular_velocity);
  CHECK(state.attitude.w == 1);
  CHECK(std::isfinite(error.attitude));
}

TEST_CASE("what cannot be moved on is refused, and the state stays", "[general]") {
  Random random(6);
  auto problem = body(random);
  add_wheel(problem, random, WheelType::locked, 0.1);
  const auto made = Propagator::make(problem, 1e-9);
  REQUIRE(made);
  const Moving fine = start(random, 0);
  const auto refused = [&](double dt, const Moving& given, Errc why) {
    Moving state = given;
    CHECK(made->advance(dt, state) == why);
    CHECK(state.angular_velocity[0] == given.angular_velocity[0]);
  };
  refused(-1, fine, Errc::negative);
  refused(gyrostat::nan<double>, fine, Errc::not_finite);
  refused(infinity<double>, fine, Errc::not_finite);
  Moving bad = fine;
  bad.attitude.w += 0.1;
  refused(1, bad, Errc::out_of_domain);
  bad = fine, bad.angular_velocity[1] = gyrostat::nan<double>;
  refused(1, bad, Errc::not_finite);
  bad = fine, bad.rotor_rate[0] = 1;
  refused(1, bad, Errc::out_of_domain);
  bad = fine, bad.rotor_rate[0] = gyrostat::nan<double>;
  refused(1, bad, Errc::not_finite);

  Torque<double> brake;
  brake.type = TorqueType::brake, brake.opposed = Opposed::momentum, brake.vector = {10, 10, 10};
  problem.torques = {brake};
  Moving state = fine;
  problem.wheels.push_back({WheelType::friction, Vec3<double>(0, 0, 1), 1e-3, 0, 0, 0, 1e-3, 0, 0, {}});
  CHECK(Propagator::make(problem, 1e-9)->advance(1000, state) == Errc::not_applicable);
  CHECK(state.angular_velocity == fine.angular_velocity);
}

TEST_CASE("a step in which the phase is lost is refused, and one that is too long ends", "[general]") {
  Random random(9);
  auto problem = body(random);
  add_wheel(problem, random, WheelType::held, 0.1);
  auto made = Propagator::make(problem, 1e-9);
  Moving state = start(random, 1);
  MovedError error;
  for (MovedError* told : {&error, static_cast<MovedError*>(nullptr)}) {
    const Moving before = state;
    CHECK(made->advance(1e18, state, told) == Errc::undetermined);
    CHECK(state.angular_velocity == before.angular_velocity);
  }
  Torque<double> push;
  push.vector = {1e-6, 0, 0};
  problem.torques = {push};
  made = Propagator::make(problem, 1e-9);
  state = start(random, 1);
  CHECK(made->advance(1e7, state, &error) == Errc::step_limit);
}

TEST_CASE("a step whose end nobody knows is refused, whether or not its error is asked for", "[general]") {
  Random random(10);
  Problem<double> problem;
  problem.inertia = Vec3<double>(3, 4, 5).asDiagonal();
  add_wheel(problem, random, WheelType::free, 0.1);
  const auto made = Propagator::make(problem, 1e-9);
  REQUIRE(made);
  MovedError error;
  for (MovedError* told : {&error, static_cast<MovedError*>(nullptr)}) {
    Moving state;
    state.angular_velocity = {0.1, 0.2, -0.3};
    for (const double rate :
         {1e18, 1e20, 1e50, 1e150, 1e200}) {  // its momentum turns the body through 1e15 rad and more
      CAPTURE(rate);
      state.rotor_rate[0] = rate;
      CHECK(made->advance(0.1, state, told) == (rate < 1e155 ? Errc::undetermined : Errc::not_finite));
      CHECK(state.angular_velocity == Vec3<double>(0.1, 0.2, -0.3));
    }
    state.rotor_rate[0] = 1e6;
    CHECK(made->advance(0.1, state, told) == Errc::ok);
  }
  CHECK(error.attitude < 1e-6);
}

TEST_CASE("a problem that knows the time is refused, with the reason", "[general]") {
  Random random(8);
  const auto plain = body(random);
  CHECK(Propagator::clock_needed(plain) == nullptr);
  CHECK(Propagator::make(plain, 0).error() == Errc::out_of_domain);
  CHECK(Propagator::make(plain, 1).error() == Errc::out_of_domain);
  const auto refused = [](const Problem<double>& problem) {
    CHECK(Propagator::clock_needed(problem) != nullptr);
    CHECK(Propagator::make(problem, 1e-9).error() == Errc::not_applicable);
  };
  Torque<double> push;
  push.vector = {0.1, 0, 0};
  auto problem = plain;
  problem.torques = {push}, problem.torques[0].factor.on = {{1, 2}};
  refused(problem);
  problem.torques = {push}, problem.torques[0].factor.amplitude = 1, problem.torques[0].factor.rate = 2;
  refused(problem);
  problem.orbit.emplace();
  problem.torques = {push}, problem.torques[0].axes = Axes::orbit;
  refused(problem);
  problem.torques = {push}, problem.torques[0].type = TorqueType::gravity_gradient;
  refused(problem);
  problem.field.magnetic = MagneticField::rotating, problem.field.flux_density = {1e-5, 0, 0},
  problem.field.rate = 1e-3;
  problem.torques = {push}, problem.torques[0].type = TorqueType::magnetic;
  refused(problem);
  problem.torques[0].type = TorqueType::eddy_current, problem.torques[0].matrix = Mat3<double>::Identity();
  refused(problem);
  problem.field.magnetic = MagneticField::uniform;
  CHECK(Propagator::clock_needed(problem) == nullptr);
  problem = plain;
  add_wheel(problem, random, WheelType::held, 0.1);
  problem.wheels[0].table = {{0, 1}, {0, 10}};
  refused(problem);
  problem = plain;
  problem.inertia(0, 0) = -1;
  CHECK(!Propagator::make(problem, 1e-9));
  for (const double size : {1e-310, 1e-200, 1e160}) {
    problem = plain;
    problem.inertia *= size;
    CHECK(Propagator::make(problem, 1e-9).error() == Errc::beyond_range);
  }
}

}  // namespace general_propagator_test
