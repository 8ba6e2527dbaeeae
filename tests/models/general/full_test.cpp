// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/full.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "scenes.hpp"
#include "truth.hpp"

namespace general_full_test {

using namespace gyrostat;
using namespace gyrostat::general;

template <bool large>
auto walk(const Prepared<double>& of, const Piece<double>& piece, double end, double tolerance) {
  const auto start = first_numbers<double, large>(of);
  const FullSystem<double, large> system(of, piece, start);
  using Solver = ode::Taylor<FullSystem<double, large>>;
  typename Solver::Options options;
  options.scale = system.scale(), options.tolerance = tolerance;
  auto solver = std::make_unique<Solver>(system, 0, start, options);
  REQUIRE(solver->advance(end) == ode::Status::reached);
  return std::pair{system.state(end, solver->state()), solver->counts().steps};
}

TEST_CASE("the small state and the large one are one motion", "[general]") {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.3, -0.5, 0.8};
  p.torques.resize(1);
  p.torques[0].vector = {0.1, 0.2, -0.1};
  const Prepared<double> of(p, 20);
  REQUIRE_FALSE(of.is_large());
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 20);
  const auto [small, steps] = walk<false>(of, piece, 20, 1e-14);
  const auto [large, more] = walk<true>(of, piece, 20, 1e-14);
  CHECK(steps == more);
  CHECK((small.angular_velocity - large.angular_velocity).norm() < 1e-14);
  // a thrust and a motor need the large one
  auto thrust = p;
  thrust.torques[0].type = TorqueType::thrust;
  CHECK(Prepared<double>(thrust, 20).is_large());
  auto motor = p;
  motor.wheels.resize(1);
  motor.wheels[0].type = WheelType::friction, motor.wheels[0].axial_inertia = 0.1, motor.wheels[0].friction = 0.1;
  CHECK(Prepared<double>(motor, 20).is_large());
  motor.wheels[0].friction = 0;
  CHECK_FALSE(Prepared<double>(motor, 20).is_large());
}

TEST_CASE("numbers that nothing moves are not stepped, and stay", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3.2, 4.1, 5.0).asDiagonal();
  p.angular_velocity = {0.3, -0.5, 0.8};
  const auto moving = [&](const auto& change) {
    const Prepared<double> of(p, 20);
    const auto piece = Piece<double>::first(p, of.wheels, of.torques, 20);
    auto start = first_numbers<double, true>(of);
    change(start);
    return FullSystem<double, true>(of, piece, start).moving();
  };
  const auto as_it_is = [](auto&) {};
  CHECK(moving(as_it_is) == 12);
  p.wheels.resize(4);
  for (auto& wheel : p.wheels)
    wheel.type = WheelType::friction, wheel.axial_inertia = 0.1, wheel.friction = 0.1, wheel.rate = 3;
  CHECK(moving(as_it_is) == 20);
  // the place of a wheel counts
  p.wheels.resize(8);
  CHECK(moving(as_it_is) == 20);
  p.wheels[6] = p.wheels[0];
  CHECK(moving(as_it_is) == 28);
  // the centre goes on with what an earlier force has given it
  CHECK(moving([](auto& x) { x[28] = 0.5; }) == 36);
  p.torques.resize(1);
  p.torques[0].type = TorqueType::thrust, p.torques[0].vector = {0, 0, 1};
  CHECK(moving(as_it_is) == 36);

  p.torques.clear();
  const Prepared<double> of(p, 20);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 20);
  auto start = first_numbers<double, true>(of);
  start[33] = 7;
  const FullSystem<double, true> system(of, piece, start);
  ode::TaylorOptions<double, 36> options;
  options.scale = system.scale();
  ode::Taylor<FullSystem<double, true>> solver(system, 0, start, options);
  REQUIRE(solver.step(0.1) == ode::Status::reached);
  double x[36];
  solver.at(0.05, x);
  CHECK(x[33] == 7);
  CHECK(solver.state()[33] == 7);
}

TEST_CASE("without torque R M stays, and under inertial torque it is what that adds", "[general]") {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.3, -0.5, 0.8};
  p.rotor_momentum = {0.1, 2, 0.3};
  for (const bool pushed : {false, true}) {
    if (pushed) {
      p.torques.resize(1);
      p.torques[0].axes = Axes::inertial, p.torques[0].vector = {0.01, -0.02, 0.03};
    }
    const Prepared<double> of(p, 500);
    const auto piece = Piece<double>::first(p, of.wheels, of.torques, 500);
    const auto [state, steps] = walk<false>(of, piece, 500, 1e-15);
    const Vec3<double> wanted = of.momentum + (pushed ? 500. : 0.) * Vec3<double>(0.01, -0.02, 0.03);
    const Vec3<double> there = rotate<double>(state.attitude, state.angular_momentum);
    CHECK((there - wanted).norm() < 4e-14 * wanted.norm());
    CHECK(norm(state.attitude) == Approx(1).epsilon(1e-15));
    CHECK((state.impulse - (wanted - of.momentum)).norm() < 4e-14 * wanted.norm());
  }
}

TEST_CASE("in a circular orbit the Jacobi integral stays", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(90, 120, 60).asDiagonal();
  p.orbit.emplace();
  const double n = 1;
  p.angular_velocity = {0.1, 1.1, 0.2};
  p.attitude = normalised(Quat<double>{1, 0.3, 0.2, -0.1});
  p.wheels.resize(1);
  p.wheels[0].axis = {0, 1, 0}, p.wheels[0].axial_inertia = 0.02, p.wheels[0].rate = 300;
  p.torques.resize(1);
  p.torques[0].type = TorqueType::gravity_gradient;
  const auto jacobi = [&](double t, const State<double>& s) {
    const auto at = orbit_at(*p.orbit, t);
    const Vec3<double> r = rotate<double>(conjugate(s.attitude), at.radial);
    const Vec3<double> normal = rotate<double>(conjugate(s.attitude), cross<double>(at.radial, at.along));
    return s.angular_velocity.dot(p.inertia * s.angular_velocity) / 2 + 1.5 * n * n * r.dot(p.inertia * r) -
           n * normal.dot(s.angular_momentum);
  };
  const Prepared<double> of(p, 60);
  const auto piece = Piece<double>::first(p, of.wheels, of.torques, 60);
  const auto start = first_numbers<double, false>(of);
  const double first = jacobi(0, state_of<double, false>(of, piece, 0, start.data()));
  const auto [state, steps] = walk<false>(of, piece, 60, 1e-15);
  CHECK(jacobi(60, state) == Approx(first).epsilon(1e-13));
}

TEST_CASE("what a brake opposes", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.angular_velocity = {1, 0, 0};
  p.rotor_momentum = {1, 0, 0};
  p.torques.resize(1);
  const auto braked = [&](Opposed opposed) {
    p.torques[0].type = TorqueType::brake, p.torques[0].opposed = opposed, p.torques[0].vector = {1, 1, 1};
    const Prepared<double> of(p, 1);
    const auto piece = Piece<double>::first(p, of.wheels, of.torques, 1);
    const auto start = first_numbers<double, false>(of);
    const FullSystem<double, false> system(of, piece, start);
    CHECK(system.has_brake());
    return system.braked(0, start.data());
  };
  CHECK(braked(Opposed::momentum) == 4);
  CHECK(braked(Opposed::carrier_momentum) == 3);
}

}  // namespace general_full_test
