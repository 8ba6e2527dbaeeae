// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/exact_error.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEST_CASE("exact error: infinite beyond first order", "[heavy]") {
  CHECK(ExactError<double>::of(0.01, 3).down == 0.01);
  CHECK(ExactError<double>::of(0.01, 3).angular_velocity == 3);
  CHECK(ExactError<double>::of(0.1, 3).attitude == infinity<double>);
  CHECK(ExactError<double>::of(gyrostat::nan<double>, 3).down == infinity<double>);
}

TEST_CASE("exact error: time error, linear, through a saddle, and at rest", "[heavy]") {
  CHECK(time_error(1e-16, 1e-16, 1.6, 2.0, 100.0) == Approx(1e-16 * (100 + (1 + 200 / 1.6) / 2)));
  // before the passage ends the perturbation has grown by exp(rate t) only
  CHECK(time_error(1e-16, 1.0, 20.0, 1.0, 5.0) == Approx(1e-16 * (5 + 1.25 * std::expm1(5.0))));
  CHECK(time_error(1e-16, infinity<double>, infinity<double>, 1.0, 100.0) > 1e20);
  CHECK(time_error(1e-16, infinity<double>, infinity<double>, 0.0, 100.0) == Approx(1e-14));
}

TEST_CASE("exact error: what is pushed off its place", "[heavy]") {
  CHECK(pushed_off(0.0, 1.0, 1e3) == 0);
  CHECK(pushed_off(1e-3, 0.0, 4.0) == Approx(8e-3));
  CHECK(pushed_off(1e-3, 4.0, 3.0) == Approx(1e-3 * (std::cosh(6.0) - 1) / 4));  // (cosh(g t) - 1)/g^2
  for (const double t : {0.1, 0.7, 1.6, 40.0}) CHECK(pushed_off(1e-3, -4.0, t) >= 1e-3 * (1 - std::cos(2 * t)) / 4);
  CHECK(pushed_off(1e-3, -4.0, 1e9) <= 1e-3);
}
