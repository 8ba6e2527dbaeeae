// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ladder/rotor/level_orbit.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"
#include "models/rotor/bodies.hpp"

using namespace gyrostat;
using namespace gyrostat::rotor;

TEST_CASE("small orbits about a minimum take the period of the nutation, and the losses grow with the square") {
  Bodies bodies(17);
  for (int i = 0; i < 40; ++i) {
    const auto g = bodies.realisable();
    const double l = bodies.scale(0.3, 10) * std::abs(g.target_momentum());
    const auto all = steady_rotations(g, l);
    const auto s = stability_of(g, l, all[0]);
    double loss[2];
    for (int j = 0; j < 2; ++j) {
      const double tilt = j == 0 ? 1e-4 : 2e-4;
      const rotor::detail::Tangent<double> across(all[0].direction);
      const auto orbit = level_orbit<double>(g, l, (all[0].direction + tilt * across.u).normalized());
      REQUIRE(orbit);
      CHECK(orbit->period == Approx(2 * pi<double> / std::sqrt(s.determinant)).epsilon(1e-4));
      loss[j] = orbit->dissipation;
    }
    CHECK(loss[1] / loss[0] == Approx(4).epsilon(0.01));
  }
}

TEST_CASE("the same orbit from another of its points") {
  const auto g = reference_body(0.2, 3);
  const double l = 8;
  const FastMotion<double> motion(g, l);
  Vec3<double> m = Vec3<double>(0.3, -0.5, 0.7).normalized();
  const auto first = level_orbit<double>(g, l, m);
  REQUIRE(first);
  for (int i = 0; i < 200; ++i)
    m = ode::classical_step([&](const Vec3<double>& x) noexcept { return motion.rate(x); }, m, first->period / 700)
            .normalized();
  const auto second = level_orbit<double>(g, l, m);
  REQUIRE(second);
  CHECK(second->period == Approx(first->period).epsilon(1e-5));
  CHECK(second->dissipation == Approx(first->dissipation).epsilon(2e-3));
  CHECK(second->stored == Approx(first->stored).epsilon(2e-3));
}

TEST_CASE("a saddle has no orbit") {
  const auto g = reference_body(0.2, 3);
  const auto all = steady_rotations(g, 8.0);
  const int saddle = all.lowest(SteadyType::saddle);
  REQUIRE(saddle > 0);
  CHECK(level_orbit<double>(g, 8.0, all[saddle].direction).error() == Errc::no_convergence);
}
