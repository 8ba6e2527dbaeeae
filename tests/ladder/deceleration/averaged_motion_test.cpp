// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/deceleration/averaged_motion.hpp"

#include "allocations.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

using Motion = AveragedMotion<math::Native, double>;

constexpr auto nobody = [](const Polhode<double>&, double) {};

Motion motion_of(const Problem<double>& p, double tolerance = 1e-12) {
  return {p, polhode_through<double>(p.inverse_inertia, p.momentum), p.momentum.norm(), 0, tolerance, infinity<double>};
}

Problem<double> standard(double eps, V b = V(.6, .9, 1), V M = V(.8, .5, .33)) {
  Problem<double> p;
  p.inverse_inertia = V(1.4, 1, .7).cwiseInverse();
  p.control = (eps * b).asDiagonal();
  p.drag = .3 * eps;
  p.momentum = M;
  return p;
}

}  // namespace

TEST_CASE("averaged motion: the reference cases without rotor", "[deceleration]") {
  int checked = 0;
  for (const auto& c : reference::cases()) {
    if (c.has_rotor()) continue;
    CAPTURE(c.id);
    ++checked;
    const Problem<double> p = c.scene().problem();
    Motion motion = motion_of(p);
    for (std::size_t i = 0; i < c.data.times.size(); ++i) {
      REQUIRE(motion.advance(c.data.times[i], 0, nobody) == ode::Status::reached);
      const auto s = motion.state();
      CHECK(s.norm == Approx(c.norm[i]).epsilon(1e-9));
      CHECK(s.polhode.modulus.k2 == Approx(c.k2[i]).epsilon(1e-9));
      CHECK(s.norm * s.norm * s.polhode.energy_ratio() / 2 == Approx(c.energy[i]).epsilon(1e-9));
    }
    CHECK(motion.crossed() == (c.id == "P05"));
    const auto stop = motion.stop_time();
    REQUIRE(stop);
    if (!std::isnan(c.averaged_stop)) CHECK(*stop == Approx(c.averaged_stop).epsilon(1e-9));
  }
  CHECK(checked == 6);
}

TEST_CASE("averaged motion: units scale out", "[deceleration]") {
  const auto p = standard(1e-3);
  auto q = p;  // twice the momentum, the same body: half the time, four times the torque
  q.momentum *= 2;
  q.control *= 4;
  q.drag *= 2;
  auto r = p;  // a body of three times the inertia and momentum
  r.inverse_inertia /= 3;
  r.momentum *= 3;
  r.control *= 3;
  Motion a = motion_of(p), b = motion_of(q), c = motion_of(r);
  for (const double t : {100., 400., 900., 2000.}) {
    REQUIRE(a.advance(t, 0, nobody) == ode::Status::reached);
    REQUIRE(b.advance(t / 2, 0, nobody) == ode::Status::reached);
    REQUIRE(c.advance(t, 0, nobody) == ode::Status::reached);
    CHECK(b.state().norm == Approx(2 * a.state().norm).epsilon(1e-10));
    CHECK(b.state().polhode.modulus.k2 == Approx(a.state().polhode.modulus.k2).epsilon(1e-10));
    CHECK(c.state().norm == Approx(3 * a.state().norm).epsilon(1e-10));
  }
  CHECK(*b.stop_time() == Approx(*a.stop_time() / 2).epsilon(1e-10));
  CHECK(*c.stop_time() == Approx(*a.stop_time()).epsilon(1e-10));
}

TEST_CASE("averaged motion: equal torques, drag alone, nothing", "[deceleration]") {
  Motion equal = motion_of(standard(1e-3, V(1, 1, 1)));
  const double R = V(.8, .5, .33).norm(), drag = .3e-3, b = 1e-3;
  const double k2 = equal.state().polhode.modulus.k2;
  for (const double t : {300., 700.}) {
    REQUIRE(equal.advance(t, 0, nobody) == ode::Status::reached);
    CHECK(equal.state().norm == Approx((R + b / drag) * std::exp(-drag * t) - b / drag).epsilon(1e-10));
    CHECK(equal.state().polhode.modulus.k2 == Approx(k2).epsilon(1e-12));
  }
  CHECK(*equal.stop_time() == Approx(std::log1p(drag * R / b) / drag).epsilon(1e-10));
  Motion dragged = motion_of(standard(1e-3, V(0, 0, 0)));
  REQUIRE(dragged.advance(5000, 0, nobody) == ode::Status::reached);
  CHECK(dragged.state().norm == Approx(R * std::exp(-1.5)).epsilon(1e-10));
  CHECK(dragged.state().polhode.modulus.k2 == Approx(k2).epsilon(1e-12));
  REQUIRE(dragged.advance(4e5, 0, nobody) == ode::Status::reached);
  CHECK(dragged.state().norm == Approx(R * std::exp(-120.)).epsilon(1e-9));
  REQUIRE(dragged.advance(1e8, 0, nobody) == ode::Status::reached);
  CHECK(dragged.state().norm > 0);  // below every double, but not at rest
  CHECK(dragged.state().polhode.modulus.k2 == Approx(k2).epsilon(1e-12));
  auto nothing = standard(0);
  Motion free = motion_of(nothing);
  REQUIRE(free.advance(1e5, 0, nobody) == ode::Status::reached);
  CHECK(free.state().norm == Approx(R).epsilon(1e-14));
}

TEST_CASE("averaged motion: a torque that changes |M| by less than a rounding keeps the phase", "[deceleration]") {
  const auto phase_of = [](Problem<double> p, double t) {
    const auto start = polhode_through<double>(p.inverse_inertia, p.momentum);
    Motion motion{p, start, p.momentum.norm(), 0.3, 1e-10, 1e-8};
    REQUIRE(motion.advance(t, 0, nobody) == ode::Status::reached);
    return motion.state().phase;
  };
  for (const double torque : {1e-20, 1e-17, 8e-17, 1e-15, 1e-14}) {
    auto p = standard(0);
    p.control = (torque * V(0, 1, 0)).asDiagonal();
    for (const double t : {0.1, 1., 30.}) CHECK(std::abs(phase_of(p, t) - phase_of(standard(0), t)) < 1e-7);
  }
}

TEST_CASE("averaged motion: the floor, rest and what lies behind", "[deceleration]") {
  Motion motion = motion_of(standard(1e-3));
  REQUIRE(motion.advance(infinity<double>, .25, nobody) == ode::Status::reached);
  CHECK(motion.floored());
  CHECK(motion.state().norm == Approx(.25).epsilon(1e-9));
  const double at_floor = motion.time();
  REQUIRE(motion.advance(at_floor + 10, .1, nobody) == ode::Status::reached);
  CHECK_FALSE(motion.floored());
  CHECK(motion.time() == at_floor + 10);
  const double stop = *motion.stop_time();
  CHECK(stop > at_floor);
  REQUIRE(motion.advance(stop * (1 - 1e-6), 0, nobody) == ode::Status::reached);
  CHECK(motion.state().norm > 0);
  CHECK(motion.state().norm < 1e-5);
  REQUIRE(motion.advance(2 * stop, 0, nobody) == ode::Status::reached);
  CHECK(motion.state().norm == 0);
  CHECK(*motion.stop_time() == stop);
}

TEST_CASE("averaged motion: the two regimes are one with the outer axes exchanged", "[deceleration]") {
  // mirrored energies: a_i -> a_1 + a_3 - a_(4-i) with the torques and components exchanged
  const auto p = standard(1e-3);
  auto q = p;
  q.inverse_inertia[1] = p.inverse_inertia[0] + p.inverse_inertia[2] - p.inverse_inertia[1];
  q.momentum = V(p.momentum[2], p.momentum[1], p.momentum[0]);
  q.control = V(p.control(2, 2), p.control(1, 1), p.control(0, 0)).asDiagonal();
  Motion a = motion_of(p), b = motion_of(q);
  for (const double t : {200., 600., 1000.}) {
    REQUIRE(a.advance(t, 0, nobody) == ode::Status::reached);
    REQUIRE(b.advance(t, 0, nobody) == ode::Status::reached);
    CHECK(a.state().polhode.regime != b.state().polhode.regime);
    CHECK(a.state().norm == Approx(b.state().norm).epsilon(1e-10));
    CHECK(a.state().polhode.modulus.k2 == Approx(b.state().polhode.modulus.k2).epsilon(1e-9));
  }
}

TEST_CASE("averaged motion: through the separatrix, or held by it", "[deceleration]") {
  Motion crossing = motion_of(standard(1e-3, V(1.2, .9, .6)));
  REQUIRE(crossing.stop_time());
  CHECK(crossing.crossed());
  CHECK_FALSE(crossing.stuck());
  CHECK(crossing.state().polhode.regime == Regime::about_smallest);
  CHECK(crossing.crossing_norm() > 0);
  Motion held = motion_of(standard(1e-3, V(1, .1, 1)));
  REQUIRE(held.stop_time());
  CHECK(held.stuck());
  CHECK(held.state().polhode.modulus.k2 == Approx(1).epsilon(1e-9));
}

TEST_CASE("averaged motion: kp2 down to 1e-300, k2 down to 0, revolution", "[deceleration]") {
  const auto p = standard(1e-3);
  const auto family = polhode_through<double>(p.inverse_inertia, V(1, .1, .1));
  for (const double small : {1e-3, 1e-12, 1e-100, 1e-300, 0.}) {
    CAPTURE(small);
    Motion round(p, at_modulus(family, {small, 1 - small}), 1., 0, 1e-10, 1e-8);
    REQUIRE(round.advance(500, 0, nobody) == ode::Status::reached);
    CHECK(round.state().polhode.modulus.k2 <= 1.1 * small);
    CHECK(round.state().norm > .5);
    if (small == 0) continue;
    Motion near(p, at_modulus(family, {1 - small, small}), 1., 0, 1e-10, infinity<double>);
    REQUIRE(near.advance(500, 0, nobody) == ode::Status::reached);
    CHECK(near.state().norm > .4);
    CHECK(near.state().norm < .7);
    CHECK(std::isfinite(near.state().polhode.modulus.k2));
  }
  auto q = p;
  q.inverse_inertia = V(1, 1, 2);
  Motion revolution = motion_of(q);
  REQUIRE(revolution.advance(500, 0, nobody) == ode::Status::reached);
  CHECK(std::isfinite(revolution.state().polhode.tilt));
  REQUIRE(revolution.stop_time());
}

TEST_CASE("averaged motion: what nothing drives stays on the separatrix and is braked", "[deceleration]") {
  for (const V& b : {V(0, 0, 0), V(1, 1, 1)}) {
    Problem<double> p = standard(1e-3, b);
    p.drag = 1e-3;
    for (const double kp2 : {1e-20, 1e-16, 1e-15, 1e-6}) {
      const auto family = polhode_through<double>(p.inverse_inertia, V(1, .1, .1));
      Motion motion(p, at_modulus(family, {1 - kp2, kp2}), 1., 0, 1e-10, infinity<double>);
      for (const double t : {1., 100., 500.}) {
        REQUIRE(motion.advance(t, 0, nobody) == ode::Status::reached);
        const double D = b[0] * 1e-3, right = (1 + D / p.drag) * std::exp(-p.drag * t) - D / p.drag;
        CAPTURE(b[0], kp2, t);
        CHECK(motion.state().norm == Approx(right).epsilon(1e-8));
        CHECK(motion.state().polhode.modulus.kp2 == Approx(kp2).epsilon(1e-3).margin(2e-16));
      }
    }
  }
}

TEST_CASE("averaged motion: no heap", "[deceleration]") {
  const auto p = standard(1e-4);
  const std::size_t before = allocations();
  Motion motion = motion_of(p, 1e-8);
  double seen = 0;
  const auto status = motion.advance(5000, 0, [&](const Polhode<double>&, double norm) { seen += norm; });
  const auto state = motion.state();
  const auto stop = motion.stop_time();
  CHECK(allocations() == before);
  CHECK(status == ode::Status::reached);
  CHECK(state.norm > 0);
  CHECK(*stop > 5000);
  CHECK(seen > 0);
}

TEST_CASE("averaged motion: NaN ends it at once", "[deceleration]") {
  auto p = standard(1e-3);
  p.control(1, 1) = std::numeric_limits<double>::quiet_NaN();
  Motion motion = motion_of(p);
  CHECK(motion.advance(100, 0, nobody) == ode::Status::not_finite);
  CHECK_FALSE(motion.stop_time());
}
