// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/secular.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::deceleration;
using V = Vec3<double>;

TEST_CASE("turning points are relative equilibria", "[deceleration]") {
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

TEST_CASE("no rotor momentum: the rises fill the gaps", "[deceleration]") {
  const Secular<double> q(V(1, 2, 4), V(0, 0, 0), 1.5);
  const auto r = q.rise(0);
  REQUIRE(r.exists);
  CHECK(q.sigma(r.lo) == 1);
  CHECK(q.sigma(r.hi) == 2);
  const auto root = q.rising_root(0, r, 1.5 * 1.75 / 2);
  REQUIRE(root);
  CHECK(q.sigma(*root) == Approx(1.75));
}

TEST_CASE("weights below rounding are dropped and equal poles become one", "[deceleration]") {
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
