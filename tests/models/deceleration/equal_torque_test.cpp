// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/equal_torque.hpp"

#include "bodies.hpp"
#include "gyrostat/body/inertia.hpp"
#include "gyrostat/ode/runge_kutta.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

Problem<double> equal(Problem<double> p, double b, double drag) {
  p.control = b * Mat3<double>::Identity();
  p.drag = drag;
  return p;
}

/// The full equations by a Runge-Kutta method that shares nothing with the closed form.
V integrated(const Problem<double>& p, double t) {
  const auto rhs = [&](double, const std::array<double, 3>& y, std::array<double, 3>& dy) noexcept {
    const V M(y[0], y[1], y[2]);
    const V d = cross<double>(M, p.angular_velocity(M)) - p.drag * M - p.control * M / M.norm();
    dy = {d[0], d[1], d[2]};
  };
  ode::StepControl<double, 3> control;
  control.relative = 1e-13;
  control.absolute.fill(1e-14);
  ode::RungeKutta solver(rhs, 0., std::array{p.momentum[0], p.momentum[1], p.momentum[2]}, control);
  while (solver.time() < t && solver.step(t) == ode::Status::reached) {
  }
  REQUIRE(solver.time() == t);
  return {solver.state()[0], solver.state()[1], solver.state()[2]};
}

}  // namespace

TEST_CASE("equal torques: the closed form is the full motion, at any strength", "[deceleration]") {
  Bodies bodies(13);
  for (const double b : {1e-3, .1, 3.})
    for (const double drag : {0., 1e-3, 1.})
      for (int trial = 0; trial < 5; ++trial) {
        const auto p = equal(bodies.problem(1), b, drag);
        const EqualTorqueMotion<double> motion(p);
        const double end = std::min(.9 * motion.stop_time(), 20.);
        CAPTURE(b, drag, p.momentum.transpose(), motion.modulus().kp2);
        for (const double t : {.3 * end, end}) {
          const auto now = motion.at(t);
          CHECK(now.momentum.norm() == Approx(now.norm).epsilon(1e-12));
          CHECK((now.momentum - integrated(p, t)).norm() <
                p.momentum.norm() * (motion.rounding(t) + 1e-9 / motion.modulus().kp2));
          const auto q = polhode_through<double>(p.inverse_inertia, now.momentum);
          CHECK(q.modulus.k2 == Approx(motion.modulus().k2).epsilon(1e-9));
          CHECK(q.energy_ratio() == Approx(motion.energy_ratio()).epsilon(1e-12));
        }
      }
}

TEST_CASE("equal torques: the stop", "[deceleration]") {
  Bodies bodies(14);
  const auto p = equal(bodies.problem(1), .02, .3);
  const EqualTorqueMotion<double> motion(p);
  const double T = std::log(1 + .3 * p.momentum.norm() / .02) / .3;
  CHECK(motion.stop_time() == Approx(T).epsilon(1e-14));
  CHECK(motion.at(T * (1 + 1e-15)).norm == 0);
  CHECK(motion.at(1e300).momentum == V(0, 0, 0));
  CHECK(motion.at(T * (1 - 1e-9)).norm == Approx(.02 * T * 1e-9).epsilon(1e-5));
  CHECK(EqualTorqueMotion<double>(equal(p, .02, 0)).stop_time() == p.momentum.norm() / .02);
  CHECK(EqualTorqueMotion<double>(equal(p, .02, 1e-14)).stop_time() == Approx(p.momentum.norm() / .02).epsilon(1e-11));
  CHECK(EqualTorqueMotion<double>(equal(p, 0, .3)).stop_time() == infinity<double>);
}

TEST_CASE("equal torques: drag alone, and nothing at all", "[deceleration]") {
  Bodies bodies(15);
  for (int trial = 0; trial < 20; ++trial) {
    const auto p = bodies.problem(1);
    const EqualTorqueMotion<double> drag(equal(p, 0, .3)), free(equal(p, 0, 0));
    const double R = p.momentum.norm();
    for (const double t : {.1, 1., 7.}) {
      CHECK(drag.at(t).norm == Approx(R * std::exp(-.3 * t)).epsilon(1e-14));
      CHECK(free.at(t).norm == R);
      // under drag alone M runs along the free motion in the clock (1 - e^-drag t)/drag
      const double clock = (1 - std::exp(-.3 * t)) / .3;
      CHECK((drag.at(t).momentum * std::exp(.3 * t) - free.at(clock).momentum).norm() < R * 1e-11 / free.modulus().kp2);
    }
  }
}

TEST_CASE("equal torques: sphere and symmetry axes", "[deceleration]") {
  Problem<double> p = equal({}, .01, .1);
  p.momentum = V(.3, .4, 1.2);
  const EqualTorqueMotion<double> sphere(p);
  CHECK(sphere.regime() == Regime::point);
  CHECK((sphere.at(2.).momentum.normalized() - p.momentum.normalized()).norm() < 1e-15);
  p.inverse_inertia = V(1, 1, 2);
  p.momentum = V(.3, .4, 0);  // across the axis
  const EqualTorqueMotion<double> across(p);
  CHECK(across.regime() == Regime::point);
  CHECK((across.at(2.).momentum.normalized() - p.momentum.normalized()).norm() < 1e-15);
  p.momentum = V(.3, .4, .5);
  CHECK((EqualTorqueMotion<double>(p).at(3.).momentum - integrated(p, 3)).norm() < 1e-12);
}

TEST_CASE("equal torques in other arithmetic", "[deceleration]") {
  Bodies bodies(16);
  for (int trial = 0; trial < 20; ++trial) {
    const auto p = equal(bodies.problem(1), .05, .2);
    Problem<long double> q;
    q.inverse_inertia = p.inverse_inertia.cast<long double>();
    q.control = p.control.cast<long double>();
    q.drag = p.drag;
    q.momentum = p.momentum.cast<long double>();
    const EqualTorqueMotion<double> a(p);
    const EqualTorqueMotion<long double> b(q);
    const double t = .7 * a.stop_time();
    CHECK((a.at(t).momentum - b.at(t).momentum.cast<double>()).norm() < a.rounding(t) * p.momentum.norm());
  }
}

TEST_CASE("equal torques: the modulus of a nearly symmetric body, where the moments are known", "[deceleration]") {
  for (const double gap : {1e-6, 1e-9, 1e-12}) {
    const auto inertia = Inertia<double>::from_moments(168 * (1 + gap), 168, 105).value();
    Problem<double> p;
    p.inverse_inertia = inertia.inverse_principal();
    p.exact_gaps = inertia.inverse_gaps();
    p.momentum = {1e-9, -2e-9, 3};
    const Vec3<long double> moments = inertia.principal().cast<long double>(),
                            m = p.momentum.cast<long double>().cwiseAbs2();
    // k2 = mid_far tilt/(near_mid (1 - tilt)) about the axis of the smallest moment
    const long double high = (moments[1] - moments[2]) / (moments[1] * moments[2]),
                      low = (moments[0] - moments[1]) / (moments[0] * moments[1]);
    const long double k2 = low * (high * m[1] + (high + low) * m[0]) / (high * ((high + low) * m[2] + low * m[1]));
    CHECK(EqualTorqueMotion<double>(p).modulus().k2 == Approx(double(k2)).epsilon(1e-14).margin(0));
    p.exact_gaps.reset();  // what the inverse moments alone tell
    CHECK(std::abs(EqualTorqueMotion<double>(p).modulus().k2 / double(k2) - 1) < 4 * epsilon<double> / gap);
  }
}
