// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/wheels.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "scenes.hpp"

namespace general_wheels_test {

using namespace gyrostat;
using namespace gyrostat::general;

Problem<double> body() {
  Problem<double> p;
  p.inertia << 3.2, 0.1, -0.15, 0.1, 4.1, 0.2, -0.15, 0.2, 5.0;
  p.angular_velocity = {0.3, -0.5, 0.8};
  return p;
}

Wheel<double> wheel(WheelType type, const Vec3<double>& axis = {0, 0.6, 0.8}) {
  Wheel<double> made;
  made.type = type, made.axis = axis, made.axial_inertia = 0.2;
  if (type != WheelType::locked) made.rate = 3;
  return made;
}

TEST_CASE("every type of wheel is one of five time laws", "[general]") {
  auto p = body();
  for (int i = 0; i < 6; ++i) p.wheels.push_back(wheel(static_cast<WheelType>(i)));
  p.wheels[3].torque = 0.1;
  p.wheels[4].slope = 0.02, p.wheels[4].no_load_rate = 5;
  p.wheels[5].friction = 0.01;
  REQUIRE_FALSE(check_wheels(p));
  const auto w = Wheels<double>::of(p);
  const Follows wanted[] = {Follows::body,     Follows::rate,  Follows::constant,
                            Follows::integral, Follows::state, Follows::state};
  for (std::size_t i = 0; i < 6; ++i) CHECK(w.laws[i].follows == wanted[i]);
  CHECK(w.laws[4].torque == 0.02 * 5);
  CHECK(w.laws[4].friction == 0.02);
  const Vec3<double> u(0, 0.6, 0.8);
  CHECK((w.reduced - (p.inertia - 4 * 0.2 * u * u.transpose())).norm() < 1e-15);
  CHECK((w.inverse * w.reduced - Mat3<double>::Identity()).norm() < 1e-14);
  CHECK((w.rotor_momentum - 0.6 * u).norm() < 1e-15);
  // a motor without slope, and one that drives nothing, are free wheels
  p.wheels[4].slope = 0, p.wheels[3].torque = 0;
  CHECK(Wheels<double>::of(p).laws[4].follows == Follows::constant);
  CHECK(Wheels<double>::of(p).laws[3].follows == Follows::constant);
  // M is that of the whole with its wheels
  Vec3<double> M = p.inertia * p.angular_velocity;
  for (const auto& one : p.wheels) M += one.axial_inertia * one.rate * one.axis;
  CHECK((w.reduced * p.angular_velocity + w.momentum_of_wheels() - M).norm() < 1e-14);
}

TEST_CASE("a held wheel may go by a table", "[general]") {
  auto p = body();
  p.wheels.push_back(wheel(WheelType::held));
  p.wheels[0].table = {{-1, 1}, {10, 20}, Between::linear, false};
  REQUIRE_FALSE(check_wheels(p));
  const auto w = Wheels<double>::of(p);
  CHECK(w.laws[0].rate == 15);
  CHECK(w.rotor_momentum.isZero(0));
  CHECK((w.momentum_of_wheels() - 3 * p.wheels[0].axis).norm() < 1e-15);
}

TEST_CASE("zeros of a diagonal tensor stay", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(3, 2, 1.5).asDiagonal();
  p.wheels.push_back(wheel(WheelType::free, {0, 0, 1}));
  CHECK(Wheels<double>::of(p).inverse.isDiagonal(0));
}

TEST_CASE("bodies and wheels that are none are refused by name", "[general]") {
  const auto fault = [](auto&& change) {
    auto p = body();
    p.wheels.push_back(wheel(WheelType::locked));
    p.wheels.push_back(wheel(WheelType::motor));
    change(p);
    return check_wheels(p);
  };
  CHECK_FALSE(fault([](auto&) {}));
  CHECK(fault([](auto& p) { p.wheels[0].rate = 1; }).place == 0);
  CHECK(fault([](auto& p) { p.wheels[0].rate = 1; }).code == Errc::out_of_domain);
  CHECK(fault([](auto& p) { p.wheels[1].axial_inertia = 0; }).code == Errc::not_positive);
  CHECK_FALSE(fault([](auto& p) { p.wheels[0].axial_inertia = 0; }));
  CHECK(fault([](auto& p) { p.wheels[1].friction = -1; }).code == Errc::negative);
  CHECK(fault([](auto& p) { p.wheels[1].slope = -1; }).place == 1);
  CHECK(fault([](auto& p) { p.wheels[1].axis *= 1.1; }).code == Errc::out_of_domain);
  CHECK(fault([](auto& p) { p.wheels[1].no_load_rate = gyrostat::nan<double>; }).code == Errc::not_finite);
  CHECK(fault([](auto& p) { p.wheels[1].table = {{0}, {1}, Between::step, true}; }).code == Errc::out_of_domain);
  const auto held = [](Between between) {
    return [between](auto& p) {
      p.wheels[1] = wheel(WheelType::held);
      p.wheels[1].table = {{0, 10, 10 + 1e-5, 20}, {1, 1, 2, 2}, between, true};
    };
  };
  CHECK_FALSE(fault(held(Between::linear)));
  CHECK(fault(held(Between::cubic)).code == Errc::out_of_domain);
  CHECK(fault(held(Between::cubic)).place == 1);
  CHECK(fault([](auto& p) { p.inertia(0, 1) += 1e-3; }).code == Errc::not_symmetric);
  CHECK(fault([](auto& p) { p.inertia(2, 2) = 9; }).code == Errc::triangle_inequality);
  CHECK(fault([](auto& p) { p.rotor_momentum[1] = infinity<double>; }).code == Errc::not_finite);
  // the second wheel takes what the first has left
  const auto heavy = fault([](auto& p) {
    p.wheels[0] = p.wheels[1];
    p.wheels[0].axial_inertia = p.wheels[1].axial_inertia = 2.6;
  });
  CHECK(heavy.code == Errc::not_positive);
  CHECK(heavy.place == 1);
  CHECK(fault([](auto& p) { p.wheels.resize(9, p.wheels[1]); }).code == Errc::out_of_domain);
}

TEST_CASE("a body that no mass makes is told from one that some does", "[general]") {
  general_scenes::Scenes source(11);
  for (int i = 0; i < 50; ++i) {
    auto p = source.next(1).problem;
    p.fixed = false;
    if (p.wheels.size() > 1) p.wheels.resize(1);  // the largest alone has room
    CHECK(realisability(p) > -1e-12 * p.inertia.trace());
  }
  auto p = body();
  CHECK(realisability(p) > 0);
  p.wheels.push_back(wheel(WheelType::held, {0, 0, 1}));
  p.wheels[0].axial_inertia = 4.6;
  CHECK(realisability(p) < 0);
  auto fixed = body();
  fixed.fixed = true, fixed.mass = 10, fixed.centre_of_mass = {0, 0, 1};
  CHECK(realisability(fixed) < 0);
}

}  // namespace general_wheels_test
