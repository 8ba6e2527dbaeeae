// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/view.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostats.hpp"

namespace free_view_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::long_run_view;
using gyrostat::free::Motion;
using gyrostat::free::view_fraction;
using V = Vec3<double>;

TEST_CASE("the view of the long run is what a long span of the motion shows", "[free]") {
  Bodies bodies(46);
  for (int i = 0; i < 12; ++i) {
    const auto m = *Motion<double>::make<DoubleDouble>(bodies.of(Regime::generic, i).cast<DoubleDouble>());
    const V b = bodies.vector().normalized(), s = bodies.vector().normalized();
    const double cone = bodies.uniform(.3, 1.6);
    const auto view = long_run_view<double>(m, b, s, cone);
    // an irrational step through the torus
    double seen = 0, cosine = 0;
    constexpr int n = 200000;
    for (int k = 0; k < n; ++k) {
      const double c = s.dot(rotate<double>(m.at(m.period() * (std::sqrt(2.) * k)).attitude, b));
      seen += c >= std::cos(cone), cosine += std::max(0., c);
    }
    CHECK(view.fraction == Approx(seen / n).margin(6e-3));
    CHECK(view.mean_cosine == Approx(cosine / n).margin(6e-3));
    const double span = 400 * m.period();
    CHECK(view_fraction<double>(m, b, s, cone, 0, span) == Approx(view.fraction).margin(2e-2));
  }
}

TEST_CASE("the view of the long run is that of many phases, far better than they find it", "[free]") {
  Bodies bodies(47);
  for (const auto regime : {Regime::generic, Regime::middle_axis, Regime::much_momentum, Regime::bisected})
    for (int i = 0; i < 6; ++i) {
      const auto m = Motion<double>::make<DoubleDouble>(bodies.of(regime, i).cast<DoubleDouble>());
      if (!m || !(m->period() < infinity<double>)) continue;
      const V b = bodies.vector().normalized(), s = bodies.vector().normalized();
      const double cone = i % 3 == 0 ? pi<double> / 2 : bodies.uniform(.1, 3);
      const auto view = long_run_view<double>(*m, b, s, cone);
      const V pole = m->inertial_momentum().normalized();
      const gyrostat::free::detail::SeenInTurn<double> turn{gyrostat::free::detail::angle_between<double>(s, pole),
                                                            cone};
      double seen = 0, cosine = 0;
      constexpr int n = 1 << 16;
      for (int k = 0; k < n; ++k) {
        const auto at =
            turn(gyrostat::free::detail::angle_between<double>(b, m->at(m->period() * (k + .5) / n).angular_momentum));
        seen += at.fraction / n, cosine += at.mean_cosine / n;
      }
      CAPTURE(name(regime), i, cone, m->modulus().kp2);
      CHECK(view.error < 1e-9);
      // the rule of many nodes falls with their number to the power of 1.5
      CHECK(std::abs(view.fraction - seen) < 4e-7);
      CHECK(std::abs(view.mean_cosine - cosine) < 1e-9);
    }
}

TEST_CASE("the view from a steady rotation and its limits", "[free]") {
  const auto m = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {0, 0, 2}));
  const V z(0, 0, 1), x(1, 0, 0);
  CHECK(long_run_view<double>(m, x, x, pi<double> / 2).fraction == Approx(.5));
  CHECK(long_run_view<double>(m, x, x, pi<double> / 2).mean_cosine == Approx(1 / pi<double>));
  CHECK(long_run_view<double>(m, x, x, .3).fraction == Approx(.3 / pi<double>));
  CHECK(long_run_view<double>(m, z, z, .1).fraction == 1);
  CHECK(long_run_view<double>(m, z, x, .1).fraction == 0);
  CHECK(long_run_view<double>(m, x, x, 0).fraction == Approx(0).margin(1e-7));
  CHECK(long_run_view<double>(m, x, x, pi<double>).fraction == 1);
  CHECK(view_fraction<double>(m, x, x, .3, 0, pi<double>) == Approx(.3 / pi<double>));
  CHECK(view_fraction<double>(m, x, x, .3, 0, .1) == Approx(1));
  CHECK(view_fraction<double>(m, x, x, .3, 0, 600) == Approx(.3 / pi<double>).epsilon(1e-2));
  const auto rest = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {1, 0, 0}, {0, 0, 0}));
  CHECK(long_run_view<double>(rest, x, x, .1).fraction == 1);
  CHECK(long_run_view<double>(rest, z, x, .1).fraction == 0);
  const auto separatrix = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {1, 1, 2}));
  CHECK(std::isnan(long_run_view<double>(separatrix, x, x, 1).fraction));
}

TEST_CASE("what is in view for a moment counts", "[free]") {
  const auto m = *Motion<double>::make(Problem<double>::from_moments({1, 1, .6}, {0, 0, 0}, {.3, 0, .2}));
  const V axis(1, 0, 0), direction = gyrostat::rotate<double>(m.at(3.).attitude, axis);
  for (const double half_angle : {.05, .01, .002}) {
    CAPTURE(half_angle);
    double inside = 0;
    const int looks = 400'000;
    for (int i = 0; i < looks; ++i)
      inside +=
          gyrostat::rotate<double>(m.at(2000 * (i + .5) / looks).attitude, axis).dot(direction) >= std::cos(half_angle);
    CHECK(view_fraction<double>(m, axis, direction, half_angle, 0, 2000) ==
          Approx(inside / looks).epsilon(0.02).margin(1e-5));
  }
}

TEST_CASE("a view that only just begins is found, and is as wide as it has to be", "[free]") {
  Bodies bodies(48);
  for (const auto regime : {Regime::generic, Regime::middle_axis, Regime::much_momentum})
    for (int i = 0; i < 8; ++i) {
      const auto m = Motion<double>::make<DoubleDouble>(bodies.of(regime, i).cast<DoubleDouble>());
      if (!m || !(m->period() < infinity<double>)) continue;
      const V axis = bodies.vector().normalized(), pole = m->inertial_momentum().normalized();
      const V aside = (bodies.vector().cross(pole)).normalized();
      // the greatest angle of the axis from M
      double most = 0;
      for (int k = 0; k < 100000; ++k)
        most = std::max(most, free::detail::angle_between<double>(axis, m->at(m->period() * k / 1e5).angular_momentum));
      const double delta = 2.9;
      if (!(most < 2.7)) continue;
      const V direction = std::cos(delta) * pole + std::sin(delta) * aside;
      double before = 0, depth = 1e-3;
      for (int k = 0; k < 5; ++k, depth /= 10) {
        // an area of the torus, in proportion to the depth
        const double seen = long_run_view<double>(*m, axis, direction, delta - most + depth).fraction;
        CAPTURE(name(regime), i, k, seen);
        CHECK(seen > 0);
        if (k > 0) CHECK(seen < before);
        if (k > 2 && regime == Regime::generic) CHECK(seen == Approx(before / 10).epsilon(.1));
        before = seen;
      }
    }
}

TEST_CASE("a direction next to M is seen as one along it, but for its angle", "[free]") {
  const auto m = *Motion<double>::make(Problem<double>::from_moments({6, 4, 3}, {0, 0, 0}, {0, 0, 2}));
  for (double off = 1e-1; off > 1e-12; off /= 10) {
    const V direction(std::sin(off), 0, std::cos(off)), axis(std::sin(.7), 0, std::cos(.7));
    for (const double part : {-.9, -.5, .1, .6}) {
      CAPTURE(off, part);
      // cos phi = (cos h - cos .7 cos off)/(sin .7 sin off), h = .7 + part off, expanded
      const double h = .7 + part * off;
      const double inside = std::sin((h + .7 - off) / 2) * std::sin((part + 1) * off / 2);
      const double share = 2 / pi<double> * std::asin(std::sqrt(inside / (std::sin(.7) * std::sin(off))));
      CHECK(long_run_view<double>(m, axis, direction, h).fraction == Approx(share).margin(1e-15 / off).epsilon(1e-9));
    }
  }
  CHECK(long_run_view<double>(m, V(0, 0, 1), V(0, 0, 1), -1e-15).fraction == 0);
  CHECK(long_run_view<double>(m, V(0, 0, 1), V(0, 0, 1), 0).fraction == 1);
}

}  // namespace free_view_test
