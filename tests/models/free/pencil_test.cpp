// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/pencil.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostats.hpp"

namespace free_pencil_test {

using namespace gyrostat;
using namespace free_bodies;
using gyrostat::free::Pencil;
using gyrostat::free::PrincipalProblem;

template <Real Scalar>
Pencil<Scalar> pencil_of(const Problem<double>& p) {
  const auto d = PrincipalProblem<Scalar>::of(p.template cast<Scalar>());
  return {d.inverse, d.gaps, d.G, d.l, d.M, d.M.norm()};
}

TEST_CASE("both quadrics of the pencil vanish at the start and its axes are conjugate to both", "[free]") {
  Bodies bodies(1);
  double null = 0, unit = 0, across = 0, eigen = 0;
  int two = 0, three = 0, shifted = 0;
  for (const Regime regime : {Regime::generic, Regime::little_momentum, Regime::total_near_zero, Regime::equal_moments})
    for (int i = 0; i < 200; ++i) {
      const auto pencil = pencil_of<DoubleDouble>(bodies.of(regime, i));
      const auto& X = pencil.start();
      null = std::max(null, double(abs(pencil.S(X, X))) / (1 + double(X.squaredNorm())));
      shifted += pencil.shifted();
      const auto axes = pencil.axes();
      REQUIRE(axes);
      (axes->count == 2 ? two : three)++;
      for (int k = 0; k < axes->count; ++k) {
        const auto& p = axes->axis[k];
        unit = std::max(unit, double(abs(pencil.S(p.x, p.x) - 1)));
        for (int j = 0; j < 4; ++j) {
          gyrostat::free::Vec4<DoubleDouble> e = gyrostat::free::Vec4<DoubleDouble>::Zero();
          e[j] = 1;
          const double size =
              double((abs(pencil.sigma(p)) + pencil.a(2)) * p.x.norm()) * (1 + double(abs(pencil.E(e, e))));
          eigen = std::max(eigen, double(abs(pencil.form(p, p.x, e))) / size);
        }
        for (int m = 0; m < k; ++m) {
          across = std::max(across, double(abs(pencil.S(p.x, axes->axis[m].x) * pencil.difference(axes->axis[m], p))));
          CHECK(pencil.difference(axes->axis[m], p) >= 0);
        }
      }
    }
  CHECK(null < 1e-30);
  CHECK(unit < 1e-28);
  CHECK(eigen < 1e-27);
  CHECK(across < 1e-24);
  CHECK((two > 100 && three > 100 && shifted > 100));
}

TEST_CASE("without rotor momentum the start and not a root decides which axis is surrounded", "[free]") {
  const double e = 1e-12;
  for (const bool largest : {true, false}) {
    const auto pencil =
        pencil_of<double>(Problem<double>::from_moments({3, 2, 1}, {0, 0, 0}, {largest ? e : 0., 1, largest ? 0. : e}));
    const auto axes = pencil.axes();
    REQUIRE(axes);
    CHECK(axes->count == 3);
    CHECK(axes->lobe_lowest == largest);
    CHECK(axes->share == Approx(1));
    for (const auto& axis : axes->axis) CHECK(axis.exact);
  }
}

TEST_CASE("the shifted form keeps the digits of rates that are small beside the rotors", "[free]") {
  const auto p = Problem<double>::from_moments({3, 2, 1}, {1e9, -2e9, 3e9}, {.1, -.2, .3});
  const auto pencil = pencil_of<double>(p);
  CHECK(pencil.shifted());
  const double R = 1e9 * std::sqrt(14.);
  CHECK((pencil.rate(pencil.start()) * R - p.angular_velocity).norm() < 1e-8 * p.angular_velocity.norm());
  const auto x = pencil.timelike();
  CHECK(pencil.S(x, x) < 0);
  for (int i = 0; i < 3; ++i) CHECK(std::abs(x[i]) < 1e-7);
}

}  // namespace free_pencil_test
