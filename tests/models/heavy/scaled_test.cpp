// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/scaled.hpp"

#include <cmath>

#include "bodies.hpp"
#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("heavy data without units: the ratios and the loads", "[heavy]") {
  const auto made = Problem<double>::make({0.0011, 0.0016, 0.002}, 0.8, {0.012, 0.009, 0.01}, 9.80665, 4.6e-6);
  REQUIRE(made);
  const auto s = Scaled<double>::make(*made, 150, 0.1);
  REQUIRE(s);
  CHECK(s->a == Approx(0.55));
  CHECK(s->b == Approx(0.8));
  CHECK(s->flatness == Approx(0.35));
  CHECK(s->nutation_squared() == Approx((s->a - 1) * (s->b - 1) / (s->a * s->b)));
  const double eps = made->pendulum_rate() / 150;
  CHECK((s->load - eps * eps * made->centre_of_mass().normalized()).norm() < 1e-15 * eps);
  CHECK(s->gradient * 150 * 150 == Approx(4.6e-6));
  CHECK(s->M3 == Approx(std::sqrt(0.99)));
  CHECK_FALSE(doubts(*s).any());
}

TEST_CASE("heavy data without units: neither weight nor divisor is needed where nothing is divided", "[heavy]") {
  const auto s = Scaled<double>::make(unit_body(1.0, 0.7, {0, 0, 0}, 0.4), 10, 0.3);
  REQUIRE(s);
  CHECK(s->load.norm() == 0);
  const FirstOrder<double> first(*s);
  CHECK(first.X == 0);
  CHECK(first.chi == Approx(0.004 * 0.3 * 0.3));
  CHECK(std::isinf(FirstOrder<double>(*Scaled<double>::make(unit_body(1.0, 0.7, {0.6, 0, 0.8}, 0.4), 10, 0.3)).X));
}

TEST_CASE("heavy data without units: what is refused, and every doubt", "[heavy]") {
  const auto body = unit_body(0.6, 0.8, {0.6, 0.48, 0.64}, 0.1);
  CHECK(Scaled<double>::make(body, 0, 0.1).error() == Errc::out_of_domain);
  CHECK(Scaled<double>::make(body, 1, 1).error() == Errc::out_of_domain);
  CHECK(Scaled<double>::make(body, 1, -1.5).error() == Errc::out_of_domain);
  CHECK(Scaled<double>::make(body, gyrostat::nan<double>, 0.1).error() == Errc::not_finite);
  CHECK(Scaled<double>::make(body, gyrostat::infinity<double>, 0.1).error() == Errc::not_finite);
  CHECK(Scaled<double>::make(body, 1, gyrostat::nan<double>).error() == Errc::not_finite);
  CHECK(Scaled<double>::make(body, 1e-300, 0.1).error() == Errc::not_finite);  // the loads overflow

  const auto of = [](double a, double b, Vec3<double> at, double k, double spin, double G0) {
    return doubts(*Scaled<double>::make(unit_body(a, b, at, k), spin, G0));
  };
  const Vec3<double> at{0.6, 0.48, 0.64};
  CHECK(of(0.6, 0.8, at, 0.1, 2.9, 0.1).slow);
  CHECK_FALSE(of(0.6, 0.8, at, 0.1, 3.1, 0.1).slow);
  CHECK(of(0.6, 0.8, at, 50, 20, 0.1).strong_gradient);
  CHECK(of(0.99, 0.8, at, 0.1, 20, 0.1).near_a);
  CHECK(of(0.6, 0.99, at, 0.1, 20, 0.1).near_b);
  CHECK_FALSE(of(0.6, 1.0, {0.6, 0, 0.8}, 0.1, 20, 0.1).near_b);
  CHECK(of(0.6, 0.405, at, 0.1, 20, 0.1).near_lamina);
  CHECK(of(0.6, 0.8, at, 0.1, 20, 0.9999).upright);
}
