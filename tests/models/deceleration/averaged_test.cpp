// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/averaged.hpp"

#include "bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

struct Rates {
  double norm, log_kp2;
};

/// d|M|/dt and d(-ln kp2)/dt of the control averaged over the orbit, by its own torque at equal times.
Rates numerical(const Polhode<double>& p, const Mat3<double>& control, const V& a, double R) {
  const double K = math::Native::complete(p.modulus).K;
  const int n = 512;
  Rates sum{0, 0};
  for (int i = 0; i < n; ++i) {
    const V M = momentum_on<>(p, R, 4 * K * i / n), torque = -control * M / R;
    sum.norm += M.dot(torque) / R / n;
    const double h = 1e-6;
    const auto x = [&](double s) { return -std::log(polhode_through<double>(a, M + s * torque).modulus.kp2); };
    sum.log_kp2 += (x(h) - x(-h)) / (2 * h) / n;
  }
  return sum;
}

}  // namespace

TEST_CASE("the mean torque is the mean of the torque over the orbit", "[deceleration]") {
  Bodies bodies(6);
  for (int trial = 0; trial < 60; ++trial) {
    auto problem = bodies.problem(1);
    const V& a = problem.inverse_inertia;
    const V M = bodies.vector();
    const auto p = polhode_through<double>(a, M);
    if (p.modulus.kp2 < 1e-3) continue;
    const auto mean = mean_torque<>(p, ControlTorques<double>::of(problem.control, p.axes));
    const Rates r = numerical(p, problem.control, a, M.norm());
    CHECK(-mean.deceleration == Approx(r.norm).epsilon(1e-12));
    CHECK(2 * mean.escape / M.norm() == Approx(r.log_kp2).epsilon(1e-6).margin(1e-6));
    CHECK(mean.K == Approx(math::Native::complete(p.modulus).K).epsilon(1e-14));
  }
}

TEST_CASE("means of the squares add up to M^2 and 2H", "[deceleration]") {
  Bodies bodies(7);
  for (int trial = 0; trial < 300; ++trial) {
    const V a = bodies.inverse_inertia(), M = bodies.vector();
    const auto p = polhode_through<double>(a, M);
    V squares;  // in units of M^2
    for (int i = 0; i < 3; ++i) {
      Mat3<double> unit = Mat3<double>::Zero();
      unit(i, i) = 1;
      squares[i] = mean_torque<>(p, ControlTorques<double>::of(unit, p.axes)).deceleration;
      CHECK(squares[i] >= 0);
    }
    CHECK(squares.sum() == Approx(1).epsilon(1e-13));
    CHECK(squares.dot(a) == Approx(p.energy_ratio()).epsilon(1e-12));
  }
}

TEST_CASE("equal torques leave the polhode alone, and each torque counts in proportion", "[deceleration]") {
  Bodies bodies(8);
  for (int trial = 0; trial < 100; ++trial) {
    const V a = bodies.inverse_inertia();
    const auto p = polhode_through<double>(a, bodies.vector());
    const auto equal = mean_torque<>(p, ControlTorques<double>{.7, .7, .7});
    CHECK(equal.escape == 0);
    CHECK(equal.deceleration == Approx(.7).epsilon(1e-13));
    const ControlTorques<double> b{.2, .5, .9}, c{.3, .1, .4}, both{.5, .6, 1.3};
    CHECK(mean_torque<>(p, both).escape ==
          Approx(mean_torque<>(p, b).escape + mean_torque<>(p, c).escape).epsilon(1e-11).margin(1e-13));
  }
}

TEST_CASE("the escape keeps its digits at both ends", "[deceleration]") {
  const V a(1 / 1.4, 1, 1 / .7);
  const auto family = polhode_through<double>(a, V(1, .1, .1));
  const ControlTorques<double> b{.6, .9, 1};
  for (double k2 = 1e-2; k2 > 1e-100; k2 *= 1e-7) {  // G = k2 (b1 - b3) - (b2 - b3) k2/2 + O(k2^2)
    const auto mean = mean_torque<>(at_modulus(family, {k2, 1 - k2}), b);
    CHECK(mean.escape == Approx(k2 * (-.4 + .05)).epsilon(k2 + 1e-14));
  }
  double before = infinity<double>;
  for (double kp2 = 1e-2; kp2 > 1e-100; kp2 *= 1e-7) {  // W -> 1, F -> 1/K: to the separatrix as (b1 - b3)/(K kp2)
    const auto mean = mean_torque<>(at_modulus(family, {1 - kp2, kp2}), b);
    const double limit = (b.near - b.far) / (kp2 * mean.K);
    CHECK(mean.escape == Approx(limit).epsilon(10 * kp2 * mean.K + 1e-14));
    CHECK(mean.escape < before);
    before = mean.escape;
  }
}

TEST_CASE("a body of revolution: the tilt instead of k2", "[deceleration]") {
  for (const V& a : {V(1, 1, 2), V(1, 2, 2)}) {
    const V M(.5, .3, .6);
    const auto p = polhode_through<double>(a, M);
    REQUIRE(p.axes.axisymmetric());
    const V b(.4, .7, 1.1);
    const auto mean = mean_torque<>(p, ControlTorques<double>::of(b.asDiagonal(), p.axes));
    const int n = p.axes.near, f = p.axes.far;
    const double along = M[n] * M[n] / M.squaredNorm();
    CHECK(mean.deceleration == Approx(b[n] * along + (b[1] + b[f]) / 2 * (1 - along)).epsilon(1e-14));
    // limit of the general body
    V close = a;
    close[1] += (a[2] - a[0]) * (a[0] == a[1] ? 1e-7 : -1e-7);
    const auto q = polhode_through<double>(close, M);
    const auto limit = mean_torque<>(q, ControlTorques<double>::of(b.asDiagonal(), q.axes));
    CHECK(limit.deceleration == Approx(mean.deceleration).epsilon(1e-6));
    CHECK(limit.escape / (q.modulus.k2 / q.modulus.kp2) == Approx(mean.escape / (p.tilt * (1 - p.tilt))).epsilon(1e-5));
  }
}

TEST_CASE("the averaged equations in their clock", "[deceleration]") {
  Bodies bodies(9);
  using Equations = AveragedEquations<math::Native, double>;
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = bodies.problem(1e-3);
    const double R = problem.momentum.norm();
    const auto p = polhode_through<double>(problem.inverse_inertia, problem.momentum);
    const Equations equations(p, problem.control, problem.drag, R);
    const auto y = equations.state_of(p, 1.5 * R, 3., 7.);
    CHECK(equations.norm(y) == Approx(1.5 * R).epsilon(1e-14));
    CHECK(equations.polhode(y).modulus.kp2 == Approx(p.modulus.kp2).epsilon(1e-13));
    CHECK(equations.polhode(y).modulus.k2 == Approx(p.modulus.k2).epsilon(1e-13));
    Equations::State dy;
    equations(0, y, dy);
    const auto mean = equations.torque(p);
    const double dt = dy[Equations::time];
    CHECK(dt > 0);
    CHECK(dy[Equations::log_norm] * dy[Equations::log_norm] + dy[Equations::spread] * dy[Equations::spread] ==
          Approx(1).epsilon(1e-12).margin(.5 * problem.drag * R / (problem.drag * R + mean.deceleration)));
    CHECK(dy[Equations::log_norm] / dt == Approx(-problem.drag - mean.deceleration / (1.5 * R)).epsilon(1e-12));
    CHECK(dy[Equations::spread] / dt == Approx(2 * mean.escape / (1.5 * R)).epsilon(1e-12));
    CHECK(dy[Equations::phase] / dt == Approx(1.5 * R * p.rate_per_momentum() / mean.K).epsilon(1e-12));
  }
}

TEST_CASE("a spin exactly on an axis has that axis's torque, whatever the moments are", "[deceleration]") {
  Bodies bodies(8);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto problem = bodies.problem(1);
    for (const int axis : {0, 2}) {
      V M = V::Zero();
      M[axis] = 1 + trial / 1000.;
      const auto p = polhode_through<double>(problem.inverse_inertia, M);
      const auto mean = mean_torque<>(p, ControlTorques<double>::of(problem.control, p.axes));
      CHECK(mean.deceleration == Approx(problem.control(axis, axis)).epsilon(1e-14));
      CHECK(mean.escape == 0);
    }
  }
}
