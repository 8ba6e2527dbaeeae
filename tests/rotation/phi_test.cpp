// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/phi.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;

namespace {

/// Power series below one, the defining quotient above, where it loses less than a digit: good to 1e-18.
long double sine_defect_reference(long double x) {
  if (std::abs(x) > 1) return (x - std::sin(x)) / (x * x * x);
  long double term = 1.0L / 6, sum = 0;
  for (int k = 2; k < 16; ++k) {
    sum += term;
    term *= -x * x / ((2 * k) * (2 * k + 1));
  }
  return sum;
}

/// The series of 1 - y cot y by Bernoulli numbers below |x| = 1, the defining quotient above.
long double cotangent_defect_reference(long double x) {
  const long double y = x / 2;
  if (std::abs(x) > 1) return (1 - y * std::cos(y) / std::sin(y)) / (x * x);
  // 1 - y cot y = 2 sum zeta(2k) (y/pi)^(2k)
  long double sum = 0;
  for (int k = 30; k >= 1; --k) {
    long double zeta = 0;
    for (int n = 2000; n >= 1; --n) zeta += std::pow(static_cast<long double>(n), -2.0L * k);
    if (k == 1) zeta = pi<long double> * pi<long double> / 6;
    if (k == 2) zeta = std::pow(pi<long double>, 4) / 90;
    if (k == 3) zeta = std::pow(pi<long double>, 6) / 945;
    sum += 2 * zeta * std::pow(y, 2.0L * k - 2) * std::pow(pi<long double>, -2.0L * k);
  }
  return sum / 4;
}

std::vector<double> arguments(double largest) {
  std::vector<double> x{0, 1e-300, 1e-160, 1e-20, 1e-9, 1e-8, 1e-7, 1e-4, 1e-3};
  for (double v = 1e-2; v < 1; v *= 1.3) x.push_back(v);
  for (double v = 1; v < largest; v += 0.0625) x.push_back(v);
  return x;
}

}  // namespace

TEST_CASE("sinc and the versine ratio are good to a few ulp from 0 to a turn") {
  for (const double x : arguments(6)) {
    const long double y = x;
    const long double s = x == 0 ? 1 : std::sin(y) / y;
    CHECK(std::abs(sinc(x) - s) <= 2 * epsilon<double> * std::abs(s));
    const long double h = std::sin(y / 2);
    const long double c = x < 1e-100 ? 0.5L : 2 * h * h / (y * y);
    CHECK(std::abs(versine_ratio(x) - c) <= 4 * epsilon<double> * c);
    CHECK(sinc(-x) == sinc(x));
    CHECK(versine_ratio(-x) == versine_ratio(x));
  }
}

TEST_CASE("the sine defect has no jump and a few ulp of error up to two turns") {
  double worst = 0;
  for (const double x : arguments(12.5)) {
    const long double exact = sine_defect_reference(x);
    worst = std::max(worst, static_cast<double>(std::abs(sine_defect_ratio(x) - exact) / exact));
    CHECK(sine_defect_ratio(-x) == sine_defect_ratio(x));
  }
  CHECK(worst <= 4 * epsilon<double>);
}

TEST_CASE("the cotangent defect has no jump and a few ulp of error up to its pole") {
  double worst = 0;
  for (const double x : arguments(6)) {
    const long double exact = cotangent_defect_reference(x);
    worst = std::max(worst, static_cast<double>(std::abs(cotangent_defect_ratio(x) - exact) / exact));
    CHECK(cotangent_defect_ratio(-x) == cotangent_defect_ratio(x));
  }
  CHECK(worst <= 6 * epsilon<double>);
}

TEMPLATE_TEST_CASE("the quotients take every scalar and hand NaN through", "", float, double, long double) {
  using S = TestType;
  const S x = S(0.75);
  CHECK(std::abs(sine_defect_ratio(x) - static_cast<S>(sine_defect_reference(0.75L))) <= epsilon<S>);
  CHECK(std::abs(cotangent_defect_ratio(x) - static_cast<S>(cotangent_defect_reference(0.75L))) <= epsilon<S>);
  CHECK(std::isnan(sinc(gyrostat::nan<S>)));
  CHECK(std::isnan(versine_ratio(gyrostat::nan<S>)));
  CHECK(std::isnan(sine_defect_ratio(gyrostat::nan<S>)));
  CHECK(std::isnan(cotangent_defect_ratio(gyrostat::nan<S>)));
}
