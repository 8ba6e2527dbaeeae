// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/instances.hpp"

#include "answered.hpp"

using namespace general_scenes;

namespace {

general::detail::Loads loads_of(const Problem<double>& p) {
  return general::detail::Loads::of(p, Collected<double>::of(p, 1));
}

}  // namespace

TEST_CASE("torques that cancel are none, and what is left of them below rounding is dropped", "[general]") {
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::constant, {0.1, 0.2, 0.3}), torque(TorqueType::constant, {-0.1, -0.2, -0.3})};
  CHECK(loads_of(p).quiet());
  p.torques[1].vector[0] = -0.1 * (1 + 4 * epsilon<double>);
  CHECK(loads_of(p).quiet());
  p.torques[1].vector[0] = -0.1 * (1 + 200 * epsilon<double>);
  CHECK_FALSE(loads_of(p).quiet());
}

TEST_CASE("a charge is the skew part of what is linear in the rates", "[general]") {
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::charge, {0.1, -0.2, 0.3}),
               damping(Mat3<double>::Identity(), Opposed::angular_velocity)};
  const auto loads = loads_of(p);
  CHECK((loads.charge - Vec3<double>(0.1, -0.2, 0.3)).norm() < 1e-15);
  CHECK((loads.damping - Mat3<double>::Identity()).norm() < 1e-15);
}

TEST_CASE("weight and a dipole in a uniform field are one moment where they act along one direction", "[general]") {
  Problem<double> p = brick();
  p.fixed = true, p.mass = 2, p.centre_of_mass = {0, 0.1, 0.2}, p.field.gravity = 9;
  p.field.down = Vec3<double>(1, 2, -2) / 3;
  p.field.magnetic = MagneticField::uniform;
  p.field.flux_density = 3e-5 * p.field.down;
  p.torques = {torque(TorqueType::weight, {0, 0, 0}), torque(TorqueType::magnetic, {1e4, 0, 0})};
  const auto loads = loads_of(p);
  CHECK(loads.other == nullptr);
  CHECK((loads.direction.dot(p.field.down) > 0 ? 1 : -1) * loads.moment.dot(Vec3<double>(0.3, 1.8, 3.6)) ==
        Approx(0.09 + 1.8 * 1.8 + 3.6 * 3.6));
  p.field.flux_density = {3e-5, 0, 0};
  CHECK(loads_of(p).other != nullptr);
}

TEST_CASE("a body is symmetric about an axis to 8 roundings of its greatest element", "[general]") {
  const auto symmetric = [](double I) {
    return general::detail::symmetric_about(Vec3<double>(2, 2 * (1 + I), 3).asDiagonal(), {0, 0, 1});
  };
  CHECK(symmetric(0));
  CHECK(symmetric(4 * epsilon<double>));
  CHECK_FALSE(symmetric(20 * epsilon<double>));
  CHECK_FALSE(general::detail::symmetric_about(Vec3<double>(2, 2, 3).asDiagonal(), {1, 0, 0}));
}

TEST_CASE("what is dropped is counted in roundings", "[general]") {
  using namespace general::detail;
  constexpr double eps = epsilon<double>;
  double dropped = 0;
  CHECK(drops(0, 1, &dropped));
  CHECK(drops(0, 0, &dropped));
  CHECK(dropped == 0);
  CHECK(drops(6 * eps, 2, &dropped));
  CHECK(dropped == 3);
  CHECK(drops(2 * eps, 2, &dropped));
  CHECK(dropped == 3);
  CHECK_FALSE(drops(9 * eps, 1, &dropped));
  CHECK(dropped == 3);
  CHECK(drops(8 * eps, 1, nullptr));
}

TEST_CASE("wheels: what stays, what turns freely, what is driven", "[general]") {
  Problem<double> p = brick();
  p.wheels = {wheel(WheelType::held, {1, 0, 0}), wheel(WheelType::free, {0, 1, 0}, -7),
              wheel(WheelType::motor, {0, 0, 1})};
  const auto of = [&] { return general::detail::Spinners::of(Wheels<double>::of(p)); };
  CHECK(of().spare);  // a motor without slope is a free wheel
  p.wheels[2].slope = 0.01;
  CHECK(of().driven == 2);
  CHECK((of().kept - Vec3<double>(1, 0.05 * (-7 - 0.5), 0)).norm() < 1e-15);
  p.wheels.push_back(wheel(WheelType::friction, {0, 0, 1}));
  p.wheels[3].friction = 0.1;
  CHECK(of().driven == -2);
  p.wheels[0].table = {{0, 1}, {1, 2}, Between::linear, false};
  CHECK(of().why != nullptr);
}
