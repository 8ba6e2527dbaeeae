// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/rotor/averaged_dissipation.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "models/rotor/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

TEST_CASE("the fast motion keeps |m| and F, is slower than its bound, and rests in the steady rotations") {
  Bodies bodies(3);
  for (int i = 0; i < 200; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 10) * std::abs(g.target_momentum());
    const FastMotion<double> motion(g, l);
    const Vec3<double> m = bodies.direction(), rate = motion.rate(m);
    const Vec3<double> slope = l * (g.inverse_inertia() * (l * m - g.target_momentum() * g.axis()));
    const double size = slope.norm() + l * motion.fastest();
    CHECK(std::abs(rate.dot(m)) <= 1e-14 * size / l);
    CHECK(std::abs(rate.dot(slope)) <= 1e-14 * size * size / l);
    CHECK(rate.norm() <= motion.fastest() * (1 + 1e-14));
    CHECK(motion.felt(m) == Approx(m.dot(g.inverse_inertia() * g.axis())).margin(1e-15));
    for (const auto& r : steady_rotations(g, l)) CHECK(motion.rate(r.direction).norm() <= 1e-11 * motion.fastest());
  }
}

TEST_CASE("a sine that is felt is answered like one, at any ratio of pace and relaxation") {
  const auto g = reference_body(0.2, 3);
  const double l = 8, k = g.coupling(), s = g.relaxation_rate(), size = 0.01;
  for (const double pace : {s / 30, s, 30 * s}) {
    const double period = 2 * pi<double> / pace;
    const int n = 2000;
    const double step = period / (n + 0.5);  // the last interval is half as long
    std::vector<double> felt;
    for (int i = 0; i <= n; ++i) felt.push_back(size * std::sin(pace * i * step));
    felt.push_back(felt[0]);
    const auto orbit = level_orbit_of<double>(g, l, felt, step, step / 2);
    // x' + s x = -(l/k) felt'
    const double mean = std::pow(l / k * size * pace, 2) / (pace * pace + s * s) / 2;
    CHECK(orbit.period == Approx(period).epsilon(1e-12));
    CHECK(orbit.dissipation == Approx(g.slope() * mean).epsilon(1e-4));
    CHECK(orbit.stored == Approx(g.axial_inertia() * k * mean / 2).epsilon(1e-4));
  }
}

TEST_CASE("the way up passes every level between, and begins beside its end") {
  Bodies bodies(11);
  int several = 0;
  for (int i = 0; i < 100; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 10) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    const auto &bottom = all[0], &top = all[all.count - 1];
    if (bottom.type != SteadyType::minimum || top.type != SteadyType::maximum) continue;
    const LevelPath<double> path(g, l, bottom.direction, top.direction);
    const LevelBands<double> bands(all, bottom.level, top.level);
    several += bands.count > 1;
    for (int b = 0; b < bands.count; ++b) {
      const auto band = bands[b];
      CHECK(band.low < band.high);
      for (const double xi : {-9.0, -0.5, 0.0, 2.0, 9.0}) {
        const double level = band.level(xi);
        CHECK(band.xi(level) == Approx(xi).margin(1e-9 * std::exp(std::abs(xi))));
        CHECK(band.above(xi) + band.below(xi) == Approx(band.high - band.low));
        for (const bool from_top : {false, true}) {
          const Vec3<double> m = path.point(level, from_top);
          CHECK(m.norm() == Approx(1));
          CHECK(std::abs(g.steady_level(l * m) - level) <= 1e-12 * top.level);
        }
      }
    }
  }
  CHECK(several > 10);
}

TEST_CASE("falls add up") {
  FallTime<double> fall{3, 40, 0.5, 0.01};
  fall += {2, 10, 0.25, 0.02};
  CHECK(fall.time == 5);
  CHECK(fall.turns == 50);
  CHECK(fall.coupling == 0.75);
  CHECK(fall.loss_per_turn == 0.02);
  CHECK(fall.error() == Approx(20 * 0.75 + 12 * (0.02 + 0.02)));
}
