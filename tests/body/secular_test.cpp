// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/secular.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

using namespace gyrostat;

namespace {
using V = Vec3<double>;
}

TEST_CASE("turning points are relative equilibria", "[body]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  std::normal_distribution<double> z;
  int rises = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const V a(1 + u(random), 2.5 + u(random), 4 + u(random));
    const V g = std::pow(10, -3 * u(random)) * V(z(random), z(random), z(random));
    const double R = .1 + u(random);
    const Secular<double> original(a, g, R), mirror = original.mirrored();
    for (const auto* q : {&original, &mirror}) {
      SecularPoint<double> outer;
      REQUIRE(q->turning_point(0, -1, infinity<double>, outer));
      CHECK(q->vertex(outer).norm() == Approx(R).epsilon(1e-12));
      CHECK(outer.offset < 0);
      const auto rise = q->rise(0);
      if (!rise.exists) continue;
      ++rises;
      CHECK(q->vertex(rise.lo).norm() == Approx(R).epsilon(1e-12));
      CHECK(q->vertex(rise.hi).norm() == Approx(R).epsilon(1e-12));
      CHECK(q->level(rise.lo) < q->level(rise.hi));
      const double eta = q->level(rise.lo) + u(random) * (q->level(rise.hi) - q->level(rise.lo));
      const auto root = q->rising_root(0, rise, eta);
      REQUIRE(root);
      CHECK(q->vertex(*root).norm() < R);
      const auto left = q->falling_root(0, 1, {0, 0.}, rise.lo, eta);
      const auto right = q->falling_root(0, 1, rise.hi, {1, 0.}, eta);
      REQUIRE(left);
      REQUIRE(right);
      CHECK(q->difference(*left, *root) > 0);
      CHECK(q->difference(*root, *right) > 0);
      // a root is one: its eigenvector x fulfils (E - s S) x = 0 in the last row, the others hold by its form
      for (const auto& p : {*left, *root, *right}) {
        const V v = q->vertex(p);
        const V gq(q->g(0), q->g(1), q->g(2));
        const double last = -gq.dot(v) - 2 * eta * R + q->sigma(p) * R * R;
        CHECK(std::abs(last) < 1e-13 * (std::abs(gq.dot(v)) + R * R * 5 + std::abs(eta) * R));
      }
    }
    // the mirror image has the same vertices at the opposite levels
    SecularPoint<double> outer;
    REQUIRE(mirror.turning_point(0, -1, infinity<double>, outer));
    const V v = mirror.vertex(outer);
    const V omega = a.cwiseProduct(V(v[2], v[1], v[0])) - g;
    CHECK((omega + mirror.sigma(outer) * V(v[2], v[1], v[0])).norm() < 1e-12 * (g.norm() + R * 5));
  }
  CHECK(rises > 100);
}

TEST_CASE("no rotor momentum: the rises fill the gaps", "[body]") {
  const Secular<double> q(V(1, 2, 4), V(0, 0, 0), 1.5);
  const auto r = q.rise(0);
  REQUIRE(r.exists);
  CHECK(q.sigma(r.lo) == 1);
  CHECK(q.sigma(r.hi) == 2);
  const auto root = q.rising_root(0, r, 1.5 * 1.75 / 2);
  REQUIRE(root);
  CHECK(q.sigma(*root) == Approx(1.75));
}

TEST_CASE("weights below rounding are dropped and equal poles become one", "[body]") {
  const Secular<double> dropped(V(1, 2, 4), V(1, 1e-17, 1), 1.);
  CHECK_FALSE(dropped.active(1));
  const Secular<double> merged(V(2, 2, 4), V(.3, .4, 1), 1.);
  CHECK(merged.active(0));
  CHECK_FALSE(merged.active(1));
  CHECK(merged.g(0) == Approx(.5));
  CHECK_FALSE(merged.rise(0).exists);
  const V back = merged.to_principal(V(1, 0, 0));
  CHECK((back - V(.6, .8, 0)).norm() < 1e-15);
  const V mirrored = merged.mirrored().to_principal(V(0, 0, 1));
  CHECK((mirrored - V(0, .8, .6)).norm() < 1e-15);
}

TEST_CASE("a secular equation takes gaps that the poles themselves cannot show", "[body]") {
  using D = DoubleDouble;
  const double gap = 1e-18;
  Mat3<double> gaps;
  gaps << 0, gap, 2, -gap, 0, 2, -2, -2, 0;
  const Secular<double> q(V(1, 1, 3), gaps, V(.1, 1e-20, .2), 1.);
  CHECK(q.active(1));
  const auto root = q.falling_root(0, 1, {0, 0.}, {1, 0.}, .9);
  REQUIRE(root);
  Mat3<D> wide_gaps = gaps.cast<D>();
  wide_gaps(0, 2) += gap, wide_gaps(2, 0) -= gap;
  const Secular<D> wide(Vec3<D>(1, D(1, gap), 3), wide_gaps, Vec3<D>(.1, 1e-20, .2), D(1));
  const auto wide_root = wide.falling_root(0, 1, {0, D(0)}, {1, D(0)}, D(.9));
  REQUIRE(wide_root);
  CHECK(q.difference({0, 0.}, *root) / gap ==
        Approx(static_cast<double>(wide.difference({0, D(0)}, *wide_root)) / gap).epsilon(1e-14));
  CHECK(abs(wide.value(*wide_root, D(.9))) < 1e-28 * D(.01) / D(gap));
}
