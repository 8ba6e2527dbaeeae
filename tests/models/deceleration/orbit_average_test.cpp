// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/orbit_average.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "reference_cases.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

namespace {

using V = Vec3<double>;
using VL = Vec3<long double>;

struct Scenes {
  std::mt19937_64 random{11};
  std::uniform_real_distribution<double> u{0, 1};
  std::normal_distribution<double> z;
  int trial = 0;

  V vector() { return {z(random), z(random), z(random)}; }

  /// All four pairs of laws, control matrices that are not diagonal, rotor momentum from 1e-3 to 10 times M.
  Problem<double> next() {
    ++trial;
    double J[3];
    do {
      for (double& j : J) j = .05 + u(random);
      std::sort(J, J + 3);
    } while (J[2] > J[0] + J[1]);
    Problem<double> p;
    p.inverse_inertia = {1 / J[2], 1 / J[1], 1 / J[0]};
    p.rotor_momentum = std::pow(10, 1 - 4 * u(random)) * vector();
    if (trial % 10 == 0) p.rotor_momentum.setZero();
    Mat3<double> b;
    b << vector(), vector(), vector();
    p.control = 1e-3 * (b * b.transpose() + Mat3<double>::Identity());
    p.drag = 3e-4 * u(random);
    p.law = trial % 2 == 0 ? Law::total : Law::carrier;
    p.drag_law = trial / 2 % 2 == 0 ? Law::total : Law::carrier;
    p.momentum = vector();
    return p;
  }
};

Problem<double> scene(const ReferenceCase& c) {
  Problem<double> p;
  p.inverse_inertia = V(c.J).cwiseInverse();
  p.rotor_momentum = V(c.l);
  p.control = (c.eps * V(c.b)).asDiagonal();
  p.drag = c.eps * c.lambda;
  p.law = p.drag_law = c.carrier ? Law::carrier : Law::total;
  p.momentum = V(c.M0);
  return p;
}

}  // namespace

TEST_CASE("averages are the means of the pointwise rates over a period", "[deceleration]") {
  Scenes scenes;
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto p = scenes.next();
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    if (orbit->modulus().kp2 < 1e-7) continue;
    const auto a = average(p, *orbit);
    REQUIRE(a);
    const int n = 512;
    double dR = 0, dh = 0, deta = 0, power = 0, force = 0;
    V M(0, 0, 0);
    for (int i = 0; i < n; ++i) {
      const V m = orbit->momentum_at((i + .5) / n);
      const V P = small_torque(p, m);
      const auto f = slow_rates(p, m, orbit->level().eta, P);
      dR += f.R / n;
      dh += f.h / n;
      deta += f.eta / n;
      M += m / n;
      force = std::max(force, P.norm());
      power = std::max(power, P.norm() * p.angular_velocity(m).norm());
    }
    const double R = p.momentum.norm();
    const double e = std::max({std::abs(a->rates.R - dR) / force, std::abs(a->rates.h - dh) / power,
                               R * std::abs(a->rates.eta - deta) / (power + std::abs(a->level.eta) * force),
                               (a->momentum - M).norm() / R});
    INFO(trial << " " << symbol(a->component.regime) << " kp2 " << a->modulus.kp2 << " nodes " << a->nodes);
    CHECK(e < 3e-12);
    worst = std::max(worst, e);
    CHECK(a->second_moment.trace() == Approx(R * R).epsilon(1e-11));
    CHECK(a->period == orbit->period());
    CHECK((a->nodes >= 16 && a->nodes <= 512));
    // by the level and the lobe alone
    const auto again = average(p, orbit->level(), orbit->component());
    REQUIRE(again);
    CHECK(again->rates.R == Approx(a->rates.R).epsilon(1e-14));
  }
  INFO(worst);
  CHECK(worst < 3e-12);
}

TEST_CASE("averages agree with time integrals of the rates in long double", "[deceleration]") {
  Scenes scenes;
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = scenes.next();
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    if (orbit->modulus().kp2 < 1e-3) continue;
    const auto a = average(p, *orbit);
    REQUIRE(a);
    Problem<long double> q;
    q.inverse_inertia = p.inverse_inertia.cast<long double>();
    q.rotor_momentum = p.rotor_momentum.cast<long double>();
    q.control = p.control.cast<long double>();
    q.drag = p.drag;
    q.law = p.law;
    q.drag_law = p.drag_law;
    const auto rhs = [&](long double, const std::array<long double, 5>& y, std::array<long double, 5>& d) noexcept {
      const VL m(y[0], y[1], y[2]);
      const VL f = m.cross(q.angular_velocity(m)), P = small_torque(q, m);
      d = {f[0], f[1], f[2], m.dot(P) / m.norm(), q.angular_velocity(m).dot(P)};
    };
    ode::StepControl<long double, 5> control;
    control.relative = 1e-14L;
    control.absolute.fill(1e-17L);
    ode::RungeKutta<long double, 5, decltype(rhs)> solver(rhs, 0.L, {p.momentum[0], p.momentum[1], p.momentum[2], 0, 0},
                                                          control);
    REQUIRE(solver.advance(orbit->period()) == ode::Status::reached);
    const double T = orbit->period(), force = p.control.norm() + p.drag * p.momentum.norm();
    CHECK(std::abs(double(solver.state()[3]) / T - a->rates.R) < 1e-9 * force);
    CHECK(std::abs(double(solver.state()[4]) / T - a->rates.h) <
          1e-9 * force * p.angular_velocity(p.momentum).norm() + 1e-9 * force);
  }
}

TEST_CASE("averaged motions of the reference", "[deceleration]") {
  for (const auto& c : reference_cases) {
    const auto p = scene(c);
    const auto start = Orbit<double>::through(p, p.momentum);
    REQUIRE(start);
    const Component component = start->component();
    int calls = 0;
    const auto rhs = [&](double, const std::array<double, 2>& y, std::array<double, 2>& d) noexcept {
      ++calls;
      const auto a = average(p, Level<double>{y[0], y[1]}, component);
      if (a) d = {a->rates.R, a->rates.eta};
      else d = {gyrostat::nan<double>, gyrostat::nan<double>};
    };
    ode::StepControl<double, 2> control;
    control.relative = 1e-12;
    control.absolute = {1e-13 * start->level().R, 1e-13 * std::abs(start->level().eta)};
    ode::RungeKutta<double, 2, decltype(rhs)> solver(rhs, 0., {start->level().R, start->level().eta}, control);
    const double h0 = *std::max_element(c.energy, c.energy + 6);
    for (int i = 0; i < 6; ++i) {
      INFO(c.id << " t " << c.t[i] << " calls " << calls);
      REQUIRE(solver.advance(c.t[i]) == ode::Status::reached);
      const Level<double> level{solver.state()[0], solver.state()[1]};
      CHECK(std::abs(level.R - c.norm[i]) < 1e-9 * start->level().R);
      CHECK(std::abs(energy_of(p, level) - c.energy[i]) < 1e-9 * h0);
    }
  }
}

TEST_CASE("equal torques along M: |M| decays as if there were no rotation", "[deceleration]") {
  Scenes scenes;
  for (int trial = 0; trial < 100; ++trial) {
    auto p = scenes.next();
    p.control = 2e-3 * Mat3<double>::Identity();
    p.law = p.drag_law = Law::total;
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    const auto a = average(p, *orbit);
    if (!a) continue;
    CHECK(a->rates.R == Approx(-2e-3 - p.drag * p.momentum.norm()).epsilon(1e-12));
  }
}

TEST_CASE("torques against the carrier take its energy", "[deceleration]") {
  Scenes scenes;
  for (int trial = 0; trial < 300; ++trial) {
    auto p = scenes.next();
    p.law = p.drag_law = Law::carrier;
    p.control = V(1e-3, 2e-3, 3e-3).asDiagonal();
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    const auto a = average(p, *orbit);
    if (!a) continue;
    const double h = energy_of(p, orbit->level());
    CHECK(a->rates.h < -2 * p.drag * h);
  }
}

TEST_CASE("half turns of the axes change nothing", "[deceleration]") {
  Scenes scenes;
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = scenes.next();
    const auto a = average(p, *Orbit<double>::through(p, p.momentum));
    if (!a) continue;
    for (int axis = 0; axis < 3; ++axis) {
      V s(-1, -1, -1);
      s[axis] = 1;
      auto q = p;
      q.rotor_momentum = s.cwiseProduct(p.rotor_momentum);
      q.momentum = s.cwiseProduct(p.momentum);
      q.control = s.asDiagonal() * p.control * s.asDiagonal();
      const auto b = average(q, *Orbit<double>::through(q, q.momentum));
      REQUIRE(b);
      CHECK(b->rates.R == Approx(a->rates.R).epsilon(1e-9));
      CHECK(b->rates.h == Approx(a->rates.h).epsilon(1e-9).margin(1e-14));
    }
  }
}

TEST_CASE("at an equilibrium the average is the value", "[deceleration]") {
  Scenes scenes;
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = scenes.next();
    const auto orbit = Orbit<double>::at(p, {1., -1e3 * (1 + p.gyro_rate().norm())}, {});
    REQUIRE(orbit);
    REQUIRE(orbit->regime() == Regime::point);
    const auto a = average(p, *orbit);
    REQUIRE(a);
    const V M = orbit->momentum_at(0);
    const auto f = slow_rates(p, M, orbit->level().eta, small_torque(p, M));
    CHECK(a->rates.R == Approx(f.R).epsilon(1e-11));
    CHECK(a->rates.h == Approx(f.h).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("close to the separatrix the averages still converge", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = {1 / 1.4, 1, 1 / .7};
  p.rotor_momentum = {.03, .02, .01};
  p.control = V(.6e-3, .9e-3, 1e-3).asDiagonal();
  const Secular<double> q(p.inverse_inertia, p.gyro_rate(), 1.);
  const double saddle = q.level(q.rise(0).hi);
  for (int k = 2; k <= 12; ++k) {
    const auto a = average(p, Level<double>{1., saddle - std::pow(10, -k)}, {Regime::about_largest, 1});
    INFO(k << " " << message(a.error()));
    REQUIRE(a);
    CHECK(a->error < 1e-9);
    CHECK(a->nodes <= 512);
  }
}
