// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/attractor.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "models/rotor/bodies.hpp"
#include "models/rotor/momentum_motion.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

namespace {

/// Where a short-step gradient flow of F ends, down (sign 1) or up (-1).
int flow(const Gyrostat<double>& g, const SteadyRotations<double>& all, double l, Vec3<double> m, int sign = 1) {
  const double h = g.target_momentum(), step = sign * 0.02 * g.principal()[0] / (l * l + std::abs(h) * l);
  const SteadyType wanted = sign > 0 ? SteadyType::minimum : SteadyType::maximum;
  for (int i = 0; i < 200000; ++i) {
    Vec3<double> slope = l * (g.inverse_inertia() * (l * m - h * g.axis()));
    slope -= slope.dot(m) * m;
    m = (m - step * slope).normalized();
    if (i % 100 == 0)
      for (int j = 0; j < all.count; ++j)
        if (all[j].type == wanted && (m - all[j].direction).norm() < 1e-3) return j;
  }
  return -1;
}

int minima(const SteadyRotations<double>& all) {
  return int(std::count_if(all.begin(), all.end(), [](const auto& r) { return r.type == SteadyType::minimum; }));
}

Attractor<double> certify(const MomentumMotion& motion, const SteadyRotations<double>& all) {
  return rotor::certify(motion.body, all, motion.H, motion.p);
}

}  // namespace

TEST_CASE("200 captures end where the certificate said") {
  Bodies bodies(17);
  int low = 0, high = 0, early = 0;
  for (int run = 0; run < 200; ++run) {
    const auto g = reference_body(run % 2 == 0 ? 0.2 : 1.0, 3);
    const double l = 8;
    const auto all = steady_rotations(g, l);
    auto motion = MomentumMotion::from(g, l, bodies.direction(), run % 3 == 0 ? -40 : bodies.uniform(-3, 3));
    const double dt = 0.04;
    Attractor<double> said;
    double margin = infinity<double>;
    int steps = 0;
    for (; steps < 30000; ++steps) {
      said = certify(motion, all);
      CHECK(said.margin <= margin + 1e-9);  // V falls
      margin = said.margin;
      if (said.certificate != Certificate::undecided) break;
      CHECK(said.index == -1);
      for (int i = 0; i < 25; ++i) motion.step(dt);
    }
    REQUIRE(said.certificate == Certificate::by_level);
    CHECK(said.margin < 0);
    CHECK(all[said.index].type == SteadyType::minimum);
    early += steps == 0;
    // much later it is there, or at least far below the saddle and closer to that minimum
    for (int i = 0; i < 5000; ++i) motion.step(dt);
    double least = 10;
    int there = -1;
    for (int i = 0; i < all.count; ++i)
      if (const double d = (motion.direction() - all[i].direction).norm();
          all[i].type == SteadyType::minimum && d < least)
        least = d, there = i;
    CHECK(there == said.index);
    CHECK(least < 0.4);
    CHECK(certify(motion, all).index == said.index);
    (said.index == 0 ? low : high) += 1;
  }
  CHECK(low > 100);
  CHECK(high > 20);
  CHECK(early > 10);
}

TEST_CASE("the descent ends where the gradient flow ends") {
  Bodies bodies(23);
  int tested = 0, far = 0;
  while (tested < 300) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(2, 30) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    if (minima(all) < 2) continue;
    const double barrier = barrier_level(g, all, l);
    for (int i = 0; i < 6; ++i) {
      const Vec3<double> m = bodies.direction();
      if (g.steady_level(l * m) >= barrier) continue;
      const auto motion = MomentumMotion::from(g, l, m, 0);
      const auto said = certify(motion, all);
      REQUIRE(said.certificate == Certificate::by_level);
      CHECK(said.index == flow(g, all, l, m));
      far += (m - all[said.index].direction).norm() > 1;
      ++tested;
    }
  }
  CHECK(far > 20);
}

TEST_CASE("just below the barrier, and in a shallow valley next to a fold") {
  Bodies bodies(29);
  int shallow = 0;
  for (const double d : {1e-2, 1e-3, 1e-4}) {
    // below the fold at which the second minimum dies
    double two = 3, one = 6;
    for (int i = 0; i < 50; ++i) {
      const double middle = (two + one) / 2;
      (minima(steady_rotations(reference_body(0.2, middle), 8.0)) == 2 ? two : one) = middle;
    }
    const auto g = reference_body(0.2, two * (1 - d));
    const auto all = steady_rotations(g, 8.0);
    REQUIRE(minima(all) == 2);
    const double barrier = barrier_level(g, all, 8.0);
    for (int i = 0; i < 2000; ++i) {
      // near the shallow minimum
      const Vec3<double> m = (all[1].direction + 2 * std::sqrt(d) * bodies.direction()).normalized();
      const double F = g.steady_level(8 * m);
      if (F >= barrier - 0.02 * (barrier - all[1].level)) continue;
      const auto said = certify(MomentumMotion::from(g, 8.0, m, 0), all);
      REQUIRE(said.certificate == Certificate::by_level);
      if (i < 40) CHECK(said.index == flow(g, all, 8.0, m));
      shallow += said.index == 1;
    }
  }
  CHECK(shallow > 50);
}

TEST_CASE("one minimum alone needs no waiting, but for a start on an unstable steady rotation") {
  const auto g = reference_body(0.2, 12);
  const double l = 2;
  const auto all = steady_rotations(g, l);
  REQUIRE(all.count == 2);
  Bodies bodies(2);
  for (int i = 0; i < 50; ++i) {
    const auto said = certify(MomentumMotion::from(g, l, bodies.direction(), bodies.uniform(-30, 30)), all);
    CHECK(said.index == 0);
    CHECK(said.certificate == Certificate::by_uniqueness);
    CHECK(said.margin == -infinity<double>);
  }
  const auto on = certify(MomentumMotion::from(g, l, all[1].direction, 0), all);
  CHECK(on.index == -1);
  CHECK(on.certificate == Certificate::undecided);
  CHECK(certify(MomentumMotion::from(g, l, all[1].direction, 1e-6), all).index == 0);
  CHECK(certify(MomentumMotion::from(g, l, all[0].direction, 0), all).index == 0);
}

TEST_CASE("a start on a saddle is undecided with no margin") {
  const auto g = reference_body(0.2, 3);
  const auto all = steady_rotations(g, 8.0);
  const auto& saddle = all[all.lowest(SteadyType::saddle)];
  const auto on = certify(MomentumMotion::from(g, 8.0, saddle.direction, 0), all);
  CHECK(on.certificate == Certificate::undecided);
  CHECK(on.index == -1);
  CHECK(std::abs(on.margin) < 1e-13 * saddle.level);
  // down its two sides lie the two minima
  Vec3<double> down = all[0].direction - all[1].direction;
  down -= down.dot(saddle.direction) * saddle.direction;
  const auto one = certify(MomentumMotion::from(g, 8.0, (saddle.direction + 1e-3 * down).normalized(), 0), all);
  const auto other = certify(MomentumMotion::from(g, 8.0, (saddle.direction - 1e-3 * down).normalized(), 0), all);
  CHECK(one.certificate == Certificate::by_level);
  CHECK(other.certificate == Certificate::by_level);
  CHECK(one.index + other.index == 1);
}

TEST_CASE("the lobe around a maximum") {
  Bodies bodies(4);
  const auto g = reference_body(0.2, 3);
  const auto all = steady_rotations(g, 8.0);
  REQUIRE(all.count == 6);
  int seen[6] = {};
  for (int i = 0; i < 400; ++i) {
    const Vec3<double> m = bodies.direction();
    const int lobe = lobe_of<double>(g, all, 8 * m);
    REQUIRE(lobe >= 4);
    ++seen[lobe];
    CHECK(lobe == (g.steady_level(8 * m) > all[3].level ? flow(g, all, 8.0, m, -1) : 5));
  }
  CHECK(seen[4] > 2);
  CHECK(seen[5] > 100);
}

TEST_CASE("no attractor where there is none") {
  const auto said = [](const Mat3<double>& theta, const Vec3<double>& e, double slope, double rate, double l) {
    const auto g = Gyrostat<double>::make(theta, e, 0.4, slope, rate).value();
    const auto all = steady_rotations(g, l);
    return rotor::certify<double>(g, all, l * Vec3<double>(0.36, 0.48, 0.8), 0.3);
  };
  const auto moments = [](double a, double b, double c) -> Mat3<double> { return Vec3<double>(a, b, c).asDiagonal(); };
  CHECK(said(moments(3, 4, 5), {0.6, 0.8, 0}, 0, 1, 5).certificate == Certificate::none);
  CHECK(said(moments(3, 4, 5), {0.6, 0.8, 0}, 0.1, 1, 0).certificate == Certificate::none);
  CHECK(said(moments(3, 3, 5), {0, 0, 1}, 0.1, 1, 5).certificate == Certificate::none);
  CHECK(said(moments(4, 4, 4), {0.6, 0, 0.8}, 0.1, 1, 5).certificate == Certificate::none);
  CHECK(said(moments(3, 5, 5), {0.6, 0.8, 0}, 0.1, 0, 5).certificate == Certificate::none);  // a circle of minima
  CHECK(said(moments(3, 4, 5), {0, 0, 1}, 0.1, 20, 5).certificate == Certificate::by_uniqueness);
}

TEST_CASE("the circular section holds motions above its level, not those below") {
  const double j1 = 1 / 3.0, j2 = 1 / 4.2, j3 = 1 / 5.0;
  const Vec3<double> e = Vec3<double>(3 * std::sqrt(j1 - j2), 0, 5 * std::sqrt(j2 - j3)).normalized();
  const auto g = Gyrostat<double>::make(Vec3<double>(3, 4.2, 5).asDiagonal(), e, 0.6, 0.5, 6).value();
  const double l = 4;
  const auto all = steady_rotations(g, l);
  REQUIRE(all.count == 2);
  const double level = circular_section(g, l).level;
  CHECK(barrier_level(g, all, l) == level);
  Bodies bodies(3);
  for (int i = 0; i < 100; ++i) {
    const auto motion = MomentumMotion::from(g, l, bodies.direction(), 0);
    const auto said = certify(motion, all);
    CHECK(said.index == (motion.level() < level ? 0 : -1));
    CHECK(said.certificate == (motion.level() < level ? Certificate::by_level : Certificate::undecided));
  }
  const Vec3<double> H(1, 0, 0);
  STATIC_REQUIRE(noexcept(rotor::certify(g, all, H, 0.0)));
}
