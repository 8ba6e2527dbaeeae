// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/capture.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

namespace {

using V = Vec3<double>;

/// Enters the lobes around axis 1 from one component: found at random.
Problem<double> entering(double eps) {
  Problem<double> p;
  p.inverse_inertia = {1 / .533504, 1 / .426988, 1 / .180226};
  p.rotor_momentum = {.0114535, .00899714, .0519957};
  p.control = (eps * V(.219935, .587234, .648088)).asDiagonal();
  p.drag = .3 * eps;
  return p;
}

const CriticalLevel<double>* find(const CriticalLevels<double>& all, Critical kind, Regime lobes) {
  for (int i = 0; i < all.count; ++i) {
    const auto& c = all.level[std::size_t(i)];
    if (c.kind == kind && c.lobes == lobes) return &c;
  }
  return nullptr;
}

/// The full equations of M.
struct FullRate {
  const Problem<double>& problem;
  void operator()(double, const std::array<double, 3>& y, std::array<double, 3>& d) const noexcept {
    const V M(y[0], y[1], y[2]);
    const V f = M.cross(problem.angular_velocity(M)) + small_torque(problem, M);
    d = {f[0], f[1], f[2]};
  }
};
ode::RungeKutta<double, 3, FullRate> full_motion(const Problem<double>& problem, const V& M) {
  ode::StepControl<double, 3> control;
  control.relative = 1e-9;
  control.absolute.fill(1e-11);
  return {FullRate{problem}, 0., {M[0], M[1], M[2]}, control};
}

}  // namespace

TEST_CASE("critical levels are in order, and equilibria lie on them", "[deceleration]") {
  std::mt19937_64 random(3);
  std::normal_distribution<double> z;
  std::uniform_real_distribution<double> u(0, 1);
  int six = 0, two = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Problem<double> p;
    p.inverse_inertia = {1 + u(random), 2.5 + u(random), 4 + u(random)};
    p.rotor_momentum = std::pow(10, .5 - 2 * u(random)) * V(z(random), z(random), z(random));
    const double R = .5 + u(random);
    const auto all = critical_levels(p, R);
    REQUIRE(all);
    CHECK((all->count == 2 || all->count == 4 || all->count == 6));
    six += all->count == 6;
    two += all->count == 2;
    for (int i = 1; i < all->count; ++i) CHECK(all->level[std::size_t(i)].eta >= all->level[std::size_t(i - 1)].eta);
    // no momentum has less or more energy
    for (int k = 0; k < 20; ++k) {
      const V M = R * V(z(random), z(random), z(random)).normalized();
      const double eta = level_of(p, M).eta;
      CHECK(eta >= all->level[0].eta - 1e-12);
      CHECK(eta <= all->level[0].eta + all->range() + 1e-12);
    }
    const double d = 1e-5 * R;
    for (int i = 0; i < all->count; ++i) {
      const auto& c = all->level[std::size_t(i)];
      // omega = sigma M
      V M;
      for (int j = 0; j < 3; ++j) M[j] = p.gyro_rate()[j] / (p.inverse_inertia[j] - c.sigma);
      if (std::abs(M.norm() - R) < 1e-6) CHECK(level_of(p, M).eta == Approx(c.eta).margin(1e-8));
      const auto up = critical_levels(p, R + d), down = critical_levels(p, R - d);
      if (up->count == all->count && down->count == all->count) {
        const auto k = std::size_t(i);
        CHECK(c.slope(R) == Approx((up->level[k].eta - down->level[k].eta) / (2 * d)).epsilon(1e-4).margin(1e-4));
      }
    }
    // the type of an orbit is that of its band
    const double eta = all->level[0].eta + u(random) * all->range();
    const auto band = band_of(p, Level<double>{R, eta});
    REQUIRE(band);
    CHECK(band->below.eta <= eta);
    CHECK(band->above.eta >= eta);
    const bool lobes = band->below.lobes == band->above.lobes && band->below.lobes != Regime::one_component;
    const auto o = Orbit<double>::at(p, {R, eta}, lobes ? Component{band->below.lobes, 1} : Component{});
    REQUIRE(o);
    CHECK(o->regime() == (lobes ? band->below.lobes : Regime::one_component));
  }
  CHECK(six > 50);
  CHECK(two > 50);
}

TEST_CASE("critical levels that overflow are refused", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = {.5, 1, 1.7};
  p.rotor_momentum = {.1, .2, .05};
  CHECK(critical_levels(p, 1e100));
  CHECK(critical_levels(p, 1e200).error() == Errc::not_finite);
}

TEST_CASE("without rotor momentum both pairs share the saddle", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = {1, 2, 4};
  const auto all = critical_levels(p, 3.);
  REQUIRE(all);
  REQUIRE(all->count == 6);
  CHECK(all->level[0].eta == Approx(1.5));
  CHECK(all->level[1].eta == Approx(1.5));
  CHECK(all->level[2].eta == Approx(3));
  CHECK(all->level[3].eta == Approx(3));
  CHECK(all->level[5].eta == Approx(6));
  CHECK(band_of(p, Level<double>{3., 2.9})->separatrix_distance() == Approx(.1 / 4.5));
  // about the principal axes of both ends, where an equilibrium is born and is stable in one level
  for (const double rounding : {-1e-15, 0., 1e-15, 1e-9}) {
    CAPTURE(rounding);
    CHECK(band_of(p, Level<double>{3., 1.5 + rounding})->separatrix_distance() == Approx(1.5 / 4.5));
    CHECK(band_of(p, Level<double>{3., 6 - rounding})->separatrix_distance() == Approx(3 / 4.5));
  }
  CHECK(capture(p, 3., Regime::about_smallest, Component{Regime::about_largest, 1}).error() == Errc::not_applicable);
}

TEST_CASE("capture probabilities are those of motions spread over the energy", "[deceleration]") {
  const double eps = 1e-3;
  const auto p = entering(eps);
  const auto predicted = capture(p, 1., Regime::about_largest, Component{});
  REQUIRE(predicted);
  CHECK(predicted->plus == Approx(.6067).margin(1e-3));
  CHECK(predicted->plus + predicted->minus == Approx(1));
  CHECK_FALSE(predicted->determined());
  // the probabilities do not depend on the size of the torques
  CHECK(capture(entering(1e-5), 1., Regime::about_largest, Component{})->plus == Approx(predicted->plus).epsilon(1e-6));

  const auto levels = critical_levels(p, 1.);
  const auto* saddle = find(*levels, Critical::saddle, Regime::about_largest);
  REQUIRE(saddle);
  const double turn = predicted->inflow_plus + predicted->inflow_minus;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> u(0, 1);
  const int runs = 600;
  int caught[2] = {0, 0};
  for (int run = 0; run < runs; ++run) {
    const auto o = Orbit<double>::at(p, {1., saddle->eta + turn * (2 + 2 * u(random))}, Component{});
    REQUIRE(o);
    const V M = o->momentum_at(u(random));
    auto solver = full_motion(p, M);
    for (int step = 0; step < 5000; ++step) {
      REQUIRE(solver.step(1e9) == ode::Status::reached);
      const V m(solver.state()[0], solver.state()[1], solver.state()[2]);
      const auto level = level_of(p, m);
      const auto band = band_of(p, level);
      REQUIRE(band);
      if (band->above.kind != Critical::saddle || band->above.lobes != Regime::about_largest) continue;
      if (band->above.eta - level.eta < .7 * turn) continue;
      ++caught[Orbit<double>::through(p, m)->branch() > 0];
      break;
    }
  }
  CHECK(caught[0] + caught[1] == runs);
  CHECK(double(caught[1]) / runs == Approx(predicted->plus).margin(3.5 * .5 / std::sqrt(runs)));
}

TEST_CASE("leaving the lobes is determined", "[deceleration]") {
  // torques of the opposite sign run the entering scene backwards
  auto p = entering(1e-3);
  p.control *= -1;
  p.drag *= -1;
  for (const int branch : {1, -1}) {
    const auto c = capture(p, 1., Regime::about_largest, Component{Regime::about_largest, branch});
    REQUIRE(c);
    CHECK(c->determined());
    CHECK(c->outside == 1);
  }
  // and from outside the separatrix is not reached
  CHECK(capture(p, 1., Regime::about_largest, Component{}).error() == Errc::undetermined);
}

TEST_CASE("a motion that leaves a lobe is caught by the other one as often as predicted", "[deceleration]") {
  Problem<double> p;
  p.inverse_inertia = {1 / 1.25734996, 1 / 1.25734989, 1 / 0.078985};
  p.rotor_momentum = {-0.826, 1.285, 0.437};
  p.control = 1e-5 * Mat3<double>::Identity();
  const auto from = Component{Regime::about_smallest, 1};
  const auto predicted = capture(p, 1.0076, Regime::about_smallest, from);
  REQUIRE(predicted);
  CHECK(predicted->inflow_plus < 0);
  CHECK(predicted->inflow_minus > 0);
  CHECK_FALSE(predicted->determined());
  CHECK(predicted->minus + predicted->outside == Approx(1));
  const auto levels = critical_levels(p, 1.0076);
  const auto* saddle = find(*levels, Critical::saddle, Regime::about_smallest);
  REQUIRE(saddle);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> u(0, 1);
  const double turn = -predicted->inflow_plus, back = predicted->inflow_minus;
  const int runs = 300;
  int caught = 0, left = 0;
  for (int run = 0; run < runs; ++run) {
    const auto o = Orbit<double>::at(p, {1.0076, saddle->eta + turn * (2 + 2 * u(random))}, from);
    REQUIRE(o);
    const V M = o->momentum_at(u(random));
    auto solver = full_motion(p, M);
    for (int step = 0; step < 20'000; ++step) {
      REQUIRE(solver.step(1e9) == ode::Status::reached);
      const V m(solver.state()[0], solver.state()[1], solver.state()[2]);
      const auto level = level_of(p, m);
      const auto now = critical_levels(p, level.R);
      REQUIRE(now);
      const auto* edge = find(*now, Critical::saddle, Regime::about_smallest);
      REQUIRE(edge);
      const double inside = level.R * (level.eta - edge->eta);
      if (inside < -1.5 * back) {
        ++left;
        break;
      }
      if (!(inside > 0.3 * back)) continue;
      if (const auto at = Orbit<double>::through(p, m); at && at->branch() < 0) {
        ++caught;
        break;
      }
    }
  }
  CAPTURE(predicted->minus, caught, left);
  CHECK(caught + left == runs);
  CHECK(double(caught) / runs == Approx(predicted->minus).margin(3.5 * .5 / std::sqrt(runs)));
}

TEST_CASE("inflow is the loss of energy against the saddle over a loop", "[deceleration]") {
  // by time integration over the lobe's orbit close to the separatrix
  const auto p = entering(1e-3);
  const auto c = capture(p, 1., Regime::about_largest, Component{});
  REQUIRE(c);
  const auto levels = critical_levels(p, 1.);
  const auto* saddle = find(*levels, Critical::saddle, Regime::about_largest);
  for (const int branch : {1, -1}) {
    const auto o = Orbit<double>::at(p, {1., saddle->eta - 1e-6}, {Regime::about_largest, branch});
    REQUIRE(o);
    double sum = 0;
    const int n = 4000;
    for (int i = 0; i < n; ++i) {
      const V M = o->momentum_at(double(i) / n), P = small_torque(p, M);
      sum -= (p.angular_velocity(M) - saddle->sigma * M).dot(P) * o->period() / n;
    }
    CHECK(sum == Approx(branch > 0 ? c->inflow_plus : c->inflow_minus).epsilon(1e-4));
  }
}

TEST_CASE("no lobes, no capture", "[deceleration]") {
  auto p = entering(1e-3);
  p.rotor_momentum *= 100;
  CHECK(critical_levels(p, 1.)->count == 2);
  CHECK(capture(p, 1., Regime::about_largest, Component{}).error() == Errc::not_applicable);
  CHECK(critical_levels(p, 0.).error() == Errc::not_positive);
  CHECK(critical_levels(p, gyrostat::nan<double>).error() == Errc::not_finite);
  p.inverse_inertia = {1, 1, 1};
  CHECK(critical_levels(p, 1.).error() == Errc::not_applicable);
}

TEST_CASE("averaged motions pass births and separatrices and stay with the full equations", "[deceleration]") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> z;
  std::uniform_real_distribution<double> u(0, 1);
  int entered = 0, changes = 0, compared = 0;
  for (int trial = 0; trial < 80; ++trial) {
    Problem<double> p;
    p.inverse_inertia = {1 + u(random), 2.5 + u(random), 4 + u(random)};
    p.rotor_momentum = std::pow(10, -.5 - 1.5 * u(random)) * V(z(random), z(random), z(random));
    p.control = (2e-4 * V(.2 + u(random), .2 + u(random), .2 + u(random))).asDiagonal();
    p.drag = 1e-4;
    if (trial % 2 == 1) p.law = p.drag_law = Law::carrier;
    p.momentum = V(z(random), z(random), z(random)).normalized();

    const auto start = Orbit<double>::through(p, p.momentum);
    REQUIRE(start);
    Component component = start->component();
    bool determined = true;
    const auto rhs = [&](double, const std::array<double, 2>& y, std::array<double, 2>& d) noexcept {
      const auto a = average(p, Level<double>{y[0], y[1]}, component);
      if (a) d = {a->rates.R, a->rates.eta};
      else d.fill(gyrostat::nan<double>);
    };
    const double R0 = start->level().R, h0 = p.energy(p.momentum);
    ode::StepControl<double, 2> control;
    control.relative = 1e-8;
    control.absolute = {1e-9 * R0, 1e-9};
    ode::RungeKutta<double, 2, decltype(rhs)> solver(rhs, 0., {R0, start->level().eta}, control);
    for (int step = 0; step < 2000; ++step) {
      const auto status = solver.step(1e9);
      Level<double> level{solver.state()[0], solver.state()[1]};
      if (status != ode::Status::reached) {
        // no step leads into the lobes: the separatrix
        const auto band = band_of(p, level);
        REQUIRE(band);
        REQUIRE(band->separatrix_distance() < 1e-3);
        const bool under = band->below.kind == Critical::saddle &&
                           !(band->above.kind == Critical::saddle && band->to_above < band->to_below);
        const auto& saddle = under ? band->below : band->above;
        const auto c = capture(p, level.R, saddle.lobes, component);
        REQUIRE(c);
        determined = determined && c->determined();
        const double inwards = saddle.lobes == Regime::about_largest ? -1 : 1;
        component = c->outside == 1 ? Component{} : Component{saddle.lobes, c->plus > c->minus ? 1 : -1};
        level.eta = saddle.eta + (c->outside == 1 ? -inwards : inwards) * std::abs(level.eta - saddle.eta);
        solver.restart(solver.time(), {level.R, level.eta});
        ++entered;
        continue;
      }
      const auto o = Orbit<double>::at(p, level, component);
      REQUIRE(o);
      if (o->regime() == Regime::point) continue;
      changes += o->regime() != component.regime;
      component = o->component();
      if (level.R < .1 * R0 || energy_of(p, level) < .05 * h0) break;
    }
    CHECK(
        (solver.state()[0] < .1 * R0 || energy_of(p, Level<double>{solver.state()[0], solver.state()[1]}) < .05 * h0));
    if (!determined) continue;

    ++compared;
    const auto full = [&](double, const std::array<double, 3>& y, std::array<double, 3>& d) noexcept {
      const V M(y[0], y[1], y[2]);
      const V f = M.cross(p.angular_velocity(M)) + small_torque(p, M);
      d = {f[0], f[1], f[2]};
    };
    ode::StepControl<double, 3> fine;
    fine.relative = 1e-9;
    fine.absolute.fill(1e-11);
    fine.step_cap = 1000000;
    ode::RungeKutta<double, 3, decltype(full)> direct(full, 0., {p.momentum[0], p.momentum[1], p.momentum[2]}, fine);
    REQUIRE(direct.advance(solver.time()) == ode::Status::reached);
    const V M(direct.state()[0], direct.state()[1], direct.state()[2]);
    INFO(trial << " R " << solver.state()[0] / R0);
    CHECK(std::abs(M.norm() - solver.state()[0]) < .02 * R0);
    CHECK(std::abs(p.energy(M) - energy_of(p, Level<double>{solver.state()[0], solver.state()[1]})) < .03 * h0);
  }
  CAPTURE(entered, changes, compared);
  CHECK(entered >= 3);
  CHECK(changes > 20);
  CHECK(compared > 10);
}
