// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/motion.hpp"

#include <cmath>
#include <vector>

#include "allocations.hpp"
#include "at_length.hpp"
#include "catch.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostats.hpp"
#include "reference_table.hpp"

namespace free_motion_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Kind;
using gyrostat::free::Motion;
using V = Vec3<double>;
using Q = Quat<double>;
using Wide = DoubleDouble;

Problem<Wide> wide(const Problem<double>& p) {
  auto w = p.cast<Wide>();
  w.attitude = normalised(w.attitude);
  return w;
}
template <Real Scalar = double>
Motion<Scalar> finely(const Problem<double>& p) {
  const auto m = Motion<Scalar>::template make<Wide>(wide(p));
  REQUIRE(m);
  return *m;
}
Motion<double> quickly(const Problem<double>& p) {
  const auto m = Motion<double>::make(p);
  REQUIRE(m);
  return *m;
}

TEST_CASE("free motions meet the reference cases", "[free]") {
  for (const auto& c : free_reference::read()) {
    if (!c.rotors.empty()) continue;
    CAPTURE(c.id);
    const auto coarse = quickly(c.problem), fine = finely(c.problem);
    const auto full = finely<Wide>(c.problem);
    for (const auto& at : c.at) {
      const State<Wide> truth{at.angular_velocity, at.angular_momentum, at.attitude};
      const Off rough = off(coarse.at(at.t), truth), good = off(fine.at(at.t), truth), best = off(full.at(at.t), truth);
      CHECK(good.rates < 1e-15);
      CHECK(good.momentum < 1e-15);
      CHECK(good.attitude < 2e-15);
      CHECK(rough.rates < 1e-15 + 4 * c.rate_ulp);
      CHECK(rough.attitude < 4e-15 + 4 * c.attitude_ulp);
      // the truth has 32 digits, 24 where it is composed of many periods
      CHECK(best.rates < (at.t > 1e3 ? 1e-24 : 1e-28));
      CHECK(best.attitude < (at.t > 1e3 ? 1e-24 : 1e-28));
    }
    if (isnan(c.period)) continue;
    CHECK(fine.period() == Approx(double(c.period)).epsilon(2e-16));
    CHECK(std::abs(std::remainder(fine.turn_per_period() - double(c.turn_per_period), 2 * pi<double>)) < 2e-15);
  }
}

TEST_CASE("free motions of every regime agree with Taylor series", "[free][length]") {
  const int count = at_length(12, 40);
  for (const Regime regime : regimes) {
    Bodies bodies(21);
    std::vector<double> rates, attitude;
    for (int i = 0; i < count; ++i) {
      const auto p = bodies.of(regime, i);
      const auto m = finely(p);
      CAPTURE(free_bodies::name(regime), i, m.modulus().kp2);
      const double period = std::isfinite(m.period()) ? m.period() : 10, K = std::min(m.quarter_period(), 50.);
      // beside a saddle the rounding of the truth grows like exp u
      const bool near = m.modulus().kp2 < 1e-3;
      const double t = (near ? .55 : 1.4) * period, lost = near ? 1e-31 * std::exp(1.4 * K) : 0;
      const auto truth = Taylor<Wide>(wide(p)).advance(t);
      const Off o = off(m.at(t), truth);
      const double slack = 2e-15 * (1 + m.cancellation(t)) + lost;
      CHECK(o.rates < slack);
      CHECK(o.momentum < slack);
      CHECK(o.attitude < slack);
      rates.push_back(o.rates), attitude.push_back(o.attitude);
    }
    std::sort(rates.begin(), rates.end());
    std::sort(attitude.begin(), attitude.end());
    CHECK(rates[std::size_t(count / 2)] < 5e-16);
    CHECK(attitude[std::size_t(count / 2)] < 1e-15);
  }
}

TEST_CASE("energy, momentum and the length of the quaternion are kept at any time", "[free]") {
  for (const Regime regime : regimes) {
    Bodies bodies(22);
    double energy = 0, momentum = 0, length = 0, identity = 0;
    for (int i = 0; i < 60; ++i) {
      const auto p = bodies.of(regime, i);
      const auto m = finely(p);
      const double T = std::isfinite(m.period()) ? m.period() : 10;
      for (const double share : {0., .3, -1.7, 1e3 + .1, 1e9}) {
        const auto s = m.at(share * T);
        const V M = p.inertia * s.angular_velocity + p.rotor_momentum;
        const double h = s.angular_velocity.dot(p.inertia * s.angular_velocity) / 2;
        energy = std::max(energy, std::abs(h / m.energy() - 1) / m.cancellation(share * T));
        momentum = std::max(momentum, (rotate<double>(s.attitude, s.angular_momentum) - m.inertial_momentum()).norm() /
                                          m.angular_momentum_norm() / m.cancellation(share * T));
        length = std::max(length, std::abs(norm(s.attitude) - 1));
        identity = std::max(identity, (M - s.angular_momentum).norm() / (p.inertia * s.angular_velocity).norm() /
                                          (1 + p.rotor_momentum.norm() / (p.inertia * s.angular_velocity).norm()) /
                                          m.cancellation(share * T));
      }
    }
    CAPTURE(free_bodies::name(regime));
    CHECK(energy < 4e-15);
    CHECK(momentum < 4e-15);
    CHECK(length < 8.9e-16);
    CHECK(identity < 2e-15);
  }
}

TEST_CASE("the start is met and both components of the spinor give one kappa", "[free]") {
  for (const Regime regime : regimes) {
    Bodies bodies(23);
    for (int i = 0; i < 60; ++i) {
      const auto p = bodies.of(regime, i);
      const auto fine = finely(p);
      const auto full = finely<Wide>(p);
      const State<Wide> start{vector_cast<Wide>(p.angular_velocity),
                              Vec3<Wide>(wide(p).inertia * wide(p).angular_velocity + wide(p).rotor_momentum),
                              wide(p).attitude};
      const Off o = off(fine.at(0), start);
      CAPTURE(free_bodies::name(regime), i);
      CHECK(o.rates < 2e-15 * fine.cancellation(0));
      CHECK(o.attitude < 1e-15);
      if (full.kind() == Kind::steady || full.is_regular_precession()) continue;
      CHECK(double(abs(full.kappa(0) - full.kappa(1))) < 1e-26 * double(full.jacobi_rate() + abs(full.kappa(0))));
    }
  }
}

TEST_CASE("a free motion with exact data is right after a thousand million periods", "[free]") {
  for (const Regime regime : {Regime::generic, Regime::middle_axis, Regime::unstable_axis}) {
    Bodies bodies(28);
    for (int i = 0; i < 60; ++i) {
      const auto p = bodies.of(regime, i);
      const auto m = finely(p);
      const auto full = finely<Wide>(p);
      if (!std::isfinite(m.period())) continue;
      const double t = 1e9 * m.period() * bodies.uniform();
      const Off o = off(m.at(t), full.at(t));
      CAPTURE(free_bodies::name(regime), i, m.modulus().kp2);
      CHECK(o.attitude < 4e-15 * m.cancellation(t));
      CHECK(o.momentum < 4e-15 * m.cancellation(t));
    }
  }
}

TEST_CASE("the defect of a free motion shows what a set-up has wrong", "[free]") {
  const double eps = epsilon<double>;
  const auto p = Problem<double>::from_moments({3, 2, 1}, {.2, -.1, .3}, {1, .3, .4});
  const auto m = Motion<double>::make<DoubleDouble>(p.cast<DoubleDouble>());
  REQUIRE(m);
  REQUIRE_FALSE(m->hyperbolic());
  for (const double t : {0., .3, 7., 1e3}) CHECK(m->defect(t, 1.2) < 8 * eps);
  // of single precision: the motion of data that are off by 6e-8 follows equations of its own, but another start
  const auto coarse = Motion<double>::make<float>(p.cast<float>());
  REQUIRE(coarse);
  CHECK(coarse->defect(1, 1.2) > 1e-9);
  CHECK(coarse->defect(1, 1.2) < 1e-5);
  const auto steady = Motion<double>::make(Problem<double>::from_moments({3, 2, 1}, {0, 0, 0}, {1, 0, 0}));
  CHECK(std::isinf(steady->defect(1, 1)));
}

TEST_CASE("a restart, time reversal, other axes and other units change nothing", "[free]") {
  Bodies bodies(24);
  for (int i = 0; i < 60; ++i) {
    const auto p = bodies.of(i % 2 ? Regime::generic : Regime::little_momentum, i);
    const auto m = finely<Wide>(p);
    const Wide T = m.period(), t1 = Wide(.37) * T, t2 = Wide(.81) * T;
    const auto end = m.at(t1 + t2);
    const auto same = [&](const State<Wide>& s, double slack) {
      const Off o = off(s, end);
      CHECK(o.rates < slack);
      CHECK(o.attitude < slack);
    };
    CAPTURE(i);
    // restart
    auto later = wide(p);
    later.angular_velocity = m.at(t1).angular_velocity;
    later.attitude = m.at(t1).attitude;
    const double slack = 1e-25 / std::min(1., double(m.modulus().kp2));
    same(Motion<Wide>::make<Wide>(later)->at(t2), slack);
    // time reversal: omega and l change their signs
    later.angular_velocity = -end.angular_velocity;
    later.rotor_momentum = -later.rotor_momentum;
    later.attitude = end.attitude;
    const auto back = Motion<Wide>::make<Wide>(later)->at(t1 + t2);
    CHECK(double((back.angular_velocity + m.at(Wide(0)).angular_velocity).norm()) <
          slack * double(end.angular_velocity.norm()));
    // turned axes, as a full tensor
    const Quat<Wide> r = normalised(Quat<Wide>{bodies.normal(), bodies.normal(), bodies.normal(), bodies.normal()});
    const Mat3<Wide> R = to_matrix(r);
    auto turned = wide(p);
    turned.inertia = R * turned.inertia * R.transpose();
    turned.rotor_momentum = R * turned.rotor_momentum;
    turned.angular_velocity = R * turned.angular_velocity;
    turned.attitude = turned.attitude * conjugate(r);
    auto s = Motion<Wide>::make<Wide>(turned)->at(t1 + t2);
    same({R.transpose() * s.angular_velocity, R.transpose() * s.angular_momentum, s.attitude * r}, slack);
    // axes in another order
    Mat3<Wide> P = Mat3<Wide>::Zero();
    P(0, 1) = P(1, 2) = P(2, 0) = 1;
    auto permuted = wide(p);
    permuted.inertia = P * permuted.inertia * P.transpose();
    permuted.rotor_momentum = P * permuted.rotor_momentum;
    permuted.angular_velocity = P * permuted.angular_velocity;
    const Quat<Wide> pq = from_matrix<Wide>(P);
    permuted.attitude = permuted.attitude * conjugate(pq);
    s = Motion<Wide>::make<Wide>(permuted)->at(t1 + t2);
    same({P.transpose() * s.angular_velocity, P.transpose() * s.angular_momentum, s.attitude * pq}, slack);
    // momenta times 3, time halved
    auto scaled = wide(p);
    scaled.inertia *= Wide(3) / 2;
    scaled.rotor_momentum *= 3;
    scaled.angular_velocity *= 2;
    s = Motion<Wide>::make<Wide>(scaled)->at((t1 + t2) / 2);
    same({s.angular_velocity / 2, s.angular_momentum / 3, s.attitude}, slack);
    // momentum given in place of rates
    auto given = wide(p);
    given.angular_momentum = given.inertia * given.angular_velocity + given.rotor_momentum;
    given.momentum_given = true;
    same(Motion<Wide>::make<Wide>(given)->at(t1 + t2), slack);
  }
}

TEST_CASE("vanishing rotor momentum is a limit without a jump", "[free]") {
  const V J(3, 2, 1.2), w(.4, .7, -.5), l(.3, -.5, .2);
  const auto rigid = finely(Problem<double>::from_moments(J, {0, 0, 0}, w));
  const double t = 20;
  double last = 0;
  for (const double size : {1e-2, 1e-5, 1e-8, 1e-12, 1e-16, 1e-30, 1e-150, 1e-300}) {
    const auto m = finely(Problem<double>::from_moments(J, size * l, w));
    const double gap = (m.at(t).angular_velocity - rigid.at(t).angular_velocity).norm();
    CHECK(gap < 30 * size + 1e-15);
    CHECK(m.kind() == rigid.kind());
    last = gap;
  }
  CHECK(last < 1e-15);
}

TEST_CASE("a rigid body on the separatrix itself follows hyperbolic functions", "[free]") {
  // inverse moments 2, 3, 4 twelfths and M1 = M3: M2 = R tanh, M1 and M3 as sech
  const auto p = Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {1, 1, 2}, normalised(Q{1, 2, 3, 4}));
  for (const auto& m : {quickly(p), finely(p)}) {
    CHECK(m.kind() == Kind::separatrix);
    CHECK(std::isinf(m.period()));
    CHECK(std::isnan(m.turn_per_period()));
    const double R = std::sqrt(88.), rate = R / 12;  // R sqrt((a2 - a1)(a3 - a2))
    for (const double t : {-8., -3., -1., 0., .5, 2., 6., 12.}) {
      const auto s = m.at(t);
      const double x = (s.angular_momentum[1] < 0 ? -1 : 1) * std::atanh(std::abs(s.angular_momentum[1]) / R);
      const double x0 = std::atanh(4 / R), sense = m.at(1).angular_momentum[1] > 4 ? 1 : -1;
      if (std::abs(t) < 4) CHECK(x == Approx(x0 + sense * rate * t).margin(1e-12));
      CHECK(s.angular_momentum[0] == Approx(s.angular_momentum[2]).margin(1e-13));
      CHECK((rotate<double>(s.attitude, s.angular_momentum) - m.inertial_momentum()).norm() < 1e-14 * R);
    }
    const auto truth = Taylor<Wide>(wide(p)).advance(5);
    CHECK(off(m.at(5), truth).attitude < 2e-14);
    // at the end a permanent rotation about the middle axis
    CHECK(std::abs(m.at(500).angular_velocity[1]) == Approx(R / 4));
    CHECK(m.at(500).angular_velocity[0] == Approx(0).margin(1e-15));
    CHECK(std::isfinite(m.at(1e6).attitude.w));
  }
}

TEST_CASE("special free motions are named and exact", "[free]") {
  const Q q0 = normalised(Q{.9, .1, -.3, .2});
  const V l(.1, -.25, .3), w(1, .5, -.7);
  {  // sphere: q = exp(a M t/2) q0 exp(-a l t/2)
    const auto m = quickly(Problem<double>::from_moments({.5, .5, .5}, l, w, q0));
    CHECK(m.kind() == Kind::spherical);
    CHECK(m.period() == Approx(2 * pi<double> * .5 / l.norm()));
    const auto s = m.at(m.period()), start = m.at(0);
    CHECK((s.angular_velocity - w).norm() < 1e-15);
    const Q turned = s.attitude * conjugate(start.attitude);
    const V axis = m.inertial_momentum().normalized();
    CHECK(std::abs(
              std::remainder(2 * std::atan2(axis.dot(V(turned.x, turned.y, turned.z)), turned.w) - m.turn_per_period(),
                             2 * pi<double>)) < 1e-14);
  }
  {  // M = 0: the body turns against its rotors
    const auto m = quickly(Problem<double>::from_moments({4, 3, 2}, {-2, -3, -.5}, {.5, 1, .25}, q0));
    CHECK(m.kind() == Kind::steady);
    CHECK(m.angular_momentum_norm() == 0);
    CHECK(std::isnan(m.period()));
    CHECK(angle_between(m.at(2).attitude, q0 * quaternion_from_vector<double>(V(1, 2, .5))) < 1e-15);
  }
  {  // at rest beside turning rotors
    const auto m = quickly(Problem<double>::from_moments({4, 3, 2}, l, {0, 0, 0}, q0));
    CHECK(m.kind() == Kind::steady);
    CHECK(angle_between(m.at(1e6).attitude, q0) < 3e-16);
  }
  // stable about the largest and the smallest moment, unstable about the middle one; with the frequencies of Euler
  const V J(4, 3, 2);
  for (int i = 0; i < 3; ++i) {
    V spin(0, 0, 0);
    spin[i] = 2;
    const auto m = quickly(Problem<double>::from_moments(J, {0, 0, 0}, spin, q0));
    CHECK(m.kind() == Kind::steady);
    const double other1 = J[(i + 1) % 3], other2 = J[(i + 2) % 3];
    CHECK(m.steady_square() == Approx(4 * (J[i] - other1) * (J[i] - other2) / other1 / other2));
  }
  // a symmetric body without rotors surrounds its axis however near to it or to the equator; with some, the kind is that of a body next to it
  for (const double tilt : {1., 1e-9, 1e-300}) {
    CHECK(quickly(Problem<double>::from_moments({2, 2, 3}, {0, 0, 0}, {tilt, 0, 1}, q0)).kind() == Kind::about_largest);
    CHECK(quickly(Problem<double>::from_moments({2, 2, 1}, {0, 0, 0}, {tilt, 0, 1}, q0)).kind() ==
          Kind::about_smallest);
    CHECK(quickly(Problem<double>::from_moments({2, 2, 1}, {0, 0, 0}, {1, 0, tilt}, q0)).kind() ==
          Kind::about_smallest);
  }
  for (const double smallest : {1., 3.})
    for (const double rotor : {-2.5, -1., -.3, .2, .9, 2.})
      for (const double along : {-1.2, -.4, .5, 1.7}) {
        const auto of = [&](double second) {
          return finely(Problem<double>::from_moments({2, second, smallest}, {0, 0, rotor}, {.6, .3, along}, q0))
              .kind();
        };
        CAPTURE(smallest, rotor, along);
        CHECK(of(2) == of(2 + 1e-9));
      }
  {  // a symmetric body without rotors, and with one along its axis: regular precession
    for (const double rotor : {0., .7, -3.}) {
      const auto m = finely(Problem<double>::from_moments({3, 3, 2}, {0, 0, rotor}, {.4, -.1, .9}, q0));
      const double rate = ((2 * .9 + rotor) - 3 * .9) / 3;
      CHECK(m.modulus_squared() < 1e-200);
      CHECK(m.period() == Approx(2 * pi<double> / std::abs(rate)).epsilon(1e-14));
      CHECK(m.at(7).angular_velocity[2] == Approx(.9).epsilon(1e-15));
      CHECK(m.at(7).angular_velocity[0] == Approx(.4 * std::cos(rate * 7) + .1 * std::sin(rate * 7)).epsilon(1e-13));
    }
  }
}

TEST_CASE("free motions allocate nothing and answer NaN by NaN", "[free]") {
  Bodies bodies(26);
  const auto before = allocations();
  double sum = 0;
  for (const Regime regime : regimes) {
    const auto p = regime == Regime::bisected ? bodies.of(Regime::generic, 1) : bodies.of(regime, 0);
    const auto m = Motion<double>::make(p);
    sum += m->at(1).angular_velocity[0] + Motion<double>::make<Wide>(p.cast<Wide>())->at(2).angular_velocity[0];
  }
  CHECK(allocations() == before);
  CHECK(std::isfinite(sum));
  for (const Problem<double>& p : {Problem<double>::from_moments({3, 2, 1.5}, {.1, 0, 0}, {1, 2, 3}),
                                   Problem<double>::from_moments({3, 2, 1.5}, {0, 0, 0}, {0, 2, 0}),
                                   Problem<double>::from_moments({3, 3, 3}, {1, 0, 0}, {1, 2, 3}),
                                   Problem<double>::from_moments({3, 2, 1.5}, {0, 0, 0}, {1e-8, 2, 0})}) {
    const auto m = quickly(p);
    for (const double t : {gyrostat::nan<double>, infinity<double>, -infinity<double>}) {
      const auto s = m.at(t);
      CHECK(std::isnan(s.attitude.w));
      CHECK(std::isnan(s.angular_velocity[0]));
    }
  }
  auto p = Problem<double>::from_moments({3, 2, 1.5}, {.1, 0, 0}, {1, gyrostat::nan<double>, 3});
  CHECK(Motion<double>::make(p).error() == Errc::not_finite);
  p = Problem<double>::from_moments({9, 2, 1.5}, {.1, 0, 0}, {1, 2, 3});
  CHECK(Motion<double>::make(p).error() == Errc::triangle_inequality);
  p = Problem<double>::from_moments({3, 2, 1.5}, {.1, 0, 0}, {1e200, 1e308, 1e308});
  CHECK(!Motion<double>::make(p));
}

TEST_CASE("thousands of random free motions are found in double", "[free][length]") {
  for (const Regime regime : regimes) {
    Bodies bodies(27);
    int refused = 0, wild = 0;
    for (int i = 0; i < at_length(400, 2000); ++i) {
      if (regime == Regime::bisected && i == 200) break;
      const auto p = bodies.of(regime, i);
      const auto m = Motion<double>::make(p);
      refused += !m;
      if (!m) continue;
      const auto s = m->at(1);
      wild += !(std::abs(rotate<double>(s.attitude, s.angular_momentum).dot(m->inertial_momentum()) /
                             m->angular_momentum_norm() / m->angular_momentum_norm() -
                         1) < 1e-9 * std::max(1., m->cancellation(1)));
    }
    CAPTURE(free_bodies::name(regime));
    CHECK(refused == 0);
    CHECK(wild == 0);
  }
}

TEMPLATE_TEST_CASE("free motions work in other numbers", "[free]", float, long double) {
  using S = TestType;
  const auto p = Problem<double>::from_moments({3, 2, 1.5}, {.25, -.5, .125}, {1, 2, 3});
  const auto m = Motion<S>::make(p.cast<S>());
  REQUIRE(m);
  const auto truth = finely<Wide>(p).at(3);
  const Off o = off(m->at(S(3)), truth);
  CHECK(o.rates < 60 * double(epsilon<S>));
  CHECK(o.attitude < 60 * double(epsilon<S>));
}

}  // namespace free_motion_test
