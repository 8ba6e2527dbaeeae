// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/linear_tail.hpp"

#include "allocations.hpp"
#include "bodies.hpp"
#include "catch.hpp"
#include "long_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

using V = Vec3<double>;
using Q = Quat<double>;

/// A steady rotation and a start `eps` beside it, in the direction (a, b, xi).
struct Beside {
  Gyrostat<double> body;
  double l = 1;
  SteadyRotation<double> steady;
  SteadyStability<double> stability;
  State<double> start;

  void set_off(const V& y, const Q& attitude) {
    const Linearisation<double> linear(body, l, steady.direction, body.no_load_rate());
    const V m = (steady.direction + y[0] * linear.u + y[1] * linear.v).normalized();
    const double p = body.axial_inertia() * (body.coupling() * (body.no_load_rate() + linear.unit * y[2]) +
                                             l * linear.n.dot(steady.direction));
    start = {attitude, l * m, p, 0};
  }
  LinearTail<double> tail() const { return {body, start, steady, stability}; }
  /// The fastest of spin and nutation, rad/s.
  double fast() const { return std::abs(steady.spin_rate) + std::sqrt(stability.determinant); }
};

Beside beside(Bodies& bodies, double eps) {
  for (;;) {
    Beside s{bodies.realisable(), bodies.scale(0.5, 10), {}, {}, {}};
    const auto all = steady_rotations(s.body, s.l);
    const bool second = bodies.uniform(0, 1) < 0.5;
    int index = 0;
    for (int i = 1; i < all.count && second; ++i)
      if (all[i].type == SteadyType::minimum) index = i;
    s.steady = all[index];
    s.stability = stability_of(s.body, s.l, s.steady);
    if (s.stability.verdict != Verdict::asymptotically_stable) continue;
    s.set_off(eps * bodies.direction(), bodies.attitude());
    return s;
  }
}

std::vector<double> squared_times(double last) {
  std::vector<double> t;
  for (int i = 1; i <= 8; ++i) t.push_back(last * i * i / 64);
  return t;
}

struct Off {
  double attitude = 0, momentum = 0, rotor_rate = 0, rotor_angle = 0;
};

Off far_apart(const Gyrostat<double>& body, const State<double>& a, const State<double>& b) {
  const auto rate = [&](const State<double>& s) {
    return body.rotor_rate(s.axial_momentum, body.angular_velocity(s.momentum, s.axial_momentum));
  };
  return {angle_between(a.attitude, b.attitude), (a.momentum - b.momentum).norm(), std::abs(rate(a) - rate(b)),
          std::abs(a.rotor_angle - b.rotor_angle)};
}

Off measure(const Beside& s, const std::vector<double>& at) {
  const auto truth = LongMotion::from(s.body, s.start, at);
  const auto tail = s.tail();
  Off most;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Off here = far_apart(s.body, tail.at(at[i]), truth[i]);
    most.attitude = std::max(most.attitude, here.attitude);
    most.momentum = std::max(most.momentum, here.momentum);
    most.rotor_rate = std::max(most.rotor_rate, here.rotor_rate);
    most.rotor_angle = std::max(most.rotor_angle, here.rotor_angle);
  }
  return most;
}

}  // namespace

TEST_CASE("linear tail: errors of the third order, in the attitude too", "[rotor]") {
  Bodies bodies(1);
  for (int i = 0; i < 6; ++i) {
    Beside s = beside(bodies, 1);
    const V y = bodies.direction();
    const Q q = bodies.attitude();
    const double last = std::min(2 / s.stability.decay_rate, 300 / s.fast());
    std::vector<Off> off;
    const double small = 1e-3 * std::cbrt(std::min(1., 100 / (last * s.fast())));
    for (const double eps : {4 * small, 2 * small, small}) {
      s.set_off(eps * y, q);
      off.push_back(measure(s, squared_times(last)));
    }
    CAPTURE(i, s.stability.decay_rate, s.fast());
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(std::log2(off[k].attitude / off[k + 1].attitude) > 2.85);
      CHECK(std::log2(off[k].momentum / off[k + 1].momentum) == Approx(3).margin(0.15));
      CHECK(std::log2(off[k].rotor_rate / off[k + 1].rotor_rate) == Approx(3).margin(0.15));
    }
  }
}

TEST_CASE("linear tail: never further off than it says", "[rotor]") {
  Bodies bodies(2);
  int told = 0;
  for (int i = 0; i < 150; ++i) {
    const Beside s = beside(bodies, bodies.scale(1e-8, 0.3));
    const double last = std::min(bodies.scale(0.1, 10) / s.stability.decay_rate, 100 / s.fast());
    if (s.body.relaxation_rate() * last > 3e3) continue;
    const auto bound = s.tail().error(last);
    if (!(bound.attitude < infinity<double>)) continue;
    ++told;
    const Off off = measure(s, squared_times(last));
    CAPTURE(i);
    CHECK(off.attitude <= bound.attitude);
    CHECK(off.momentum <= bound.momentum);
    CHECK(off.rotor_rate <= bound.rotor_rate);
    CHECK(off.rotor_angle <= bound.rotor_angle);
  }
  CHECK(told > 100);
}

TEST_CASE("linear tail: the laws of the motion hold at any time", "[rotor]") {
  Bodies bodies(3);
  for (int i = 0; i < 100; ++i) {
    const Beside s = beside(bodies, bodies.scale(1e-6, 1e-2));
    const auto tail = s.tail();
    const V L = rotate(s.start.attitude, s.start.momentum);
    const auto start = tail.at(0);
    CHECK(angle_between(start.attitude, s.start.attitude) < 1e-14);
    CHECK((start.momentum - s.start.momentum).norm() < 1e-14 * s.l);
    CHECK(std::abs(start.axial_momentum - s.start.axial_momentum) < 1e-13 * (std::abs(s.start.axial_momentum) + s.l));
    for (const double share : {0.1, 1., 10., 1e4}) {
      const double t = share / tail.decay_rate();
      const auto state = tail.at(t);
      CHECK(std::abs(norm(state.attitude) - 1) < 4e-16);
      CHECK((rotate(state.attitude, state.momentum) - L).norm() < 4e-15 * s.l);
      if (share > 100) {
        CHECK((state.momentum / s.l - s.steady.direction).norm() < 1e-14);
      }
    }
  }
}

TEST_CASE("linear tail: near a double exponent nothing breaks", "[rotor]") {
  // where nutation and motor merge: two real exponents at one S, found by bisection of the discriminant
  const Mat3<double> theta = V(1, 1.4, 1.9).asDiagonal();
  const V e = V(0.6, 0.5, 0.6).normalized();
  const double lambda = 0.99 / e.dot(theta.inverse() * e);  // k = 0.01: no lesser coupling makes them merge
  const auto at = [&](double S) {
    Beside s{Gyrostat<double>::make(theta, e, lambda, S, 0.1).value(), 1, {}, {}, {}};
    s.steady = steady_rotations(s.body, s.l)[0];
    s.stability = stability_of(s.body, s.l, s.steady);
    return s;
  };
  const auto real = [&](double S) { return at(S).stability.eigenvalues[1].imag() == 0; };
  double low = 1e-3, high = 0;
  for (double S = 1e-3; S < 1 && high == 0; S *= 1.02) {
    if (real(S)) high = S;
    else low = S;
  }
  REQUIRE(high > 0);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (real(middle) ? high : low) = middle;
  }
  for (const double S :
       {low, low * (1 - 1e-14), high * (1 + 1e-12), low * (1 - 1e-10), high * (1 + 1e-6), low * (1 - 1e-3)}) {
    Beside s = at(S);
    s.set_off(V(1e-4, -2e-4, 1e-4), Q{});
    const auto bound = s.tail().error(200);
    CAPTURE(S - low);
    const Off off = measure(s, squared_times(200));
    CHECK(off.attitude < 1e-10);
    CHECK(off.attitude <= bound.attitude);
    CHECK(off.momentum <= bound.momentum);
    CHECK(off.rotor_rate <= bound.rotor_rate);
    CHECK(off.rotor_angle <= bound.rotor_angle);
    if (std::abs(S - low) > 1e-8 * S) CHECK(bound.attitude < 1e-4);
  }
}

TEST_CASE("linear tail: what errors of the start grow to", "[rotor]") {
  Bodies bodies(4);
  for (int i = 0; i < 200; ++i) {
    const double eps = bodies.scale(1e-4, 1e-2);
    Beside s = beside(bodies, eps);
    const auto tail = s.tail();
    Beside moved = s;
    const double off = eps * bodies.scale(1e-6, 1e-2);
    moved.start.momentum = s.l * (s.start.momentum / s.l + off * bodies.direction()).normalized();
    moved.start.axial_momentum += off * s.body.axial_inertia() * bodies.uniform(-1, 1);
    const Off first = far_apart(s.body, s.start, moved.start);
    const auto carried = tail.carried(first.momentum, first.rotor_rate);
    const auto other = moved.tail();
    for (const double share : {0.01, 0.1, 1., 10.}) {
      const double t = share / tail.decay_rate();
      const Off now = far_apart(s.body, tail.at(t), other.at(t));
      // the attitudes of two starts with one P have two L
      CHECK(now.attitude <= carried.attitude + first.momentum / s.l);
      CHECK(now.momentum <= carried.momentum);
      CHECK(now.rotor_rate <= carried.rotor_rate);
      CHECK(now.rotor_angle <= carried.rotor_angle);
    }
  }
}

TEST_CASE("linear tail: says infinite where it has no estimate", "[rotor]") {
  Bodies bodies(5);
  Beside s = beside(bodies, 0.7);
  CHECK(s.tail().error(100).attitude == infinity<double>);
  s.set_off(V(1e-6, 0, 0), Q{});
  CHECK(s.tail().error(100).attitude < 1e-6);
  // a steady rotation that does not attract
  const auto all = steady_rotations(s.body, s.l);
  s.steady = all[all.count - 1];
  s.stability = stability_of(s.body, s.l, s.steady);
  s.set_off(V(1e-6, 0, 0), Q{});
  CHECK(s.tail().error(100).attitude == infinity<double>);
}

TEST_CASE("linear tail asks for no memory", "[rotor]") {
  Bodies bodies(6);
  const Beside s = beside(bodies, 1e-3);
  const std::size_t before = allocations();
  const auto tail = s.tail();
  const double sum = tail.at(3).rotor_angle + tail.error(300).attitude;
  CHECK(allocations() == before);
  CHECK(sum == sum);
}

TEMPLATE_TEST_CASE("linear tail in every scalar", "[rotor]", float, double, long double) {
  using S = TestType;
  const auto body =
      Gyrostat<S>::make(Vec3<S>(3, 5, 7).asDiagonal(), Vec3<S>(S(0.5), S(0.5), std::sqrt(S(0.5))), S(0.5), 4, 1);
  REQUIRE(body);
  const auto steady = steady_rotations(*body, S(7));
  const Vec3<S> m = (steady[0].direction + Vec3<S>(S(1e-3), 0, 0)).normalized();
  const State<S> start = body->state({}, body->inverse_inertia() * (S(7) * m - S(0.5) * body->axis()), 1);
  const LinearTail<S> tail(*body, start, steady[0], stability_of(*body, S(7), steady[0]));
  CHECK(tail.error(50).attitude < S(1e-6) + 20000 * epsilon<S>);
  CHECK((tail.at(50).momentum - steady[0].direction * S(7)).norm() < S(0.01));
}
