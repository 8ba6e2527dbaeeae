// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/general/balances.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "scenes.hpp"

namespace general_balances_test {

using namespace gyrostat;
using namespace gyrostat::general;

TEST_CASE("the power is the derivative of the energy", "[general]") {
  general_scenes::Scenes source(71);
  for (int i = 0; i < 100; ++i) {
    const auto made = source.next(2);
    const auto& p = made.problem;
    const auto wheels = Wheels<double>::of(p);
    Flow<double> flow(p, wheels);
    const auto y = flow.start();
    if (Vec3<double>(y[4], y[5], y[6]).norm() < 1e-9) continue;
    Flow<double>::Numbers rate;
    flow(0, y, rate);
    const double turning = sizes_of(p, wheels, Collected<double>::of(p, made.span), made.span).turning;
    const double h = 1e-4 / turning;
    const auto beside = [&](double s) {
      auto there = y;
      for (std::size_t k = 0; k < there.size(); ++k) there[k] += s * rate[k];
      return energy(wheels, flow.state(s, there));
    };
    const auto here = flow.state(0, y);
    const Pose<double> pose{here.attitude, here.angular_velocity, here.angular_momentum};
    const double gain = power(p, wheels, here, load_at(p, pose, 0., 0.).torque, 0., 0.).whole(), E = beside(0);
    // what a central difference loses
    const double slope = (beside(h) - beside(-h)) / (2 * h);
    CAPTURE(i, made.kind);
    CHECK(std::abs(slope - gain) <= 1e-9 * (std::abs(gain) + E * turning));
  }
}

TEST_CASE("a body under a constant torque balances, and one with a wrong torque does not", "[general]") {
  Problem<double> p;
  p.inertia = Vec3<double>(2, 2, 2).asDiagonal();
  p.torques.resize(1);
  p.torques[0].vector = {0, 0, 4};
  const auto wheels = Wheels<double>::of(p);
  for (const double error : {0., 0.01}) {
    Balances<double> balances(p, wheels);
    balances.add(1., 3., [&](double t) {
      State<double> state;
      const double rate = (2 + error) * t, angle = rate * t / 2;
      state.angular_velocity = {0, 0, rate}, state.angular_momentum = {0, 0, 2 * rate};
      state.attitude = {std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
      return state;
    });
    if (error == 0) {
      CHECK(balances.work().torques == Approx(2 * 2 * (9 - 1)).epsilon(1e-15));
      CHECK(balances.work().motors == 0);
      CHECK(balances.energy() < 1e-15);
      CHECK(balances.momentum() < 1e-15);
    } else {
      CHECK(balances.energy() > 1e-3);
      CHECK(balances.momentum() > 1e-3);
    }
  }
  CHECK(Balances<double>(p, wheels).energy() == 0);
}

}  // namespace general_balances_test
