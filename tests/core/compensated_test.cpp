// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/compensated.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/core/double_double.hpp"

using namespace gyrostat;

TEMPLATE_TEST_CASE("a compensated sum of many small terms keeps their digits", "[core]", float, double) {
  constexpr int n = 1'000'000;
  const TestType term = TestType(0.1L) * epsilon<TestType>;
  Sum<TestType> sum{1, 0};
  TestType x = 1, low = 0, plain = 1;
  for (int i = 0; i < n; ++i) {
    sum = add(sum, term);
    add_to(x, low, term);
    plain += term;
  }
  const long double right = 1 + static_cast<long double>(n) * static_cast<long double>(term);
  CHECK(std::abs(static_cast<long double>(sum.high) + static_cast<long double>(sum.low) - right) <
        static_cast<long double>(epsilon<TestType>) / 8);
  CHECK(x == sum.high);
  CHECK(low == sum.low);
  CHECK(plain == 1);  // every term is lost
}

TEST_CASE("a sum of products that all but cancel keeps the digits of what is left", "[core]") {
  const double a[] = {3e-6, 0.1, -0.3, 1e8, -1e8, 0.1}, b[] = {1, 3, 1, 1.1, 1.1, -1e-9};
  double x = 0, low = 0;
  DoubleDouble right = 0;
  for (int i = 0; i < 6; ++i) {
    add_product_to(x, low, a[i], b[i]);
    right += DoubleDouble::product(a[i], b[i]);
  }
  CHECK(std::abs(x + low - right.high) <= 4e-22);
  CHECK(std::abs(x - right.high) > 1e-10);
  for (const double huge : {1e308, 1e308}) add_product_to(x, low, huge, 1.);
  CHECK(std::isinf(x + low));
}

TEST_CASE("NaN goes through a compensated sum", "[core]") {
  CHECK(std::isnan(add(Sum<double>{1, 0}, gyrostat::nan<double>).high));
}
