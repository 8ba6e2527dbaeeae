// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/equal_torque.hpp"

#include "bodies.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostat/rotation/kinematics.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

/// The full equations, M and the attitude, by a Runge-Kutta method that shares nothing with the closed form.
struct Braked {
  free::Problem<double> body;
  double b, drag;

  Braked(const Problem<double>& p, double control, double lambda, const Quat<double>& q = {})
      : b(control), drag(lambda) {
    body.inertia = p.inverse_inertia.cwiseInverse().asDiagonal();
    body.momentum_given = true;
    body.angular_momentum = p.momentum;
    body.attitude = q;
  }
  double norm() const { return body.angular_momentum.norm(); }

  EqualTorqueMotion<double> motion() const {
    const auto made = EqualTorqueMotion<double>::make(body, b, drag);
    REQUIRE(made);
    return *made;
  }

  std::pair<V, Quat<double>> integrated(double t) const {
    const V J = body.inertia.diagonal(), M0 = body.angular_momentum;
    const auto rhs = [&](double, const std::array<double, 7>& y, std::array<double, 7>& dy) noexcept {
      const V M(y[0], y[1], y[2]), w = M.cwiseQuotient(J);
      const V d = cross<double>(M, w) - drag * M - b * M / M.norm();
      const Quat<double> dq = quaternion_rate<double>({y[3], y[4], y[5], y[6]}, w);
      dy = {d[0], d[1], d[2], dq.w, dq.x, dq.y, dq.z};
    };
    ode::StepControl<double, 7> control;
    control.relative = 1e-13;
    control.absolute.fill(1e-14);
    const Quat<double>& q = body.attitude;
    ode::RungeKutta solver(rhs, 0., std::array{M0[0], M0[1], M0[2], q.w, q.x, q.y, q.z}, control);
    while (solver.time() < t && solver.step(t) == ode::Status::reached) {
    }
    REQUIRE(solver.time() == t);
    const auto& y = solver.state();
    return {V(y[0], y[1], y[2]), normalised(Quat<double>{y[3], y[4], y[5], y[6]})};
  }
};

}  // namespace

TEST_CASE("equal torques: the closed form is the full motion, at any strength", "[deceleration]") {
  Bodies bodies(13);
  for (const double b : {1e-3, .1, 3.})
    for (const double drag : {0., 1e-3, 1.})
      for (int trial = 0; trial < 5; ++trial) {
        const V axis = bodies.vector();
        const Braked braked(bodies.problem(1), b, drag, quaternion_from_vector<double>(axis));
        const auto motion = braked.motion();
        const double end = std::min(.9 * motion.law().stop_time(), 20.), kp2 = motion.unbraked().modulus().kp2;
        CAPTURE(b, drag, braked.body.angular_momentum.transpose(), kp2);
        for (const double t : {.3 * end, end}) {
          const auto now = motion.at(t);
          const auto [M, q] = braked.integrated(t);
          CHECK(now.angular_momentum.norm() == Approx(now.norm).epsilon(1e-12));
          CHECK((now.angular_momentum - M).norm() < braked.norm() * 1e-9 / kp2);
          CHECK(angle_between(q, now.unbraked.attitude) < 1e-9 / kp2);
          const V kept = rotate<double>(now.unbraked.attitude, now.angular_momentum) / now.norm;
          CHECK((kept - rotate<double>(braked.body.attitude, braked.body.angular_momentum) / braked.norm()).norm() <
                1e-13);
        }
      }
}

TEST_CASE("equal torques: the stop, and the attitude that it leaves", "[deceleration]") {
  Bodies bodies(14);
  const auto p = bodies.problem(1);
  const Braked braked(p, .02, .3);
  const auto motion = braked.motion();
  const auto& law = motion.law();
  const double T = std::log(1 + .3 * p.momentum.norm() / .02) / .3;
  CHECK(law.stop_time() == Approx(T).epsilon(1e-14));
  CHECK(law.norm(T * (1 + 1e-15)) == 0);
  CHECK(motion.at(1e300).angular_momentum == V(0, 0, 0));
  CHECK(motion.at(T * (1 - 1e-9)).norm == Approx(.02 * T * 1e-9).epsilon(1e-5));
  const Quat<double> rest = motion.at(law.stop_time()).unbraked.attitude;
  CHECK(motion.at(1e300).unbraked.attitude.w == rest.w);
  const auto [M, q] = braked.integrated(T * (1 - 1e-6));
  CHECK(angle_between(q, rest) < 1e-8);
  CHECK(law.clock(1e300) == law.clock(law.stop_time()));
  CHECK(law.clock(T) < 1 / .3);
  const EqualTorqueLaw<double> control(.02, 0, 3), weak(.02, 1e-14, 3), none(0, .3, 3);
  CHECK(control.stop_time() == 3 / .02);
  CHECK(control.clock(1e9) == Approx(control.stop_time() / 2).epsilon(1e-15));
  CHECK(weak.stop_time() == Approx(3 / .02).epsilon(1e-11));
  CHECK(none.stop_time() == infinity<double>);
  CHECK(none.clock(1e9) == Approx(1 / .3).epsilon(1e-15));
}

TEST_CASE("equal torques: drag alone, and nothing at all", "[deceleration]") {
  Bodies bodies(15);
  for (int trial = 0; trial < 20; ++trial) {
    const auto p = bodies.problem(1);
    const auto drag = Braked(p, 0, .3).motion(), left_alone = Braked(p, 0, 0).motion();
    const double R = p.momentum.norm();
    for (const double t : {.1, 1., 7.}) {
      CHECK(drag.at(t).norm == Approx(R * std::exp(-.3 * t)).epsilon(1e-14));
      CHECK(left_alone.at(t).norm == Approx(R).epsilon(1e-15));
      CHECK(left_alone.at(t).tau == t);
      CHECK(left_alone.law().clock_error(t) == 0);
      // under drag alone the clock of the free motion is (1 - e^-drag t)/drag
      const auto now = drag.at(t), other = left_alone.at((1 - std::exp(-.3 * t)) / .3);
      const double kp2 = drag.unbraked().modulus().kp2;
      CHECK((now.angular_momentum * std::exp(.3 * t) - other.angular_momentum).norm() < R * 1e-11 / kp2);
      CHECK(angle_between(now.unbraked.attitude, other.unbraked.attitude) < 1e-11 / kp2);
    }
  }
}

TEST_CASE("equal torques: the clock is as good as it says", "[deceleration]") {
  Bodies bodies(17);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto some = [&] { return std::pow(10, bodies.uniform(-12, 3)); };
    const double b = trial % 5 ? some() : 0, drag = trial % 7 ? some() : 0, norm = some();
    const EqualTorqueLaw<double> law(b, drag, norm);
    const EqualTorqueLaw<long double> truth(b, drag, norm);
    const double t = std::min(law.stop_time(), some()) * bodies.uniform(0, 1.1), tau = law.clock(t);
    CAPTURE(b, drag, norm, t);
    CHECK(std::abs(static_cast<double>(tau - truth.clock(t))) <= law.clock_error(tau));
    CHECK(std::abs(static_cast<double>(law.norm(t) - truth.norm(t))) <= 8 * epsilon<double> * norm);
  }
}

TEST_CASE("equal torques: sphere, symmetry axes and the separatrix", "[deceleration]") {
  Problem<double> p;
  const auto turned = [](const Braked& braked, double t) {
    return (braked.motion().at(t).angular_momentum.normalized() - braked.body.angular_momentum.normalized()).norm();
  };
  p.momentum = V(.3, .4, 1.2);
  CHECK(turned(Braked(p, .01, .1), 2) < 1e-15);
  p.inverse_inertia = V(1, 1, 2);
  p.momentum = V(.3, .4, 0);  // across the axis
  CHECK(turned(Braked(p, .01, .1), 2) < 1e-15);
  p.momentum = V(.3, .4, .5);
  const Braked symmetric(p, .01, .1);
  CHECK((symmetric.motion().at(3).angular_momentum - symmetric.integrated(3).first).norm() < 1e-12);
  p.inverse_inertia = V(3, 2, 1.5).cwiseInverse();  // exactly: the differences of 1/J are 1/6 and 1/6
  p.momentum = V(.5, .3, .5);
  const Braked saddle(p, .01, .1);
  const auto made = EqualTorqueMotion<double>::make<DoubleDouble>(saddle.body.cast<DoubleDouble>(), .01, .1);
  REQUIRE(made);
  CHECK(made->unbraked().modulus().kp2 < 1e-30);
  for (const double t : {1., 5., 20.}) {
    const auto [M, q] = saddle.integrated(t);
    CHECK((made->at(t).angular_momentum - M).norm() < 1e-11);
    CHECK(angle_between(q, made->at(t).unbraked.attitude) < 1e-11);
  }
}

TEST_CASE("equal torques in other arithmetic", "[deceleration]") {
  Bodies bodies(16);
  for (int trial = 0; trial < 20; ++trial) {
    const Braked braked(bodies.problem(1), .05, .2);
    const auto a = braked.motion();
    const auto b = EqualTorqueMotion<long double>::make(braked.body.cast<long double>(), .05L, .2L);
    REQUIRE(b);
    const double t = .7 * a.law().stop_time();
    CHECK((a.at(t).angular_momentum - b->at(t).angular_momentum.cast<double>()).norm() <
          1e-13 * braked.norm() / a.unbraked().modulus().kp2);
  }
}

TEST_CASE("equal torques: the stop under a drag that hardly is one, or beside a torque that hardly is one",
          "[deceleration]") {
  const auto stop = [](double b, double drag, double norm) {
    return EqualTorqueLaw<double>(b, drag, norm).stop_time();
  };
  for (const double drag : {0., 1e-300, 1e-308, 1e-310, 3e-315, 5e-324}) {
    CHECK(stop(0.004, drag, 0.5) == 0.5 / 0.004);
    CHECK(stop(2e-11, drag, 5e-9) == 5e-9 / 2e-11);
  }
  CHECK(stop(1e-310, 1e-3, 1) == Approx(std::log(1e-3 / 1e-310) / 1e-3).epsilon(1e-12));
  CHECK(stop(0.3, 0.2, 2) == Approx(std::log1p(0.2 * 2 / 0.3) / 0.2).epsilon(1e-15));
}
