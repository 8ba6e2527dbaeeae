// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/orbit_motion.hpp"

#include "allocations.hpp"
#include "at_length.hpp"
#include "gyrostat/ladder/deceleration/averaged_motion.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

using Averages = FirstOrderRates<math::Native>;
using OrbitRun = OrbitMotion<Averages, double>;

constexpr auto no_one = [](const Level<double>&, Component, double) {};

OrbitRun orbit_run_of(const Problem<double>& p, double tolerance = 1e-12) {
  const auto orbit = Orbit<double>::through(p, p.momentum);
  REQUIRE(orbit);
  return {p, orbit->level(), orbit->component(), 0, tolerance, infinity<double>};
}

Problem<double> gyrostat_of(V l, Law law = Law::total, double eps = 1e-3) {
  Problem<double> p;
  p.inverse_inertia = V(1.4, 1, .7).cwiseInverse();
  p.control = (eps * V(.6, .9, 1)).asDiagonal();
  p.drag = .3 * eps;
  p.momentum = V(.8, .5, .33);
  p.rotor_momentum = l;
  p.law = p.drag_law = law;
  return p;
}

}  // namespace

TEST_CASE("orbit motion: the reference cases, with rotor and without", "[deceleration]") {
  int checked = 0;
  for (const auto& c : reference::cases()) {
    CAPTURE(c.id);
    if (c.id == "P05") continue;  // through the separatrix between the two regimes without rotor: another file
    const Problem<double> p = c.scene().problem();
    OrbitRun motion = orbit_run_of(p);
    for (std::size_t i = 0; i < c.data.times.size(); ++i) {
      REQUIRE(motion.advance(c.data.times[i], 0, no_one) == ode::Status::reached);
      const auto now = motion.sample();
      CHECK(now.level.R == Approx(c.norm[i]).epsilon(1e-9));
      CHECK(energy_of(p, now.level) == Approx(c.energy[i]).epsilon(1e-8));
      CHECK_FALSE(now.at_rest);
    }
    ++checked;
  }
  CHECK(checked == 11);
}

TEST_CASE("orbit motion: without rotor it is the averaged motion", "[deceleration]") {
  for (const V& M : {V(.8, .5, .33), V(.3, .5, .8)}) {
    auto p = gyrostat_of(V(0, 0, 0));
    p.momentum = M;
    p.control = 1e-3 * (M[0] > .5 ? V(.6, .9, 1) : V(1, .9, .6)).asDiagonal().toDenseMatrix();
    OrbitRun orbits = orbit_run_of(p);
    AveragedMotion<math::Native, double> polhodes(p, polhode_through<double>(p.inverse_inertia, M), M.norm(), 0, 1e-12,
                                                  infinity<double>);
    for (const double t : {200., 600., 900.}) {
      REQUIRE(orbits.advance(t, 0, no_one) == ode::Status::reached);
      REQUIRE(polhodes.advance(t, 0, [](const auto&, double) {}) == ode::Status::reached);
      const auto s = polhodes.state();
      CHECK(orbits.sample().level.R == Approx(s.norm).epsilon(1e-10));
      CHECK(energy_of(p, orbits.sample().level) ==
            Approx(s.norm * s.norm * s.polhode.energy_ratio() / 2).epsilon(1e-9));
    }
    CHECK(*orbits.stop_time(no_one) == Approx(*polhodes.stop_time()).epsilon(1e-6));
  }
}

TEST_CASE("orbit motion: equal torques have a closed |M| with any rotor", "[deceleration]") {
  auto p = gyrostat_of(V(.2, .15, .3));
  p.control = 1e-3 * Mat3<double>::Identity();
  OrbitRun motion = orbit_run_of(p);
  const double R = p.momentum.norm(), b = 1e-3, drag = p.drag;
  for (const double t : {100., 500.}) {
    REQUIRE(motion.advance(t, 0, no_one) == ode::Status::reached);
    CHECK(motion.sample().level.R == Approx((R + b / drag) * std::exp(-drag * t) - b / drag).epsilon(1e-11));
  }
  const auto stop = motion.stop_time(no_one);
  REQUIRE(stop);
  CHECK(*stop == Approx(std::log1p(drag * R / b) / drag).epsilon(1e-6));
  REQUIRE(motion.advance(2 * *stop, 0, no_one) == ode::Status::reached);
  CHECK(motion.sample().at_rest);
}

TEST_CASE("orbit motion: the carrier's laws drain the carrier's energy to zero", "[deceleration]") {
  const auto p = gyrostat_of(V(.2, .15, .3), Law::carrier);
  OrbitRun motion = orbit_run_of(p);
  double before = infinity<double>;
  for (const double t : {100., 300., 500.}) {
    REQUIRE(motion.advance(t, 0, no_one) == ode::Status::reached);
    const double h = energy_of(p, motion.sample().level);
    CHECK(h < before);
    CHECK(h > 0);
    before = h;
  }
  const auto stop = motion.stop_time(no_one);
  REQUIRE(stop);
  REQUIRE(motion.advance(*stop * .999, 0, no_one) == ode::Status::reached);
  CHECK(motion.sample().level.R == Approx(p.rotor_momentum.norm()).epsilon(2e-3));
}

TEST_CASE("orbit motion: a floor ends it", "[deceleration]") {
  const auto p = gyrostat_of(V(.2, .15, .3));
  OrbitRun motion = orbit_run_of(p);
  REQUIRE(motion.advance(infinity<double>, .3, no_one) == ode::Status::reached);
  CHECK(motion.floored());
  CHECK(motion.opposed() <= .3);
  CHECK(motion.sample().level.R == Approx(motion.opposed()));
  CHECK(motion.time() > 0);
}

TEST_CASE("orbit motion: no control, no drag", "[deceleration]") {
  auto p = gyrostat_of(V(.2, .15, .3));
  p.control.setZero();
  OrbitRun dragged = orbit_run_of(p);
  CHECK(*dragged.stop_time(no_one) == infinity<double>);
  REQUIRE(dragged.advance(5000, 0, no_one) == ode::Status::reached);
  CHECK(dragged.sample().level.R == Approx(p.momentum.norm() * std::exp(-1.5)).epsilon(1e-9));
  OrbitRun late = orbit_run_of(p, 1e-6);
  REQUIRE(late.advance(4e5, 0, no_one) == ode::Status::reached);
  CHECK_FALSE(late.sample().at_rest);
  p.drag = 0;
  OrbitRun free = orbit_run_of(p);
  REQUIRE(free.advance(1e4, 0, no_one) == ode::Status::reached);
  CHECK(free.sample().level.R == p.momentum.norm());
  CHECK(energy_of(p, free.sample().level) == Approx(p.energy(p.momentum)).epsilon(1e-13));
}

TEST_CASE("orbit motion: units scale out", "[deceleration]") {
  const auto p = gyrostat_of(V(.2, .15, .3));
  auto q = p;  // twice the momenta: half the time, four times the torque
  q.momentum *= 2;
  q.rotor_momentum *= 2;
  q.control *= 4;
  q.drag *= 2;
  OrbitRun a = orbit_run_of(p), b = orbit_run_of(q);
  for (const double t : {100., 500.}) {
    REQUIRE(a.advance(t, 0, no_one) == ode::Status::reached);
    REQUIRE(b.advance(t / 2, 0, no_one) == ode::Status::reached);
    CHECK(b.sample().level.R == Approx(2 * a.sample().level.R).epsilon(1e-10));
    CHECK(b.sample().level.eta == Approx(2 * a.sample().level.eta).epsilon(1e-10).margin(1e-12));
  }
}

TEST_CASE("orbit motion: no heap, in either order", "[deceleration]") {
  for (const Law law : {Law::total, Law::carrier}) {
    const auto p = gyrostat_of(V(.2, .15, .3), law);
    const auto orbit = Orbit<double>::through(p, p.momentum);
    REQUIRE(orbit);
    Orbit<double> start;
    const auto mean = mean_of<math::Native>(p, p.momentum, &start);
    REQUIRE(mean);
    const std::size_t before = allocations();
    OrbitRun first(p, orbit->level(), orbit->component(), 0, 1e-8, infinity<double>);
    const auto one = first.advance(400, 0, no_one);
    using Second = SecondOrderRates<math::Native, double>;
    OrbitMotion<Second, double> second(p, mean->level, mean->component, mean->phase, 1e-8, 1e-6, Second{start});
    const auto two = second.advance(100, 0, no_one);
    const auto sample = second.sample();
    CHECK(allocations() == before);
    CHECK(one == ode::Status::reached);
    CHECK(two == ode::Status::reached);
    CHECK(sample.level.R > 0);
  }
}

namespace {

Problem<long double> widened(const Problem<double>& p) {
  Problem<long double> w;
  w.inverse_inertia = p.inverse_inertia.cast<long double>();
  w.rotor_momentum = p.rotor_momentum.cast<long double>();
  w.control = p.control.cast<long double>();
  w.drag = p.drag;
  w.law = p.law, w.drag_law = p.drag_law;
  w.momentum = p.momentum.cast<long double>();
  return w;
}

}  // namespace

TEST_CASE("orbit motion: beside an equilibrium and a separatrix errors stay within their tolerance",
          "[deceleration][length]") {
  const double nearer = at_length() ? 10 : 100;
  int checked = 0;
  for (const Law law : {Law::total, Law::carrier})
    for (const int axis : {0, 1, 2})
      for (double off = 1e-2; off > 1e-9; off /= nearer) {
        Problem<double> p = gyrostat_of({0, 0, 0}, law, 1e-6);
        p.rotor_momentum = 0.03 * V::Unit(axis);
        p.momentum = V::Unit(axis) + off * V(.3, .5, .4);
        const auto orbit = Orbit<double>::through(p, p.momentum);
        if (!orbit) continue;
        const Level<double> start = orbit->level();
        OrbitMotion<Averages, long double> truth(widened(p), {start.R, start.eta}, orbit->component(), 0, 1e-16L,
                                                 infinity<long double>);
        constexpr double times[] = {2e5, 4e5, 6e5};
        std::array<Level<double>, 3> wanted;
        bool known = true;
        for (std::size_t i = 0; i < 3; ++i) {
          known = known && truth.advance(times[i], 0, [](auto, auto, auto) {}) == ode::Status::reached;
          const auto there = truth.sample().level;
          wanted[i] = {double(there.R), double(there.eta)};
        }
        if (!known || truth.changed_component()) continue;
        for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
          OrbitRun motion(p, start, orbit->component(), 0, tolerance, infinity<double>);
          CAPTURE(int(law), axis, off, tolerance);
          for (std::size_t i = 0; i < 3; ++i) {
            REQUIRE(motion.advance(times[i], 0, no_one) == ode::Status::reached);
            const auto level = motion.sample().level;
            CHECK(std::abs(level.R - wanted[i].R) <= 4 * tolerance);
            CHECK(std::abs(level.eta - wanted[i].eta) <= 4 * tolerance * p.inverse_inertia[2]);
          }
          CHECK_FALSE(motion.changed_component());
          ++checked;
        }
      }
  CHECK(checked > (at_length() ? 100 : 60));
}
