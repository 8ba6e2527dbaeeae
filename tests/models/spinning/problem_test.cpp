// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/problem.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;

TEST_CASE("gyroscopic terms of the published body", "[spinning]") {
  Problem<double> p;
  p.inertia = {8.7, 8.6, 11.1};
  p.rotor_momentum = 1.3;
  p.charge_momentum = 0.003 * 100 * 1.02 * 1.02 * std::cos(0.37);
  p.angular_velocity = {0, 0, 0.2827433388230814};
  CHECK(p.gyroscopic() == Approx(1.009001988889444563).epsilon(1e-14));
  CHECK(p.kappa1(p.spin()) == Approx(0.1972253259709365727).epsilon(1e-14));
  CHECK(p.kappa2(p.spin()) == Approx(0.1962309304726558225).epsilon(1e-14));
  CHECK(p.nutation_squared() == Approx(0.03870170922804973530).epsilon(1e-14));
  CHECK(p.axial_momentum() == Approx(4.438451060936203390).epsilon(1e-14));
  CHECK(p.effective_momentum() == Approx(4.147453049825647909).epsilon(1e-14));
}

TEST_CASE("nu^2 - r0^2 = X (X - r0 (D1 + D2))/(D1 D2), for spin of either sign", "[spinning]") {
  for (const double r0 : {-2.0, -0.3, 0.0, 0.7, 5.0}) {
    for (const double Lambda : {-3.0, 0.0, 2.0}) {
      Problem<double> p;
      p.inertia = {3, 4, 5};
      p.rotor_momentum = Lambda;
      p.angular_velocity = {0, 0, r0};
      const double X = p.effective_momentum();
      CHECK(p.nutation_squared() - r0 * r0 == Approx(X * (X - r0 * 7) / 12).margin(1e-13));
    }
  }
}

TEST_CASE("the angle that an axial torque spins a body through is in its phase", "[spinning]") {
  Problem<double> p;
  p.inertia = {3, 4, 5};
  p.angular_velocity = {0, 0, 0.1};
  p.torque = {0, 0, 0.02};
  const double span = 1e4, angle = 0.1 * span + 0.02 / 5 * span * span / 2;
  CHECK(p.phase(span) >= angle);
  CHECK(p.phase(span) < 1.1 * angle);
}
