// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/general/recognise.hpp"

#include <string>

#include "answered.hpp"
#include "special_scenes.hpp"

using namespace general_scenes;

namespace {

const char* why_not(const Problem<double>& p, Special family) {
  return posed(p, question_at({1, 10})).instances().why[std::size_t(family)];
}
bool is(const Problem<double>& p, Special family) { return why_not(p, family) == nullptr; }

/// A top about its third axis.
Problem<double> top() {
  Problem<double> p = brick();
  p.inertia = Vec3<double>(2, 2, 1.5).asDiagonal();
  p.fixed = true;
  p.mass = 2, p.centre_of_mass = {0, 0, 0.2}, p.field.gravity = 9.8;
  p.torques = {torque(TorqueType::weight, {0, 0, 0})};
  return p;
}

constexpr double just = 2 * epsilon<double>, no_more = 40 * epsilon<double>;

}  // namespace

TEST_CASE("every scene that is made as an instance of a family is recognised as one", "[general]") {
  SpecialScenes scenes(5);
  for (int i = 0; i < 400; ++i) {
    const auto family = Special(i % int(specials));
    const auto made = scenes.of(family, 5);
    CAPTURE(i, special_words[std::size_t(family)]);
    const char* why = posed(made.problem, question_at({made.span})).instances().why[std::size_t(family)];
    CHECK(std::string(why ? why : "") == "");
  }
}

TEST_CASE("a free body: no torque but a charge's, wheels that keep rate or momentum", "[general]") {
  Problem<double> p = brick();
  p.wheels = {wheel(WheelType::held, {1, 1, 0}), wheel(WheelType::free, {0, 1, 0}),
              wheel(WheelType::locked, {0, 0, 1})};
  p.torques = {torque(TorqueType::charge, {0.1, 0.2, -0.1})};
  CHECK(is(p, Special::free));
  auto driven = p;
  driven.wheels[0].type = WheelType::torque;
  CHECK(is(driven, Special::free));  // by no torque
  driven.wheels[0].torque = 1e-9;
  CHECK_FALSE(is(driven, Special::free));
  auto pushed = p;
  pushed.torques.push_back(torque(TorqueType::constant, {1e-12, 0, 0}));
  CHECK_FALSE(is(pushed, Special::free));
  pushed.torques[1].factor.on = {{20, 30}};  // after the last time
  CHECK(is(pushed, Special::free));
  pushed.torques[1].factor.on = {{2, 3}};
  CHECK_FALSE(is(pushed, Special::free));
  pushed.torques[1].vector.setZero();
  CHECK(is(pushed, Special::free));
}

TEST_CASE("a brake and a drag: on the whole with any wheels, on the carrier with held ones", "[general]") {
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::brake, {0.1, 0.2, 0.3}), damping(0.01 * Mat3<double>::Identity(), Opposed::momentum)};
  p.torques[0].opposed = Opposed::momentum;
  p.wheels = {wheel(WheelType::free, {0, 1, 0})};
  CHECK(is(p, Special::deceleration));
  p.torques[0].opposed = Opposed::carrier_momentum;
  CHECK_FALSE(is(p, Special::deceleration));
  p.wheels[0].type = WheelType::held;
  CHECK(is(p, Special::deceleration));
  // a damping of the rates is a drag where it is a multiple of the inertia
  p.torques = {damping(0.01 * p.inertia, Opposed::angular_velocity)};
  CHECK(is(p, Special::deceleration));
  p.torques[0].matrix(0, 0) *= 1 + just;
  CHECK(is(p, Special::deceleration));
  p.torques[0].matrix(0, 0) *= 1 + no_more;
  CHECK_FALSE(is(p, Special::deceleration));
  p.torques = {damping(-0.01 * Mat3<double>::Identity(), Opposed::momentum)};
  CHECK_FALSE(is(p, Special::deceleration));
}

TEST_CASE("a heavy body, and as one a magnet in a field; a symmetric gyrostat by its turned frame", "[general]") {
  Problem<double> p = top();
  CHECK(is(p, Special::heavy));
  p.wheels = {wheel(WheelType::held, {0, 0, 1})};
  CHECK(is(p, Special::heavy));
  p.inertia(0, 0) *= 1 + just;
  CHECK(is(p, Special::heavy));
  p.inertia(0, 0) *= 1 + no_more;
  CHECK_FALSE(is(p, Special::heavy));
  p.wheels.clear();
  CHECK(is(p, Special::heavy));
  p.wheels = {wheel(WheelType::held, {0, 1, 0})};
  CHECK_FALSE(is(p, Special::heavy));
  Problem<double> magnet = brick();
  magnet.field.magnetic = MagneticField::uniform, magnet.field.flux_density = {1e-5, 2e-5, 0};
  magnet.torques = {torque(TorqueType::magnetic, {100, 0, 5})};
  CHECK(is(magnet, Special::heavy));
  magnet.field.magnetic = MagneticField::rotating, magnet.field.rate = 1e-3;
  CHECK_FALSE(is(magnet, Special::heavy));
}

TEST_CASE("one driven wheel, all other momentum along it", "[general]") {
  Problem<double> p = brick();
  p.wheels = {wheel(WheelType::motor, {1, 2, 3}), wheel(WheelType::held, {-1, -2, -3})};
  p.wheels[0].slope = 0.01, p.wheels[0].no_load_rate = 30;
  CHECK(is(p, Special::rotor));
  p.wheels[1].axis[0] += just;
  p.wheels[1].axis.normalize();
  CHECK(is(p, Special::rotor));
  p.wheels[1].axis[0] += no_more;
  p.wheels[1].axis.normalize();
  CHECK_FALSE(is(p, Special::rotor));
  p.wheels[1] = wheel(WheelType::friction, {1, 2, 3});
  p.wheels[1].friction = 0.01;
  CHECK_FALSE(is(p, Special::rotor));
  p.wheels.pop_back();
  p.wheels[0].slope = 1e-12;  // a torque that hardly depends on the rate
  p.wheels[0].no_load_rate = 1e9;
  CHECK_FALSE(is(p, Special::rotor));
}

TEST_CASE("constant torque and thrust, momentum of wheels along a principal axis", "[general]") {
  Problem<double> p = brick();
  p.torques = {torque(TorqueType::thrust, {0, 0, 10})};
  p.torques[0].point = {0.1, 0, 0};
  p.wheels = {wheel(WheelType::held, {0, 1, 0})};
  CHECK(is(p, Special::spinning));
  CHECK(posed(p, question_at({1})).instances().spinning->R_SB.row(2).isApprox(Vec3<double>(0, 1, 0).transpose()));
  p.wheels[0].axis = Vec3<double>(0, 1, just).normalized();
  CHECK(is(p, Special::spinning));
  p.wheels[0].axis = Vec3<double>(0, 1, 100 * no_more).normalized();
  CHECK_FALSE(is(p, Special::spinning));
  p.wheels.clear();
  p.torques[0].axes = Axes::inertial;
  CHECK_FALSE(is(p, Special::spinning));
}

TEST_CASE("what torques leave that all but cancel is dropped where it comes to no more than a rounding of the momentum",
          "[general]") {
  constexpr double eps = epsilon<double>;
  const auto opposed = [](Torque<double> one, double roundings) {
    Torque<double> other = one;
    other.vector *= -(1 + roundings * eps), other.matrix *= -(1 + roundings * eps);
    return std::vector<Torque<double>>{one, other};
  };
  Problem<double> p = brick();
  for (const double roundings : {0., 6.}) {
    p.torques = opposed(torque(TorqueType::constant, {1e4, -2e4, 3e4}), roundings);
    CHECK(is(p, Special::free) == (roundings == 0));
    p.torques = opposed(torque(TorqueType::constant, {1e-4, -2e-4, 3e-4}), roundings);
    CHECK(is(p, Special::free));
    // what charges leave is momentum that a free body may have
    p.torques = opposed(torque(TorqueType::charge, {1e4, -2e4, 3e4}), roundings);
    CHECK(is(p, Special::free));
    CHECK((posed(p, question_at({1})).instances().charge.norm() > 0) == (roundings > 0));
  }
  p.torques = opposed(torque(TorqueType::constant, {1e4, -2e4, 3e4}), 6);
  for (auto& each : p.torques) each.axes = Axes::inertial;
  CHECK_FALSE(is(p, Special::free));
  p.torques = opposed(damping(1e4 * Mat3<double>::Identity(), Opposed::angular_velocity), 6);
  CHECK_FALSE(is(p, Special::free));
  p.torques = opposed(damping(1e4 * Mat3<double>::Identity(), Opposed::momentum), 6);
  CHECK_FALSE(is(p, Special::free));
  // beside a torque that is as strong it is a rounding of that
  p.torques = opposed(torque(TorqueType::constant, {1e4, 0, 0}), 6);
  p.torques.push_back(damping(1e5 * Mat3<double>::Identity(), Opposed::momentum));
  CHECK(is(p, Special::deceleration));
}

TEST_CASE("a scene is an instance to 8 roundings and none with 9, and the answers go on from one to the other",
          "[general]") {
  constexpr double eps = epsilon<double>;
  struct Row {
    Special family;
    Problem<double> (*make)(double roundings);
  };
  const Row rows[] = {
      {Special::free,
       [](double k) {
         Problem<double> p = brick();
         // so weak that what is left does no more than a rounding of the momentum
         p.torques = {torque(TorqueType::constant, {0.005, 0, 0}),
                      torque(TorqueType::constant, {-0.005 * (1 + 2 * k * eps), 0, 0})};
         return p;
       }},
      {Special::deceleration,
       [](double k) {
         Problem<double> p = brick();
         p.torques = {damping(0.03125 * Mat3<double>::Identity(), Opposed::momentum)};
         p.torques[0].matrix(0, 1) = k * eps * 0.03125;
         return p;
       }},
      {Special::deceleration,  // drag on the carrier
       [](double k) {
         Problem<double> p = brick();
         p.inertia = Vec3<double>(4, 4, 4).asDiagonal();
         p.torques = {damping(0.25 * Mat3<double>::Identity(), Opposed::angular_velocity)};
         p.torques[0].matrix(0, 1) = p.torques[0].matrix(1, 0) = k * eps * 0.25;
         return p;
       }},
      {Special::heavy,  // symmetric, with a wheel
       [](double k) {
         Problem<double> p = top();
         p.inertia(0, 0) *= 1 + k * eps;
         p.wheels = {wheel(WheelType::held, {0, 0, 1})};
         return p;
       }},
      {Special::heavy,  // weight and a dipole across it, as strong, in a field along the vertical
       [](double k) {
         // half of what the field is off by is across both
         Problem<double> p = top();
         p.field.down = {0, 0, -1};
         p.field.magnetic = MagneticField::uniform, p.field.flux_density = {2 * 0.999 * k * eps, 0, -1};
         p.torques.push_back(torque(TorqueType::magnetic, {2 * 9.8 * 0.2, 0, 0}));
         return p;
       }},
      {Special::rotor,
       [](double k) {
         Problem<double> p = brick();
         p.wheels = {wheel(WheelType::motor, {0, 0, 1}), wheel(WheelType::held, {0, 0, 1})};
         p.wheels[0].slope = 0.01, p.wheels[0].no_load_rate = 30;
         p.wheels[1].axis[0] = k * eps;
         return p;
       }},
      {Special::spinning,
       [](double k) {
         Problem<double> p = brick();
         p.torques = {torque(TorqueType::constant, {0.01, -0.02, 0.005})};
         p.wheels = {wheel(WheelType::held, {0, 1, 0})};
         p.wheels[0].axis[2] = k * eps;
         return p;
       }},
  };
  for (const Row& row : rows) {
    CAPTURE(special_words[std::size_t(row.family)], &row - rows);
    const auto inside = row.make(8), outside = row.make(9);
    CHECK(is(inside, row.family));
    CHECK_FALSE(is(outside, row.family));
    const Answer one = solved(posed(inside, question_at({1, 10}, 1e-10)));
    const Answer other = solved(posed(outside, question_at({1, 10}, 1e-10)));
    CHECK(std::string(one.model).starts_with(special_words[std::size_t(row.family)]));
    CHECK_FALSE(std::string(other.model).starts_with(special_words[std::size_t(row.family)]));
    int compared = 0;
    for (const Column& column : one.columns) {
      const Column* its = other.find(column.name());
      if (its == nullptr || !(column.error < infinity<double>)) continue;
      CAPTURE(column.name(), column.error, its->error);
      CHECK(column_error(column, *its) <= column.error + its->error);
      ++compared;
    }
    CHECK(compared >= 2);
  }
}

TEST_CASE("a scene that is none says why, and where it is not to be recognised is none", "[general]") {
  const Problem<double> p = brick();
  const auto alone = Scene::make(p, question_at({1}), false);
  REQUIRE(alone);
  for (const char* why : alone->instances().why) CHECK(std::string(why) == "families are not looked for");
  for (const auto family : {Special::deceleration, Special::heavy, Special::rotor, Special::spinning})
    CHECK(std::string(why_not(p, family)).size() > 10);
}
