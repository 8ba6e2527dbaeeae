// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/series.hpp"

#include <cmath>

#include "catch.hpp"

using namespace gyrostat::math;

TEMPLATE_TEST_CASE("power series arithmetic", "[math]", float, double, long double) {
  using S = TestType;
  constexpr int order = 14;
  S a[order + 1], b[order + 1];
  for (int k = 0; k <= order; ++k) {
    a[k] = S(1.7) / S(k + 1) * (k % 3 == 1 ? -1 : 1);
    b[k] = S(2.3) / S(1 + k * k) * (k % 2 ? -1 : 1);
  }
  S ab[order + 1], aa[order + 1], back[order + 1], root[order + 1], power_half[order + 1], inverse[order + 1];
  for (int k = 0; k <= order; ++k) {
    ab[k] = product(a, b, k);
    aa[k] = square(a, k);
    back[k] = quotient(ab[k], b, back, k, 1 / b[0]);
    root[k] = k == 0 ? std::sqrt(a[0]) : square_root(a[k], root, k, 1 / (2 * root[0]));
    power_half[k] = k == 0 ? std::sqrt(a[0]) : power(a, power_half, S(0.5), k, 1 / a[0]);
    inverse[k] = k == 0 ? 1 / a[0] : power(a, inverse, S(-1), k, 1 / a[0]);
  }
  const S eps = 200 * gyrostat::epsilon<S>;
  for (int k = 0; k <= order; ++k) {
    INFO(k);
    CHECK(std::abs(aa[k] - product(a, a, k)) <= eps);
    CHECK(std::abs(back[k] - a[k]) <= eps);
    CHECK(std::abs(square(root, k) - a[k]) <= eps);
    CHECK(std::abs(power_half[k] - root[k]) <= eps);
    CHECK(std::abs(product(inverse, a, k) - (k == 0 ? 1 : 0)) <= eps);
  }
  // the product's value is the product of the values, to the order left out
  const S t = S(0.01);
  CHECK(std::abs(evaluate(ab, order, t) - evaluate(a, order, t) * evaluate(b, order, t)) <= eps);
  // (1 + t)^(-3/2), binomial coefficients
  S s[order + 1] = {1, 1}, p[order + 1] = {1};
  S binomial = 1;
  for (int k = 1; k <= order; ++k) {
    p[k] = power(s, p, S(-1.5), k, S(1));
    binomial *= (S(-1.5) - S(k - 1)) / S(k);
    CHECK(std::abs(p[k] - binomial) <= eps * std::abs(binomial));
  }
}
