// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/orbit_second_order.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

namespace {

using V = Vec3<double>;

Problem<double> generic(Law law) {
  Problem<double> p;
  p.inverse_inertia = {1 / 1.4, 1, 1 / .7};
  p.rotor_momentum = {.2, .15, .3};
  p.control = V(.6, .9, 1).asDiagonal();
  p.drag = .3;
  p.law = p.drag_law = law;
  p.momentum = {.8, .5, .33};
  return p;
}

struct Gaps {
  double first_M = 0, first_h = 0, second_M = 0, second_h = 0, vector = 0;
};

/// Greatest differences from the full equations over a time, as fractions of |M(0)| and of the greatest h.
Gaps gaps(Problem<double> p, double eps, double tau) {
  p.control *= eps;
  p.drag *= eps;
  const double end = tau / eps, R0 = p.momentum.norm();
  const auto full = [&](double, const std::array<double, 3>& y, std::array<double, 3>& d) noexcept {
    const V M(y[0], y[1], y[2]);
    const V f = M.cross(p.angular_velocity(M)) + small_torque(p, M);
    d = {f[0], f[1], f[2]};
  };
  Orbit<double> track;
  const auto mean = mean_of(p, p.momentum, &track);
  REQUIRE(mean);
  const Level<double> start = track.level();
  const Component component = mean->component;
  const auto first = [&](double, const std::array<double, 2>& y, std::array<double, 2>& d) noexcept {
    const auto a = average(p, Level<double>{y[0], y[1]}, component);
    d = a ? std::array{a->rates.R, a->rates.eta} : std::array{gyrostat::nan<double>, gyrostat::nan<double>};
  };
  const auto second = [&](double, const std::array<double, 3>& y, std::array<double, 3>& d) noexcept {
    const auto a = second_order(p, Level<double>{y[0], y[1]}, component, &track);
    if (a) d = {a->first.R + a->second.R, a->first.eta + a->second.eta, a->phase_rate};
    else d.fill(gyrostat::nan<double>);
  };
  ode::StepControl<double, 3> fine;
  fine.relative = 1e-13;
  fine.absolute.fill(1e-14);
  fine.step_cap = 1000000;
  ode::RungeKutta<double, 3, decltype(full)> direct(full, 0., {p.momentum[0], p.momentum[1], p.momentum[2]}, fine);
  ode::StepControl<double, 2> control;
  control.relative = 1e-11;
  ode::RungeKutta<double, 2, decltype(first)> one(first, 0., {start.R, start.eta}, control);
  ode::StepControl<double, 3> with_phase;
  with_phase.relative = 1e-11;
  with_phase.absolute = {1e-12, 1e-12, 1e-7};
  ode::RungeKutta<double, 3, decltype(second)> two(second, 0., {mean->level.R, mean->level.eta, mean->phase},
                                                   with_phase);

  Gaps g;
  double h0 = 0;
  const int outputs = 200;
  for (int i = 1; i <= outputs; ++i) {
    const double t = end * i / outputs;
    REQUIRE(direct.advance(t) == ode::Status::reached);
    REQUIRE(one.advance(t) == ode::Status::reached);
    REQUIRE(two.advance(t) == ode::Status::reached);
    const V M(direct.state()[0], direct.state()[1], direct.state()[2]);
    h0 = std::max(h0, p.energy(M));
    const Level<double> level{two.state()[0], two.state()[1]};
    const auto v = osculating_of(p, MeanLevel<double>{level, two.state()[2], component}, &track);
    REQUIRE(v);
    track = Orbit<double>::at(p, level, component)->aligned_to(track);
    g.first_M = std::max(g.first_M, std::abs(one.state()[0] - M.norm()) / R0);
    g.first_h =
        std::max(g.first_h, std::abs(energy_of(p, Level<double>{one.state()[0], one.state()[1]}) - p.energy(M)));
    g.second_M = std::max(g.second_M, std::abs(v->norm() - M.norm()) / R0);
    g.second_h = std::max(g.second_h, std::abs(p.energy(*v) - p.energy(M)));
    g.vector = std::max(g.vector, (*v - M).norm() / R0);
  }
  g.first_h /= h0;
  g.second_h /= h0;
  return g;
}

/// Slope of log error over log eps from 1e-3 to 1e-4, and 1e-2 to 1e-3 where the last is at rounding.
double slope(double coarse, double fine) { return std::log10(coarse / fine); }

}  // namespace

TEST_CASE("orders of averaging with rotor momentum", "[deceleration]") {
  struct Case {
    const char* name;
    Problem<double> problem;
    double tau;
  };
  auto lobe = generic(Law::total);
  lobe.rotor_momentum *= .1;
  lobe.momentum = {.9, .3, .2};
  auto planar = generic(Law::total);
  planar.rotor_momentum[0] = 0;
  for (const auto& c : {Case{"law total", generic(Law::total), .6}, Case{"law carrier", generic(Law::carrier), .5},
                        Case{"two components", lobe, .6}, Case{"l1 = 0", planar, .6}}) {
    INFO(c.name);
    const Gaps a = gaps(c.problem, 1e-3, c.tau), b = gaps(c.problem, 1e-4, c.tau);
    CHECK(slope(a.first_M, b.first_M) == Approx(1).margin(.15));
    CHECK(slope(a.first_h, b.first_h) == Approx(1).margin(.15));
    CHECK(slope(a.second_M, b.second_M) == Approx(2).margin(.15));
    CHECK(slope(a.second_h, b.second_h) == Approx(2).margin(.15));
    CHECK(slope(a.vector, b.vector) == Approx(1).margin(.25));
    CHECK(b.second_M < 1e-7);
    CHECK(b.vector < 2e-4);
  }
}

TEST_CASE("f2 by gradients along the torque", "[deceleration]") {
  // the definition, by displaced momenta: f2 = -<P.grad U>, drift = <P.grad phase>
  for (const Law law : {Law::total, Law::carrier}) {
    auto p = generic(law);
    p.control *= 1e-3;
    p.drag *= 1e-3;
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    const auto r = second_order(p, orbit->level(), orbit->component(), &*orbit);
    REQUIRE(r);
    const auto U = [&](const V& M, double& phase) {
      const auto o = Orbit<double>::through(p, M)->aligned_to(*orbit);
      OrbitOscillation<double> u;
      REQUIRE(second_order(p, o.level(), o.component(), &*orbit, &u));
      phase = o.phase_of(M);
      return u.slow(phase);
    };
    SlowRates<double> sum;
    double drift = 0;
    const int n = 32;
    for (int i = 0; i < n; ++i) {
      const V M = orbit->momentum_at(double(i) / n), P = small_torque(p, M);
      const double q = 1e-4 / P.norm();
      double up, down;
      const auto a = U(M + q * P, up), b = U(M - q * P, down);
      sum.R -= (a.R - b.R) / (2 * q * n);
      sum.eta -= (a.eta - b.eta) / (2 * q * n);
      drift += (up - down - std::round(up - down)) / (2 * q * n);
    }
    CHECK(r->second.R == Approx(sum.R).epsilon(1e-5));
    CHECK(r->second.eta == Approx(sum.eta).epsilon(1e-5));
    CHECK(r->phase_drift == Approx(drift).epsilon(1e-5));
    CHECK(r->second.h == Approx(orbit->level().R * r->second.eta + orbit->level().eta * r->second.R));
  }
  // the same by an independent program
  auto p = generic(Law::total);
  const auto orbit = Orbit<double>::through(p, p.momentum);
  const auto r = second_order(p, orbit->level(), orbit->component());
  REQUIRE(r);
  CHECK(r->second.R == Approx(-0.123186198).epsilon(1e-6));
  CHECK(r->second.h == Approx(-0.068381839).epsilon(1e-6));
  CHECK(r->phase_drift == Approx(-0.09033966).epsilon(1e-5));
}

TEST_CASE("without rotor momentum along one axis f2 and the drift vanish, or change sign with the lobe",
          "[deceleration]") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> z;
  int compared = 0, exchanged = 0;
  for (int trial = 0; trial < 90; ++trial) {
    auto p = generic(trial % 2 == 0 ? Law::total : Law::carrier);
    p.rotor_momentum = .3 * V(z(random), z(random), z(random));
    p.rotor_momentum[trial % 3] = 0;
    p.control *= 1e-3;
    p.drag *= 1e-3;
    p.momentum = V(z(random), z(random), z(random));
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    const auto r = second_order(p, orbit->level(), orbit->component());
    if (!r || orbit->modulus().kp2 < 1e-2) continue;
    // against the size of what is averaged
    const double scale = r->second_oscillation.R / r->orbit.period(), turns = r->phase_oscillation / r->orbit.period();
    const auto component = orbit->component();
    const int around = component.regime == Regime::about_largest    ? 0
                       : component.regime == Regime::about_smallest ? 2
                                                                    : -1;
    if (around != trial % 3) {
      ++compared;
      CHECK(std::abs(r->second.R) < 1e-5 * scale);
      CHECK(std::abs(r->phase_drift) < 1e-5 * turns);
    } else {
      // time reversal exchanges the lobes: f2 changes its sign from one to the other
      ++exchanged;
      const auto other = second_order(p, orbit->level(), Component{component.regime, -component.branch});
      REQUIRE(other);
      CHECK(std::abs(r->second.R + other->second.R) < 1e-5 * scale);
      CHECK(std::abs(r->phase_drift + other->phase_drift) < 1e-5 * turns);
    }
  }
  CHECK(compared > 30);
  CHECK(exchanged > 3);
}

TEST_CASE("oscillations scale with the torques and bound the gaps", "[deceleration]") {
  auto p = generic(Law::total);
  p.control *= 1e-3;
  p.drag *= 1e-3;
  const auto orbit = Orbit<double>::through(p, p.momentum);
  const auto a = second_order(p, orbit->level(), orbit->component());
  p.control *= 2;
  p.drag *= 2;
  const auto b = second_order(p, orbit->level(), orbit->component());
  REQUIRE(a);
  REQUIRE(b);
  CHECK(b->first.R == Approx(2 * a->first.R));
  CHECK(b->oscillation.R == Approx(2 * a->oscillation.R));
  CHECK(b->phase_oscillation == Approx(2 * a->phase_oscillation));
  CHECK(b->second.R == Approx(4 * a->second.R));
  CHECK(b->second_oscillation.eta == Approx(4 * a->second_oscillation.eta));
  CHECK(b->phase_rate - b->phase_drift == Approx(1 / orbit->period()));
}

TEST_CASE("mean and osculating states are inverse to second order", "[deceleration]") {
  double before = 0;
  for (const double eps : {1e-2, 1e-3, 1e-4}) {
    auto p = generic(Law::carrier);
    p.control *= eps;
    p.drag *= eps;
    Orbit<double> orbit;
    const auto mean = mean_of(p, p.momentum, &orbit);
    REQUIRE(mean);
    const auto back = osculating_of(p, *mean, &orbit);
    REQUIRE(back);
    const double gap = (*back - p.momentum).norm();
    CHECK(gap < 5 * eps * eps);
    if (before > 0) CHECK(std::log10(before / gap) == Approx(2).margin(.3));
    before = gap;
  }
}

TEST_CASE("where second order does not apply it says so", "[deceleration]") {
  auto p = generic(Law::total);
  p.control *= 1e-3;
  CHECK(second_order(p, Level<double>{1., -100.}, Component{}).error() == Errc::not_applicable);
  CHECK(second_order(p, Level<double>{0., 1.}, Component{}).error() == Errc::zero_vector);
  // on the doorstep of a separatrix
  p.rotor_momentum *= .1;
  const Secular<double> q(p.inverse_inertia, p.gyro_rate(), 1.);
  const double saddle = q.level(q.rise(0).hi);
  for (int k = 2; k < 15; ++k) {
    const auto r = second_order(p, Level<double>{1., saddle - std::pow(10, -k)}, Component{Regime::about_largest, 1});
    INFO(k << " " << message(r.error()));
    if (r) {
      CHECK(std::isfinite(r->second.R));
      CHECK(std::isfinite(r->phase_rate));
      CHECK(r->second_oscillation.R >= 0);
    } else {
      CHECK(k > 5);
    }
  }
}

TEST_CASE("random scenes: a number or a reason", "[deceleration]") {
  std::mt19937_64 random(9);
  std::normal_distribution<double> z;
  std::uniform_real_distribution<double> u(0, 1);
  int answered = 0;
  const int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    auto p = generic(trial % 2 == 0 ? Law::total : Law::carrier);
    p.inverse_inertia = {1 + u(random), 2.2 + u(random), 3.5 + u(random)};
    p.rotor_momentum = std::pow(10, 1 - 3 * u(random)) * V(z(random), z(random), z(random));
    p.control *= 1e-3;
    p.drag *= 1e-3;
    p.momentum = V(z(random), z(random), z(random));
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    const auto r = second_order(p, orbit->level(), orbit->component(), &*orbit);
    if (!r) continue;
    ++answered;
    CHECK((std::isfinite(r->second.R) && std::isfinite(r->second.eta) && std::isfinite(r->phase_drift)));
  }
  CHECK(answered > trials * 9 / 10);
}
