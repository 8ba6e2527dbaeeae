// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/lindstedt.hpp"

#include <cmath>
#include <random>

#include "bodies.hpp"
#include "catch.hpp"
#include "reference_table.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

namespace {

using L = Lindstedt<double>;

Scaled<double> scaled(const Problem<double>& problem, double spin, double G0) {
  const auto made = Scaled<double>::make(problem, spin, G0);
  REQUIRE(made);
  return *made;
}

struct Sample {
  double value = 0, slope = 0;
};

/// The sum of the terms 0..order and its derivative over u.
Sample sum(const L& terms, L::Unknown unknown, int order, double u) {
  Sample f;
  for (int n = order; n >= 0; --n) {
    const auto& w = terms.wave(unknown, n);
    for (int j = 0; j < 2 * n + 2; ++j) {
      f.value += w.c[j] * std::cos(j * u) + w.s[j] * std::sin(j * u);
      f.slope += j * (w.s[j] * std::cos(j * u) - w.c[j] * std::sin(j * u));
    }
  }
  return f;
}

/// The largest residual of the equations of motion over 24 phases.
double residual(const L& terms, int order) {
  const auto& s = terms.scaled();
  double rate = 0, worst = 0;
  for (int n = order; n >= 0; --n) rate += terms.rate(n);
  for (int i = 0; i < 24; ++i) {
    const double u = 0.1 + i * 2 * pi<double> / 24;
    const auto at = [&](L::Unknown unknown) { return sum(terms, unknown, order, u); };
    const Sample p = at(L::P), q = at(L::Q), r = at(L::R), g = at(L::g1), h = at(L::g2), G = at(L::g3);
    const Vec3<double> I(s.a, s.b, 1), w(p.value, q.value, r.value), d(g.value, h.value, G.value);
    const Vec3<double> torque = I.cwiseProduct(w).cross(w) + s.load.cross(d) + s.gradient * d.cross(I.cwiseProduct(d));
    const Vec3<double> turn = d.cross(w);
    worst = std::max({worst, (rate * I.cwiseProduct(Vec3<double>(p.slope, q.slope, r.slope)) - torque).norm(),
                      (rate * Vec3<double>(g.slope, h.slope, G.slope) - turn).norm()});
  }
  return worst;
}

}  // namespace

TEST_CASE("lindstedt: order n leaves a residual of order n + 1 in eps^2", "[heavy]") {
  std::mt19937 random(1);
  for (int body = 0; body < 12; ++body) {
    const Draw d = draw(random);
    for (int order : {1, 2, 4, 7}) {
      double last = 0;
      double slope = 0;
      for (double eps : {0.05, 0.04}) {
        L terms(scaled(d.body(), 1 / eps, d.G0));
        while (terms.order() < order) REQUIRE(terms.advance());
        const double now = residual(terms, order);
        if (last > 0) slope = std::log(last / now) / std::log(0.05 / 0.04);
        last = now;
        INFO(now);
        CHECK(terms.imbalance() < 1e-16);
      }
      if (last > 1e-13) CHECK(slope == Approx(2 * order + 2).margin(0.3));
    }
  }
}

TEST_CASE("lindstedt: terms 1 of the closed form, and the phase of the periodic motions", "[heavy]") {
  for (const auto& row : reference_rows("periodic")) {
    const auto s = scaled(row.problem(), row.number[9], row.number[10]);
    L terms(s);
    while (terms.order() < 4) REQUIRE(terms.advance());
    const FirstOrder<double> first(s);
    const double eps2 = s.load.norm();
    CHECK(terms.wave(L::P, 1).c[0] == Approx(first.X).epsilon(1e-12).margin(1e-15 * eps2));
    CHECK(terms.wave(L::P, 1).c[1] == Approx(first.chi * s.M3).epsilon(1e-12));
    CHECK(terms.wave(L::Q, 1).c[0] == Approx(first.Y).epsilon(1e-12).margin(1e-15 * eps2));
    CHECK(terms.wave(L::Q, 1).s[1] == Approx(first.kap * s.M3).epsilon(1e-12));
    CHECK(terms.wave(L::turn, 1).c[0] == Approx(first.precession()).epsilon(1e-12));
    CHECK(terms.rate(1) == Approx(first.rate).epsilon(1e-12));
    for (int n = 1; n <= 4; ++n)
      CHECK(terms.rate(n) == Approx(row.number[14 + static_cast<std::size_t>(n)] * std::pow(eps2, n)).epsilon(1e-11));
  }
}

TEST_CASE("lindstedt: a mirror symmetry forbids a mean, whatever its divisor", "[heavy]") {
  // B = C and y' = 0: the mean of q is a free constant of the equations, zero of the symmetric motion
  L terms(scaled(unit_body(0.7, 1.0, {0.6, 0, 0.8}, 0.3), 20, 0.3));
  while (terms.order() < 5) REQUIRE(terms.advance());
  CHECK(residual(terms, 5) < 1e-13);
  // with y' it is what a constant torque turns up without end
  L pushed(scaled(unit_body(0.7, 1.0, {0.6, 0.1, 0.8}, 0.3), 20, 0.3));
  CHECK_FALSE(pushed.advance());
  CHECK(pushed.order() == 0);
}

TEST_CASE("lindstedt: no torque, no terms", "[heavy]") {
  const auto still = Problem<double>::make({0.6, 0.8, 1}, 1, {0, 0, 0}, 9.8, 0);
  REQUIRE(still);
  L terms(scaled(*still, 3, 0.2));
  while (terms.advance()) {
  }
  CHECK(terms.order() == L::most);
  CHECK(terms.size(5).rates == 0);
  CHECK(terms.fall() == 0);
  CHECK(terms.remainder(1).down == 0);
}

TEST_CASE("lindstedt: means of p and q quicken the turn two orders on", "[heavy]") {
  // a rod about an axis across it whose moment is nearly that of the other: its second term tilts the mean axis, which its fourth counts
  const auto rod = Problem<double>::make({0.0003132386702791663, 1.0002819148032513, 1}, 1,
                                         {4.712690558133405e-05, 0.0002362143049027115, -0.00011162686837168407}, 1, 0);
  REQUIRE(rod);
  L terms(scaled(*rod, 2.472098443132122, 0));
  while (terms.order() < 3) REQUIRE(terms.advance());
  const double stated = terms.remainder(2).phase;
  double left = 0;
  while (terms.order() < 8) REQUIRE(terms.advance());
  for (int n = 3; n <= terms.order(); ++n) left += terms.rate(n);
  CHECK(std::abs(left) < stated);
  CHECK(stated < 10 * std::abs(left));
}
