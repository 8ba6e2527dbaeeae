// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/euler_poinsot.hpp"

#include "bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

namespace {

V flow(const V& a, const V& M) { return cross<double>(M, a.cwiseProduct(M)); }

/// Distance of M from where its polhode and argument put it back.
double round_trip(const V& a, const V& M) {
  const auto p = polhode_through<double>(a, M);
  return (momentum_on<>(p, M.norm(), argument_of<>(p, M)) - M).norm() / M.norm();
}

}  // namespace

TEST_CASE("polhode and argument put M back where it was", "[deceleration]") {
  Bodies bodies(2);
  int largest = 0, smallest = 0;
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const V a = bodies.inverse_inertia(), M = bodies.vector();
    const auto p = polhode_through<double>(a, M);
    ++(p.regime == Regime::about_largest ? largest : smallest);
    CHECK(p.modulus.k2 >= 0);
    CHECK(p.modulus.kp2 >= 0);
    CHECK(p.modulus.k2 + p.modulus.kp2 == Approx(1).epsilon(1e-13));
    CHECK(p.tilt <= p.axes.separatrix_tilt() * (1 + 1e-12));
    CHECK(p.energy_ratio() == Approx(M.dot(a.cwiseProduct(M)) / M.squaredNorm()).epsilon(1e-13));
    worst = std::max(worst, round_trip(a, M));
  }
  CHECK(worst < 1e-12);
  CHECK(largest > 500);
  CHECK(smallest > 500);
}

TEST_CASE("the polhode is the free motion", "[deceleration]") {
  Bodies bodies(3);
  for (int trial = 0; trial < 300; ++trial) {
    const V a = bodies.inverse_inertia(), M = bodies.vector();
    const double R = M.norm();
    const auto p = polhode_through<double>(a, M);
    if (p.modulus.kp2 < 1e-3) continue;
    for (double u = -4; u < 4; u += .7) {
      const V at = momentum_on<>(p, R, u);
      CHECK(at.norm() == Approx(R).epsilon(1e-13));
      CHECK(at.dot(a.cwiseProduct(at)) == Approx(M.dot(a.cwiseProduct(M))).epsilon(1e-12));
      const double h = 1e-5;  // u grows with time at rate_per_momentum |M|
      const V slope = (momentum_on<>(p, R, u + h) - momentum_on<>(p, R, u - h)) / (2 * h) * p.rate_per_momentum() * R;
      CHECK((slope - flow(a, at)).norm() < 1e-7 * (a[2] - a[0]) * R * R);
    }
  }
}

TEST_CASE("the two regimes are one with the outer axes exchanged", "[deceleration]") {
  Bodies bodies(4);
  for (int trial = 0; trial < 200; ++trial) {
    const V a = bodies.inverse_inertia(), M = bodies.vector();
    // the reflection a_i -> a_1 + a_3 - a_(4-i) turns the energy ratio around
    const V mirrored(a[0], a[0] + a[2] - a[1], a[2]);
    const auto p = polhode_through<double>(a, M), q = polhode_through<double>(mirrored, V(M[2], M[1], M[0]));
    CHECK(p.regime != q.regime);
    CHECK(p.modulus.k2 == Approx(q.modulus.k2).epsilon(1e-10).margin(1e-300));
    CHECK(p.modulus.kp2 == Approx(q.modulus.kp2).epsilon(1e-7).margin(1e-12));
    CHECK(p.tilt == Approx(q.tilt).epsilon(1e-12));
  }
}

TEST_CASE("a slim body in a flat spin keeps its rate and its momentum along the axis", "[deceleration]") {
  using L = Vec3<long double>;
  for (const double slim : {1e-3, 1e-6, 1e-9})
    for (const double middle : {1., 1 - 1e-14, .9})
      for (const double spin : {1., 1e-3}) {
        const V a(1, 1 / middle, 1 / slim), M(.3, .2, .1 * spin * slim);
        const auto p = polhode_through<double>(a, M);
        const auto exact = polhode_through<long double>(a.cast<long double>(), M.cast<long double>());
        CAPTURE(slim, middle, spin);
        REQUIRE(p.regime == exact.regime);
        CHECK(p.along == Approx(double(exact.along)).epsilon(1e-14));
        CHECK(p.rate_per_momentum() == Approx(double(exact.rate_per_momentum())).epsilon(1e-14));
        if (!(exact.modulus.kp2 > 1e-3L)) continue;
        for (const double u : {0., .4, 2.}) {
          const V now = momentum_on<>(p, M.norm(), u);
          const L truth = momentum_on<>(exact, M.cast<long double>().norm(), static_cast<long double>(u));
          CHECK(now[p.axes.near] == Approx(double(truth[p.axes.near])).epsilon(1e-13));
        }
      }
}

TEST_CASE("small moduli and complements keep their digits", "[deceleration]") {
  const V a(1 / 1.4, 1, 1 / .7);
  for (double tilt = 1e-1; tilt > 1e-30; tilt *= 1e-3) {
    // M tilted by a small angle to axis 1
    const V M(1, tilt, 0);
    const auto p = polhode_through<double>(a, M);
    const long double A = 1 / 1.4L, C = 1 / static_cast<long double>(.7);
    const long double m2 = static_cast<long double>(tilt) * tilt;
    const long double k2 = (C - 1) * (1 - A) * m2 / ((1 - A) * ((C - A) + (C - 1) * m2));
    CHECK(p.modulus.k2 == Approx(static_cast<double>(k2)).epsilon(1e-14));
    CHECK(round_trip(a, M) < 1e-15);
    // and towards the axis of middle inertia, which the separatrix meets
    const auto s = polhode_through<double>(a, V(tilt, 1, 0));
    CHECK(s.regime == Regime::about_largest);
    CHECK(s.modulus.kp2 == Approx(tilt * tilt * (C - A) / (C - 1)).epsilon(2 * tilt * tilt + 1e-14));
    CHECK(round_trip(a, V(tilt, 1, 0)) < 1e-14);
  }
}

TEST_CASE("axes of symmetry and equilibria", "[deceleration]") {
  const auto near3 = polhode_through<double>(V(1, 1, 2), V(.3, .4, .5));  // A = B: a circle around axis 3
  CHECK(near3.regime == Regime::about_smallest);
  CHECK(near3.modulus.k2 == 0);
  CHECK(near3.modulus.kp2 == 1);
  CHECK(near3.axes.axisymmetric());
  CHECK(near3.tilt == Approx(.5));
  CHECK(round_trip(V(1, 1, 2), V(.3, .4, .5)) < 1e-15);
  const auto near1 = polhode_through<double>(V(1, 2, 2), V(-.3, .4, .5));  // B = C
  CHECK(near1.regime == Regime::about_largest);
  CHECK(near1.side == -1);
  CHECK(near1.modulus.k2 == 0);
  CHECK(round_trip(V(1, 2, 2), V(-.3, .4, .5)) < 1e-15);
  CHECK(std::isnan(polhode_through<double>(V(1, 1, 1), V(1, 2, 3)).modulus.k2));  // a sphere
  for (int axis : {0, 2}) {
    const auto p = polhode_through<double>(V(1, 1.5, 2), V(-2 * V::Unit(axis)));
    CHECK(p.modulus.k2 == 0);
    CHECK(p.side == -1);
    CHECK(momentum_on<>(p, 2., .3) == V(-2 * V::Unit(axis)));
  }
  const auto middle = polhode_through<double>(V(1, 1.5, 2), V(0, 1, 0));
  CHECK(middle.modulus.kp2 == 0);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(polhode_through<double>(V(1, 1.5, 2), V(bad, 1, 1)).modulus.k2));
}

TEST_CASE("moving along the family keeps the polhode's law", "[deceleration]") {
  Bodies bodies(5);
  for (int trial = 0; trial < 100; ++trial) {
    const V a = bodies.inverse_inertia(), M = bodies.vector();
    const auto p = polhode_through<double>(a, M);
    CHECK(at_modulus(p, p.modulus).tilt == Approx(p.tilt).epsilon(1e-12));
    const double kp2 = bodies.uniform(.01, .99);
    const auto q = at_modulus(p, {1 - kp2, kp2});
    const auto back = polhode_through<double>(a, momentum_on<>(q, 2., bodies.uniform(-3, 3)));
    CHECK(back.regime == p.regime);
    CHECK(back.side == p.side);
    CHECK(back.modulus.kp2 == Approx(kp2).epsilon(1e-10));
  }
}

TEST_CASE("each number of a polhode has its own relative accuracy, by every component of M", "[deceleration]") {
  Bodies bodies(8);
  for (int trial = 0; trial < 500; ++trial) {
    const V a = bodies.inverse_inertia(), part = bodies.vector(), small = bodies.vector();
    const Vec3<float> gaps(float(a[1] - a[0]), float(a[2] - a[1]), float(a[2] - a[0]));
    Vec3<float> M;
    for (int i = 0; i < 3; ++i) M[i] = float(part[i] * std::pow(10, -3 * std::abs(small[i])));
    const auto rounded = polhode_through<float>(a.cast<float>(), gaps, M);
    const auto truth = polhode_through<double>(a, gaps.cast<double>(), M.cast<double>());
    if (rounded.regime != truth.regime) continue;  // on the separatrix, to rounding
    const auto off = [](float x, double y) { return std::abs(double(x) / y - 1); };
    CHECK(off(rounded.tilt, truth.tilt) < 8 * epsilon<float>);
    CHECK(off(rounded.along, truth.along) < 8 * epsilon<float>);
    CHECK(off(rounded.modulus.k2, truth.modulus.k2) < 8 * epsilon<float>);
    const auto& x = truth.axes;
    const V m = M.cast<double>().cwiseAbs2();
    const double inside = x.near_mid * m[x.near], outside = x.mid_far * m[x.far];
    CHECK(off(rounded.modulus.kp2, truth.modulus.kp2) < 8 * epsilon<float> * (inside + outside) / (inside - outside));
  }
}

TEST_CASE("rounding does not put the modulus of a polhode out of [0, 1]", "[deceleration]") {
  Bodies bodies(9);
  int over = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const V a = bodies.inverse_inertia();
    for (const int near : {0, 2}) {
      const double M = bodies.uniform(.3, 3);
      const auto on_axis = polhode_through<double>(a, V(M * V::Unit(near)));
      const auto& x = on_axis.axes;
      over += x.near_far * (x.near_mid * (M * M)) / (x.near_mid * (x.near_far * (M * M))) > 1;
      CHECK(on_axis.modulus.k2 == 0);
      CHECK(on_axis.modulus.kp2 <= 1);
      CHECK(on_axis.modulus.kp2 == Approx(1).epsilon(1e-15));
      CHECK(on_axis.along == 1);
      V edge(0, 0, 0);  // on the separatrix, to rounding
      edge[near] = M * std::sqrt(x.mid_far);
      edge[2 - near] = M * std::sqrt(x.near_mid);
      CHECK(polhode_through<double>(a, edge).modulus.k2 <= 1);
    }
  }
  CHECK(over > 100);
}

TEST_CASE("the energy of a polhode keeps its digits where M lies across the slight axis of a slim body",
          "[deceleration]") {
  for (const double slight : {1e-2, 1e-5, 1e-8})
    for (const double share : {1e-1, 1e-3, 1e-6}) {
      const V a(1, 1 + 1e-6, 1 / slight), M(.3, 1, share * slight);
      const auto p = polhode_through<double>(a, M);
      const Vec3<long double> wide = a.cast<long double>(), momentum = M.cast<long double>();
      const long double truth = momentum.dot(wide.cwiseProduct(momentum)) / momentum.squaredNorm();
      CAPTURE(slight, share);
      CHECK(std::abs(double(p.energy_ratio() / truth - 1)) < 8 * epsilon<double>);
    }
}
