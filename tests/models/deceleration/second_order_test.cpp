// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/second_order.hpp"

#include "bodies.hpp"
#include "gyrostat/models/deceleration/averaged.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

Mat3<double> diagonal(const V& b) { return b.asDiagonal(); }

}  // namespace

TEST_CASE("the oscillation is the antiderivative of the rates less their mean", "[deceleration]") {
  Bodies bodies(10);
  for (int trial = 0; trial < 200; ++trial) {
    const auto problem = bodies.problem(1);
    const V &a = problem.inverse_inertia, M0 = bodies.vector();
    const double R = M0.norm();
    const auto p = polhode_through<double>(a, M0);
    if (p.modulus.kp2 < 1e-2 || p.modulus.k2 < 1e-2) continue;
    const auto b = ControlTorques<double>::of(problem.control, p.axes);
    const auto mean = mean_torque<>(p, b);
    const double rate = p.rate_per_momentum() * R;
    for (double u : {.1, .9, 2.3, -1.7}) {
      const double h = 1e-4;
      const auto plus = oscillation<>(p, b, R, u + h), minus = oscillation<>(p, b, R, u - h);
      const V M = momentum_on<>(p, R, u), torque = -problem.control * M / R;
      const double norm = M.dot(torque) / R + mean.deceleration;
      CHECK((plus.norm - minus.norm) / (2 * h) * rate * R == Approx(norm).epsilon(1e-6).margin(1e-7));
      const double s = 1e-6;
      const auto k2 = [&](double x) { return polhode_through<double>(a, M + x * torque).modulus.k2; };
      const double spread = (k2(s) - k2(-s)) / (2 * s) - 2 * p.modulus.kp2 * mean.escape / R;
      CHECK((plus.spread - minus.spread) / (2 * h) * rate * p.modulus.k2 == Approx(spread).epsilon(1e-5).margin(1e-6));
    }
  }
}

TEST_CASE("the oscillation has no mean and stays under its bound", "[deceleration]") {
  Bodies bodies(11);
  for (int trial = 0; trial < 300; ++trial) {
    const auto problem = bodies.problem(1);
    const V M0 = bodies.vector();
    const double R = M0.norm();
    const auto p = polhode_through<double>(problem.inverse_inertia, M0);
    const auto b = ControlTorques<double>::of(problem.control, p.axes);
    const double K = math::Native::complete(p.modulus).K;
    const auto bound = greatest_oscillation(p, b, R);
    double sum = 0, most_norm = 0, most_spread = 0;
    const int n = 256;
    for (int i = 0; i < n; ++i) {
      const auto o = oscillation<>(p, b, R, 2 * K * i / n);
      sum += o.norm;
      most_norm = std::max(most_norm, std::abs(o.norm));
      most_spread = std::max(most_spread, std::abs(o.spread));
    }
    CHECK(std::abs(sum / n) < 1e-12 * bound.norm + 1e-300);
    CHECK(most_norm <= bound.norm * (1 + 1e-12));
    CHECK(most_spread <= bound.spread * (1 + 1e-12));
    if (p.modulus.kp2 > 1e-6) CHECK(bound.norm <= 1.45 * most_norm + 1e-300);
  }
}

TEST_CASE("zeta over k2 is regular at zero", "[deceleration]") {
  for (double u : {.3, 1.2, -2.5})
    for (double k2 : {1e-4, 1e-9, 1e-200})
      CHECK(zeta_over_k2<math::Native>(u, math::Modulus<double>{k2, 1 - k2}) ==
            Approx(zeta_over_k2<math::Native>(u, math::Modulus<double>{0, 1})).epsilon(3 * k2 + 1e-12));
}

TEST_CASE("equal torques oscillate nothing", "[deceleration]") {
  Bodies bodies(12);
  for (int trial = 0; trial < 50; ++trial) {
    const V a = bodies.inverse_inertia(), M = bodies.vector();
    const auto p = polhode_through<double>(a, M);
    const auto o = greatest_oscillation(p, ControlTorques<double>::of(diagonal(V(.5, .5, .5)), p.axes), M.norm());
    CHECK(o.norm < 1e-14 / M.squaredNorm() / p.rate_per_momentum());
    CHECK(o.spread < 1e-14 / M.squaredNorm() / p.rate_per_momentum());
  }
}

TEST_CASE("a shift that leaves [0, 1] is refused", "[deceleration]") {
  const V a(1 / 1.4, 1, 1 / .7);
  const auto p = at_modulus(polhode_through<double>(a, V(1, .1, .1)), {.9, .1});
  const auto small = shifted(p, .01);
  REQUIRE(small.valid);
  CHECK(small.polhode.modulus.k2 == Approx(.909).epsilon(1e-14));
  CHECK(small.polhode.modulus.kp2 == Approx(.091).epsilon(1e-14));
  CHECK(shifted(p, .0555).valid);
  CHECK_FALSE(shifted(p, .0556).valid);  // over half of kp2
  CHECK_FALSE(shifted(p, -.0556).valid);
  const auto low = at_modulus(p, {.1, .9});
  CHECK(shifted(low, .5).valid);
  CHECK_FALSE(shifted(low, .51).valid);  // over half of k2
  CHECK_FALSE(shifted(low, gyrostat::nan<double>).valid);
  CHECK(shifted(at_modulus(p, {0, 1}), .1).polhode.modulus.k2 == 0);
  const auto round = polhode_through<double>(V(1, 1, 2), V(.3, .4, .5));
  const auto tilted = shifted(round, .1);
  REQUIRE(tilted.valid);
  CHECK(tilted.polhode.tilt == Approx(1.1 * round.tilt));
  CHECK_FALSE(shifted(round, -.6).valid);
}
