// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/problem.hpp"

#include "bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

TEST_CASE("energy and rates of a gyrostat", "[deceleration]") {
  Bodies bodies(1);
  for (int trial = 0; trial < 100; ++trial) {
    auto p = bodies.problem(1e-3);
    p.rotor_momentum = bodies.vector();
    const V M = bodies.vector(), w = p.angular_velocity(M);
    const V J = p.inverse_inertia.cwiseInverse();
    CHECK((J.cwiseProduct(w) + p.rotor_momentum - M).norm() < 1e-14 * (M.norm() + p.rotor_momentum.norm()));
    CHECK(p.energy(M) == Approx(w.dot(J.cwiseProduct(w)) / 2).epsilon(1e-12));
    // the free motion keeps the energy: omega is the gradient of h, dM/dt is across it and across M
    const V flow = cross<double>(M, w);
    CHECK(std::abs(flow.dot(w)) < 1e-14 * M.norm() * w.squaredNorm());
    CHECK(std::abs(flow.dot(M)) < 1e-14 * M.squaredNorm() * w.norm());
    CHECK(p.energy(V(0, 0, 0)) == Approx(p.rotor_energy_scale() / 2).epsilon(1e-13));
    CHECK(p.energy(p.rotor_momentum) == 0);
    CHECK(p.angular_velocity(V(0, 0, 0)) == -p.gyro_rate());
  }
}

TEST_CASE("a problem is left alone unless said otherwise", "[deceleration]") {
  const Problem<long double> p;
  CHECK(p.control.isZero(0));
  CHECK(p.drag == 0);
  CHECK(p.rotor_momentum.isZero(0));
  CHECK(p.law == Law::total);
}
