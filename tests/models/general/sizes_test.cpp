// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/sizes.hpp"

#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "scenes.hpp"

namespace general_sizes_test {

using namespace gyrostat;
using namespace gyrostat::general;

Sizes<double> of(const Problem<double>& p, double span) {
  return sizes_of(p, Wheels<double>::of(p), Collected<double>::of(p, span), span);
}

TEST_CASE("the momenta of body and wheels may cancel and are still a size", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(4, 3, 2).asDiagonal();
  p.angular_velocity = {0.5, 1, 0.25};
  p.rotor_momentum = {-2, -3, -0.5};
  const auto sizes = of(p, 10);
  CHECK(sizes.momenta == Approx(2 * Vec3<double>(2, 3, 0.5).norm()));
  CHECK(sizes.momentum() == sizes.momenta);
  CHECK(sizes.least == 2);
  CHECK(sizes.greatest == 4);
  CHECK(sizes.turning == Approx(sizes.momenta / 2));
}

TEST_CASE("a body at rest has the size of what torques build up", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(4, 3, 2).asDiagonal();
  p.torques.resize(1);
  p.torques[0].vector = {0, 0, 0.01};
  CHECK(of(p, 10).momenta == 0);
  CHECK(of(p, 10).momentum() == Approx(0.1));
  CHECK(of(p, 1e6).momentum() == Approx(0.2));
  p.torques.clear();
  CHECK(of(p, 10).momentum() == 0);
  CHECK(of(p, 10).turning == 0);
}

TEST_CASE("the angle of a body that is pushed from its rate on, all along or for a while", "[general]") {
  Problem<double> p;
  p.inertia = 2 * Mat3<double>::Identity();
  p.angular_velocity = {0, 0, 0.1};
  p.torques.emplace_back().vector = {0, 0, 0.001};
  const auto all_along = of(p, 100);
  CHECK(all_along.angle == Approx(0.1 * 100 + 0.001 / 2 * 100 * 100 / 2));
  p.torques[0].factor.on = {{-5, 10}, {90, 200}};
  CHECK(of(p, 100).turning == Approx(0.1 + 0.001 * 20 / 2));
  CHECK(of(p, 100).turning < all_along.turning);
  CHECK(of(p, 100).angle == Approx(100 * (0.1 + 0.001 * 20 / 2 / 2)));
  // a brake adds nothing, a field what the body swings in it
  p.torques[0] = {};
  p.torques[0].type = TorqueType::brake, p.torques[0].vector = {1, 1, 1};
  CHECK(of(p, 100).angle == Approx(10));
  p.torques[0].type = TorqueType::magnetic, p.torques[0].vector = {0, 0, 4};
  p.field.magnetic = MagneticField::uniform, p.field.flux_density = {0.5, 0, 0};
  CHECK(of(p, 100).angle == Approx(10 + 100 * std::sqrt(4 * 0.5 / 2)).epsilon(0.3));
}

TEST_CASE("what goes on by itself has a rate", "[general]") {
  Problem<double> p;
  CHECK(of(p, 1).forcing == 0);
  p.torques.resize(1);
  p.torques[0].factor.amplitude = 1, p.torques[0].factor.rate = -3;
  CHECK(of(p, 1).forcing == 3);
  p.field.magnetic = MagneticField::rotating, p.field.rate = 7;
  CHECK(of(p, 1).forcing == 3);
  p.torques[0].type = TorqueType::magnetic;
  CHECK(of(p, 1).forcing == 7);
  p.orbit.emplace();
  p.orbit->mu = 100;
  CHECK(of(p, 1).forcing == Approx(10));
}

TEST_CASE("torques at rest are within their bound", "[general]") {
  general_scenes::Scenes source(51);
  for (int i = 0; i < 100; ++i) {
    const auto made = source.next(1);
    auto p = made.problem;
    // a field and an orbit that come nearer are not in it
    if (p.orbit) p.orbit->eccentricity = 0;
    bool overshoots = false;  // a cubic table between its values
    for (auto& torque : p.torques)
      overshoots =
          overshoots || torque.table.between == Between::cubic || torque.factor.table.between == Between::cubic;
    if (overshoots) continue;
    const auto sizes = of(p, made.span);
    const Pose<double> pose{p.attitude, {0, 0, 0}, {1e-9, 0, 0}};
    for (auto& torque : p.torques)
      if (torque.type == TorqueType::brake || torque.type == TorqueType::damping)
        torque.type = TorqueType::constant, torque.vector.setZero();
    CAPTURE(i);
    CHECK(load_at(p, pose, 0.3 * made.span, 0.3 * made.span).torque.norm() <= sizes.torque * (1 + 1e-12));
  }
}

}  // namespace general_sizes_test
