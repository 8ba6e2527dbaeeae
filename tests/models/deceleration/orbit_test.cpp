// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/orbit.hpp"

#include <cmath>
#include <new>
#include <random>

#include "catch.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "reference_cases.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;

namespace {

using V = Vec3<double>;
using VL = Vec3<long double>;

Problem<double> body(const V& J, const V& l) {
  Problem<double> p;
  p.inverse_inertia = J.cwiseInverse();
  p.rotor_momentum = l;
  return p;
}

Problem<long double> wide(const Problem<double>& p) {
  Problem<long double> q;
  q.inverse_inertia = p.inverse_inertia.cast<long double>();
  q.rotor_momentum = p.rotor_momentum.cast<long double>();
  return q;
}

V flow(const Problem<double>& p, const V& M) { return M.cross(p.angular_velocity(M)); }

template <class Scalar>
Vec3<Scalar> mean(const Orbit<Scalar>& o, int n, bool squared = false) {
  Vec3<Scalar> sum = Vec3<Scalar>::Zero();
  for (int i = 0; i < n; ++i) {
    const Vec3<Scalar> M = o.momentum_at(Scalar(i) / Scalar(n));
    sum += squared ? Vec3<Scalar>(M.cwiseProduct(M)) : M;
  }
  return sum / Scalar(n);
}

/// Random bodies: some near symmetric, some with rotor momentum on one or two axes or on none.
struct OrbitBodies {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> u{0, 1};
  std::normal_distribution<double> z;
  int trial = 0;

  double uniform() { return u(random); }
  V vector() { return {z(random), z(random), z(random)}; }

  Problem<double> next(double closest) {
    ++trial;
    double J[3];
    do {
      for (double& j : J) j = .05 + uniform();
      std::sort(J, J + 3);
    } while (J[2] > J[0] + J[1]);
    if (trial % 7 == 1) J[1] = J[2] * (1 - std::pow(closest, uniform()));
    if (trial % 7 == 2) J[0] = J[1] * (1 - std::pow(closest, uniform()));
    std::sort(J, J + 3);
    V l = std::pow(10, 1 - 6 * uniform()) * vector();
    if (trial % 5 == 1) l[trial / 5 % 3] = 0;
    if (trial % 5 == 2) l[trial / 5 % 3] = l[(trial / 5 + 1) % 3] = 0;
    if (trial % 25 == 3) l.setZero();
    return body({J[2], J[1], J[0]}, l);
  }
};

}  // namespace

TEST_CASE("reference orbits", "[deceleration]") {
  for (const auto& c : reference_cases) {
    INFO(c.id);
    const auto p = body(V(c.J), V(c.l));
    const auto o = Orbit<double>::through(p, V(c.M0));
    REQUIRE(o);
    CHECK(symbol(o->regime())[0] == c.type);
    CHECK(o->branch() == c.branch);
    CHECK(std::abs(o->modulus().k2 - c.k2) < 2e-12 * c.k2 + 1e-15);
    CHECK(o->period() == Approx(c.period).epsilon(2e-12));
    CHECK((mean(*o, 256) - V(c.mean)).norm() < 1e-12 * V(c.M0).norm());
    CHECK((mean(*o, 256, true) - V(c.square)).norm() < 1e-12 * V(c.M0).squaredNorm());
  }
}

TEST_CASE("an orbit keeps |M| and h, moves with the flow, and knows the phase of its points", "[deceleration]") {
  OrbitBodies bodies;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto p = bodies.next(1e-4);
    const V M = bodies.vector();
    const auto o = Orbit<double>::through(p, M);
    INFO(trial << " " << message(o.error()));
    REQUIRE(o);
    const double R = M.norm(), scale = (R * p.inverse_inertia).norm() + p.gyro_rate().norm();
    const double phase = o->phase_of(M);
    CHECK((phase >= 0 && phase < 1));
    CHECK((o->momentum_at(phase) - M).norm() < 2e-9 * R);
    for (const double x : {.05, .3, .6, .9}) {
      const V at = o->momentum_at(phase + x);
      CHECK(at.norm() == Approx(R).epsilon(1e-9));
      const auto level = level_of(p, at);
      CHECK(std::abs(level.eta - o->level().eta) < 1e-9 * scale);
      const double d = 1e-4 * std::sqrt(o->modulus().kp2);
      const V slope = (o->momentum_at(phase + x + d) - o->momentum_at(phase + x - d)) / (2 * d * o->period());
      CHECK((slope - flow(p, at)).norm() < 1e-5 * R * scale);
      double turns = o->phase_of(at) - phase - x;
      turns -= std::round(turns);
      // the phase is as uncertain as the point is slow
      CHECK(std::abs(turns) * o->period() * flow(p, at).norm() < 1e-7 * R);
    }
  }
}

TEST_CASE("orbits of random bodies agree with integration in long double", "[deceleration]") {
  OrbitBodies bodies;
  double worst = 0;
  int compared = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto p = bodies.next(1e-3);
    const V M = bodies.vector();
    const auto o = Orbit<double>::through(p, M);
    REQUIRE(o);
    if (o->modulus().kp2 < 1e-5) continue;
    const auto q = wide(p);
    const auto rhs = [&](long double, const std::array<long double, 6>& y, std::array<long double, 6>& d) noexcept {
      const VL m(y[0], y[1], y[2]);
      const VL f = m.cross(q.angular_velocity(m));
      d = {f[0], f[1], f[2], y[0], y[1], y[2]};
    };
    ode::StepControl<long double, 6> control;
    control.relative = 1e-14L;
    control.absolute.fill(1e-15L);
    ode::RungeKutta<long double, 6, decltype(rhs)> solver(rhs, 0.L, {M[0], M[1], M[2], 0, 0, 0}, control);
    REQUIRE(solver.advance(o->period()) == ode::Status::reached);
    const auto& y = solver.state();
    const V back{double(y[0]), double(y[1]), double(y[2])};
    const V average = V{double(y[3]), double(y[4]), double(y[5])} / o->period();
    worst = std::max({worst, (back - M).norm() / M.norm(), (average - mean(*o, 512)).norm() / M.norm()});
    ++compared;
  }
  CHECK(compared > 250);
  CHECK(worst < 1e-9);
}

TEST_CASE("rounding: double against long double", "[deceleration]") {
  OrbitBodies bodies;
  int bad = 0, trials = 3000;
  for (int trial = 0; trial < trials; ++trial) {
    const auto p = bodies.next(1e-3);
    const V M = bodies.vector();
    const auto o = Orbit<double>::through(p, M);
    const auto w = Orbit<long double>::through(wide(p), M.cast<long double>());
    REQUIRE(o);
    REQUIRE(w);
    if (o->modulus().kp2 < 1e-4) continue;  // conditioned like eps over the distance to the separatrix
    REQUIRE(o->regime() == w->regime());
    REQUIRE(o->branch() == w->branch());
    const double e = double((mean(*o, 64).cast<long double>() - mean(*w, 64)).norm()) / M.norm();
    const double t = double(std::abs(o->period() / w->period() - 1));
    INFO(trial << " " << symbol(o->regime()) << " kp2 " << o->modulus().kp2 << " l " << p.rotor_momentum.transpose()
               << " T " << t);
    CHECK(e < 1e-9);
    if (e > 1e-12 || t > 1e-12) ++bad;
  }
  CHECK(bad < trials / 100);
}

TEST_CASE("float", "[deceleration]") {
  Problem<float> p;
  p.inverse_inertia = {1 / 1.4f, 1, 1 / .7f};
  p.rotor_momentum = {.2f, .15f, .3f};
  const auto o = Orbit<float>::through(p, {.8f, .5f, .33f});
  REQUIRE(o);
  CHECK(o->period() == Approx(11.726697).epsilon(1e-5));
}

TEST_CASE("without rotor momentum the orbit is the polhode of Euler and Poinsot", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {0, 0, 0});
  for (const V& M : {V(.8, .5, .33), V(.1, .5, .9), V(-.8, .5, .33), V(-.2, .4, -.9)}) {
    const auto o = Orbit<double>::through(p, M);
    REQUIRE(o);
    const int axis = o->regime() == Regime::about_largest ? 0 : 2;
    CHECK(o->branch() == (M[axis] > 0 ? 1 : -1));
    // u = 0: the middle component vanishes and the far one has the sign opposite to the branch
    const V start = o->momentum_at(0);
    CHECK(std::abs(start[1]) < 1e-15);
    CHECK(start[axis] * o->branch() > 0);
    CHECK(start[2 - axis] * o->branch() < 0);
    CHECK(o->momentum_at(.1)[1] > 0);
    // the mirror symmetric momentum has the mirror symmetric orbit
    const auto r = Orbit<double>::through(p, -M);
    REQUIRE(r);
    CHECK(r->period() == Approx(o->period()).epsilon(1e-14));
    CHECK(r->branch() == -o->branch());
  }
}

TEST_CASE("vanishing rotor momentum: no jump at the way to l = 0", "[deceleration]") {
  const V M(.8, .5, .33), none(0, 0, 0), l(.2, .15, .3);
  const V limit = mean(*Orbit<double>::through(body({1.4, 1, .7}, none), M), 128);
  for (int k = 1; k < 40; ++k) {
    const double size = std::pow(10, -.5 * k);
    const auto o = Orbit<double>::through(body({1.4, 1, .7}, size * l), M);
    REQUIRE(o);
    CHECK((mean(*o, 128) - limit).norm() < 20 * size + 1e-14);
  }
}

TEST_CASE("symmetric bodies", "[deceleration]") {
  SECTION("oblate and prolate, with and without rotor momentum, along and across the axis") {
    for (const V& J : {V(1.2, 1.2, .7), V(1.2, .8, .8)})
      for (const V& l :
           {V(0, 0, 0), V(.1, 0, 0), V(0, .1, 0), V(0, 0, .1), V(.1, -.2, .3), V(30, 20, 10), V(1e-9, 2e-9, 0)}) {
        const auto p = body(J, l);
        const V M(.5, -.6, .7);
        const auto o = Orbit<double>::through(p, M);
        INFO(J << " / " << l << " / " << message(o.error()));
        REQUIRE(o);
        const double x = o->phase_of(M), d = 1e-4;
        CHECK((o->momentum_at(x) - M).norm() < 1e-10);
        CHECK(((o->momentum_at(x + d) - o->momentum_at(x - d)) / (2 * d * o->period()) - flow(p, M)).norm() <
              1e-5 * flow(p, M).norm() + 1e-7);
      }
  }
  SECTION("l = 0, A = B: regular precession, k2 = 0") {
    const auto o = Orbit<double>::through(body({1.2, 1.2, .7}, {0, 0, 0}), {.5, -.6, .7});
    REQUIRE(o);
    CHECK(o->regime() == Regime::about_smallest);
    CHECK(o->modulus().k2 == 0);
    CHECK(o->period() == Approx(2 * pi<double> / ((1 / .7 - 1 / 1.2) * .7)).epsilon(1e-14));
    const V square = mean(*o, 16, true);
    CHECK(square[0] == Approx(square[1]).epsilon(1e-14));
  }
  SECTION("rotor momentum on the axis: steady precession, also where the carrier does not spin about it") {
    for (const V& J : {V(1.2, 1.2, .7), V(1.2, .8, .8)}) {
      const int axis = J[0] == J[1] ? 2 : 0;
      for (const double l : {1e-3, .1, 20.})
        for (const double spin : {-2., -1e-9, 0., 1e-9, 1e-2, .3}) {
          V rotor = V::Zero(), rate = V(.01, .4, -.02);
          rotor[axis] = l, rate[axis] = spin;
          const auto p = body(J, rotor);
          const V M = J.cwiseProduct(rate) + rotor;
          const auto o = Orbit<double>::through(p, M);
          CAPTURE(axis, l, spin);
          REQUIRE(o);
          CHECK(o->modulus().k2 == 0);
          CHECK((o->momentum_at(o->phase_of(M)) - M).norm() < 1e-8 * M.norm());
          const double turning = M[axis] * (p.inverse_inertia[axis] - p.inverse_inertia[1]) - l / J[axis];
          CHECK(o->period() == Approx(2 * pi<double> / std::abs(turning)).epsilon(1e-10));
        }
    }
  }
  SECTION("a sphere has no free orbit of this kind") {
    CHECK(Orbit<double>::through(body({1, 1, 1}, {.1, .2, .3}), {1, 2, 3}).error() == Errc::not_applicable);
  }
  SECTION("slightly unequal moments down to the last bit") {
    for (int k = 1; k < 17; ++k)
      for (const double s : {1., 1e-6}) {
        const auto p = body({1.2, 1.2 * (1 - std::pow(10, -k)), .7}, V(.1, -.2, .3) * s);
        const V M(.5, -.6, .7);
        const auto o = Orbit<double>::through(p, M);
        REQUIRE(o);
        CHECK((o->momentum_at(o->phase_of(M)) - M).norm() < 1e-9);
      }
  }
}

TEST_CASE("equilibria are points", "[deceleration]") {
  OrbitBodies bodies;
  for (int trial = 0; trial < 300; ++trial) {
    const auto p = bodies.next(1e-2);
    const double R = .1 + bodies.uniform();
    // far outside the possible energies
    for (const double sign : {-1., 1.}) {
      const double big = 10 * (R * p.inverse_inertia[2] + p.gyro_rate().norm());
      const auto o = Orbit<double>::at(p, {R, sign * big}, {Regime::one_component, 0});
      INFO(message(o.error()));
      REQUIRE(o);
      CHECK(o->regime() == Regime::point);
      const V M = o->momentum_at(.3);
      CHECK(M.norm() == Approx(R).epsilon(1e-12));
      CHECK(flow(p, M).norm() < 1e-12 * R * big);
      CHECK(level_of(p, M).eta == Approx(o->level().eta).margin(1e-12 * big));
      CHECK(o->period() > 0);
      CHECK(o->modulus().k2 == 0);
      // the same equilibrium given by its momentum: at most a tiny circle, with the same period
      const auto near = Orbit<double>::through(p, M);
      INFO(message(near.error()));
      REQUIRE(near);
      CHECK((mean(*near, 16) - M).norm() < 1e-9 * R);
      CHECK(near->period() == Approx(o->period()).epsilon(1e-3));
      // shrinking circles around it
      for (int k = 2; k < 8; ++k) {
        const V aside = (M + std::pow(10, -k) * R * bodies.vector()).normalized() * R;
        const auto circle = Orbit<double>::through(p, aside);
        REQUIRE(circle);
        // the level knows the size of a circle to the root of rounding
        CHECK((circle->momentum_at(circle->phase_of(aside)) - aside).norm() < 5e-7 * R);
      }
    }
  }
}

TEST_CASE("a lobe overstepped at its centre becomes that centre", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {.03, .02, .01});
  const Secular<double> q(p.inverse_inertia, p.gyro_rate(), 1.);
  const auto rise = q.rise(0);
  REQUIRE(rise.exists);
  const double birth = q.level(rise.lo);
  const auto younger = Orbit<double>::at(p, {1., birth - 1e-4}, {Regime::about_largest, -1});
  REQUIRE(younger);
  CHECK(younger->regime() == Regime::point);
  CHECK(younger->momentum_at(0)[0] < 0);
  CHECK(flow(p, younger->momentum_at(0)).norm() < 1e-12);
  // the older lobe does not notice
  const auto older = Orbit<double>::at(p, {1., birth - 1e-4}, {Regime::about_largest, 1});
  REQUIRE(older);
  CHECK(older->regime() == Regime::one_component);
  CHECK(mean(*older, 64)[0] > .5);
}

TEST_CASE("through the birth of the other lobe the orbit is smooth", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {.03, .02, .01});
  const Secular<double> q(p.inverse_inertia, p.gyro_rate(), 1.);
  const double birth = q.level(q.rise(0).lo);
  V last(0, 0, 0);
  double step = 0;
  Component followed;
  std::vector<double> etas;
  for (int k = 2; k <= 16; ++k) etas.push_back(birth - std::pow(10, -k));
  etas.push_back(birth);
  for (int k = 16; k >= 2; --k) etas.push_back(birth + std::pow(10, -k));
  for (std::size_t i = 0; i < etas.size(); ++i) {
    const auto o = Orbit<double>::at(p, {1., etas[i]}, followed);
    INFO(etas[i] - birth << " " << message(o.error()));
    REQUIRE(o);
    const V m = mean(*o, 64);
    if (i > 0) {
      step = etas[i] - etas[i - 1];
      CHECK((m - last).norm() < 5 * step + 2e-8);
    }
    last = m;
    followed = o->component();
  }
  CHECK(followed.regime == Regime::about_largest);
  CHECK(followed.branch == 1);
}

TEST_CASE("near the separatrix the period grows and the error is honest", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {.03, .02, .01});
  const Secular<double> q(p.inverse_inertia, p.gyro_rate(), 1.);
  const double saddle = q.level(q.rise(0).hi);
  double before = 0;
  for (int k = 3; k < 12; ++k) {
    const auto lobe = Orbit<double>::at(p, {1., saddle - std::pow(10, -k)}, {Regime::about_largest, 1});
    const auto outer = Orbit<double>::at(p, {1., saddle + std::pow(10, -k)}, {});
    REQUIRE(lobe);
    REQUIRE(outer);
    CHECK(lobe->period() > before);
    // an outer turn goes round both lobes
    const auto other = Orbit<double>::at(p, {1., saddle - std::pow(10, -k)}, {Regime::about_largest, -1});
    REQUIRE(other);
    if (k > 5) CHECK(outer->period() == Approx(lobe->period() + other->period()).epsilon(.02));
    before = lobe->period();
  }
  // which lobe is not the orbit's to say
  CHECK(Orbit<double>::at(p, {1., saddle - 1e-6}, {}).error() == Errc::undetermined);
}

TEST_CASE("the separatrix itself, and equilibria without a frequency, have no orbit", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {0, 0, 0});
  CHECK(Orbit<double>::through(p, {0, 1, 0}).error() == Errc::separatrix);
  const auto circle = Orbit<double>::through(body({1.2, 1.2, .7}, {0, 0, 0}), {.6, .8, 0});
  CHECK((circle.error() == Errc::separatrix || circle->period() > 1e6));
}

TEST_CASE("small momentum: regular as R -> 0", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {.2, .15, .3});
  for (int k = 1; k < 150; k += 7) {
    const V M = std::pow(10, -k) * V(.5, -.3, .2);
    const auto o = Orbit<double>::through(p, M);
    INFO(k << " " << message(o.error()));
    REQUIRE(o);
    CHECK(o->regime() == Regime::one_component);
    CHECK((o->momentum_at(o->phase_of(M)) - M).norm() / M.norm() < 1e-12);
    if (k > 8) CHECK(o->period() == Approx(2 * pi<double> / p.gyro_rate().norm()).epsilon(1e-6));
  }
}

TEST_CASE("a level within rounding of an equilibrium's has an orbit", "[deceleration]") {
  const V a(8035.0582867391722, 8676.3189897155808, 9268.5726525713162);
  Problem<double> p;
  p.inverse_inertia = a;
  p.rotor_momentum.setZero();
  for (int i = 0; i < 2000; ++i) {
    const double R = 1.5e-4 * (1 + 1e-4 * i);
    for (const auto& [axis, regime] : {std::pair{0, Regime::about_largest}, std::pair{2, Regime::about_smallest}})
      for (int ulps = -3; ulps <= 3; ++ulps) {
        const double eta = R * a[axis] / 2 * (1 + ulps * epsilon<double> / 2);
        const auto orbit = Orbit<double>::at(p, {R, eta}, {regime, -1});
        REQUIRE(orbit);
        CHECK(orbit->modulus().k2 < 1e-12);
        CHECK(orbit->lobe() == regime);
      }
  }
}

TEST_CASE("bad arguments", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {.2, .15, .3});
  CHECK(Orbit<double>::through(p, {0, 0, 0}).error() == Errc::zero_vector);
  CHECK(Orbit<double>::through(p, {gyrostat::nan<double>, 0, 0}).error() == Errc::not_finite);
  CHECK(Orbit<double>::at(p, {1., infinity<double>}, {}).error() == Errc::not_finite);
  CHECK(Orbit<double>::at(p, {-1., .1}, {}).error() == Errc::not_positive);
  CHECK(Orbit<double>::through(body({1.4, -1, .7}, {0, 0, gyrostat::nan<double>}), {1, 1, 1}).error() ==
        Errc::not_finite);
}

TEST_CASE("alignment moves the origin of phase by quarters", "[deceleration]") {
  const auto p = body({1.4, 1, .7}, {.2, .15, .3});
  const auto o = Orbit<double>::through(p, {.8, .5, .33});
  REQUIRE(o);
  double spread = 1;
  const auto same = o->aligned_to(*o, &spread);
  CHECK(same.quarter() == o->quarter());
  CHECK(spread == 0);

  // l2 = 0: the axes of the frame change places where k2 passes 0; aligned orbits do not
  const auto symmetric = body({1.4, 1, .7}, {0., .15, .3});
  Orbit<double> previous;
  bool relabelled = false;
  double low = 1;
  for (int i = 0; i <= 4000; ++i) {
    const double R = 1.2 - i * 2.5e-4;
    const auto raw = Orbit<double>::at(symmetric, {R, -.05}, {});
    if (!raw) continue;
    const auto next = i == 0 ? *raw : raw->aligned_to(previous, &spread);
    if (i > 0) {
      CHECK((next.momentum_at(.1) / R - previous.momentum_at(.1) / previous.level().R).norm() < .1);
      relabelled = relabelled || next.quarter() != 0;
    }
    low = std::min(low, raw->modulus().k2);
    previous = next;
  }
  INFO("least k2 " << low);
  CHECK(previous.period() > 0);
}

TEST_CASE("an orbit does not hang on where its momentum lies in memory", "[deceleration]") {
  const auto p = body({10, 8, 5}, {40, 30, 20});
  alignas(64) double buffer[24];
  for (int i = 0; i < 50; ++i) {
    const V M(30 + 0.1 * i, 25 - 0.07 * i, 18 + 0.03 * i);
    const auto first = Orbit<double>::through(p, M);
    REQUIRE(first);
    for (int place = 0; place < 16; ++place) {
      const V& there = *new (buffer + place) V(M);
      const auto again = Orbit<double>::through(p, there);
      REQUIRE(again);
      CHECK(again->modulus().k2 == first->modulus().k2);
      CHECK(again->level().eta == first->level().eta);
      CHECK(again->phase_of(there) == first->phase_of(M));
    }
  }
}

TEST_CASE("orbit: a dual spinner that was on one component stays where it was when a second lobe is born",
          "[deceleration]") {
  for (const double last : {0.7, 1.4})
    for (const double l : {-20., 20.})
      for (const double side : {-0.9, -0.4, 0.25, 0.5}) {
        CAPTURE(last, l, side);
        const int axis = last > 1 ? 0 : 2;
        Problem<double> p;
        p.inverse_inertia = Vec3<double>(1, 1, 1);
        p.inverse_inertia[axis] = 1 / last;
        p.rotor_momentum[axis] = l;
        // M does not turn where its part along the axis is `still`, and the other lobe is born at the pole on that side
        const double far = 1 / last - 1, g = l / last, R = std::abs(g / far) / 0.6, still = g / (R * far);
        const double n = side * (still > 0 ? 1 : -1);
        Vec3<double> M = Vec3<double>::Zero();
        M[axis] = n * R, M[1] = std::sqrt(1 - n * n) * R;
        const auto orbit = Orbit<double>::at(p, level_of(p, M), {Regime::one_component, 0});
        REQUIRE(orbit);
        CHECK(orbit->momentum_at(0.3)[axis] / R == Approx(n).margin(1e-7));
      }
}
