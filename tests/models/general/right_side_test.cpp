// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/right_side.hpp"

#include <array>

#include "catch.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "scenes.hpp"

namespace general_right_side_test {

using namespace gyrostat;
using namespace gyrostat::general;

Flow<double>::Numbers rate_of(const Flow<double>& flow, double t, const Flow<double>::Numbers& y) {
  Flow<double>::Numbers rate;
  flow(t, y, rate);
  return rate;
}

TEST_CASE("one motor turns as in the family rotor", "[general]") {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.2, -0.1, 0.4};
  Wheel<double> motor;
  motor.type = WheelType::motor, motor.axis = Vec3<double>(0.75, 0.35, 0.56).normalized();
  motor.axial_inertia = 0.35, motor.rate = 2, motor.slope = 0.05, motor.no_load_rate = 30;
  p.wheels.push_back(motor);
  const auto wheels = Wheels<double>::of(p);
  const Flow<double> flow(p, wheels);
  const auto y = flow.start(), rate = rate_of(flow, 0, y);
  const auto rotor = rotor::Gyrostat<double>::make(p.inertia, motor.axis, 0.35, 0.05, 30.);
  REQUIRE(rotor);
  const auto there = rotor->state({}, p.angular_velocity, 2.);
  const auto wanted = rotor::state_rate(*rotor, there);
  for (int i = 0; i < 3; ++i) {
    CHECK(y[4 + std::size_t(i)] == Approx(there.momentum[i]));
    CHECK(rate[4 + std::size_t(i)] == Approx(wanted.momentum[i]));
  }
  CHECK(rate[Flow<double>::wheel] == Approx(wanted.axial_momentum));
  CHECK(rate[Flow<double>::angle] == Approx(wanted.rotor_angle));
  CHECK(rate[1] == Approx(wanted.attitude.x));
}

TEST_CASE("weight and gravity gradient turn a body as in the family heavy", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(0.6, 0.7, 0.4).asDiagonal();
  p.fixed = true, p.mass = 2, p.centre_of_mass = {0.02, -0.01, 0.1}, p.field.gravity = 9.8;
  p.attitude = normalised(Quat<double>{1, 0.3, -0.2, 0.5});
  p.angular_velocity = {1, -2, 3};
  p.torques.resize(2);
  p.torques[0].type = TorqueType::weight;
  p.torques[1].type = TorqueType::gravity_gradient, p.torques[1].gradient = 0.7;
  const auto wheels = Wheels<double>::of(p);
  const Flow<double> flow(p, wheels);
  const auto rate = rate_of(flow, 0, flow.start());
  const auto heavy = heavy::Problem<double>::make({0.6, 0.7, 0.4}, 2, p.centre_of_mass, 9.8, 0.7);
  REQUIRE(heavy);
  const Vec3<double> down = rotate<double>(conjugate(p.attitude), p.field.down);
  const Vec3<double> wanted = p.inertia * heavy::angular_acceleration<double>(*heavy, p.angular_velocity, down);
  for (int i = 0; i < 3; ++i) CHECK(rate[4 + std::size_t(i)] == Approx(wanted[i]));
}

TEST_CASE("eddy currents take energy, charge and a magnet across itself do no work", "[general]") {
  general_scenes::Scenes source(31);
  for (int i = 0; i < 100; ++i) {
    auto p = source.next(1).problem;
    p.field.magnetic = MagneticField::uniform;
    const Vec3<double>& w = p.angular_velocity;
    const Pose<double> pose{p.attitude, w, p.inertia * w};
    Torque<double> torque;
    torque.type = TorqueType::eddy_current, torque.matrix = Vec3<double>(1, 2, 3).asDiagonal();
    p.torques = {torque};
    CHECK(load_at(p, pose, 0., 0.).torque.dot(w) <= 0);
    torque.type = TorqueType::charge, torque.vector = {1, -2, 3};
    p.torques = {torque};
    CHECK(std::abs(load_at(p, pose, 0., 0.).torque.dot(w)) <= 1e-15 * w.squaredNorm() * 10);
  }
}

TEST_CASE("what is switched on at a time acts from it on", "[general]") {
  Problem<double> p;
  p.torques.resize(1);
  p.torques[0].vector = {1, 0, 0};
  p.torques[0].factor.on = {{2, 3}};
  const auto at = [&](double t, double inside) { return load_at(p, Pose<double>{}, t, inside).torque[0]; };
  CHECK(at(2, 2) == 1);
  CHECK(at(2, 1.5) == 0);
  CHECK(at(3, 3) == 0);
  CHECK(at(3, 2.5) == 1);
}

}  // namespace general_right_side_test
