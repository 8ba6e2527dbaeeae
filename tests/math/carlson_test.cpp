// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/carlson.hpp"

#include "catch.hpp"
#include "gyrostat/core/double_double.hpp"

using namespace gyrostat::math;

// values of Carlson 1995 ("Numerical computation of real or complex elliptic integrals"), section 3
TEMPLATE_TEST_CASE("Carlson's own examples", "[math]", float, double, long double) {
  using S = TestType;
  const double eps = 8 * static_cast<double>(gyrostat::epsilon<S>) + 1e-13;
  CHECK(carlson_RF<S>(1, 2, 0) == Approx(1.3110287771461).epsilon(eps));
  CHECK(carlson_RF<S>(S(0.5), 1, 0) == Approx(1.8540746773014).epsilon(eps));
  CHECK(carlson_RF<S>(2, 3, 4) == Approx(0.58408284167715).epsilon(eps));
  CHECK(carlson_RC<S>(0, S(0.25)) == Approx(3.1415926535898).epsilon(eps));
  CHECK(carlson_RC<S>(S(2.25), 2) == Approx(0.69314718055995).epsilon(eps));
  CHECK(carlson_RJ<S>(0, 1, 2, 3) == Approx(0.77688623778582).epsilon(eps));
  CHECK(carlson_RJ<S>(2, 3, 4, 5) == Approx(0.14297579667157).epsilon(eps));
  CHECK(carlson_RD<S>(0, 2, 1) == Approx(1.7972103521034).epsilon(eps));
  CHECK(carlson_RD<S>(2, 3, 4) == Approx(0.16510527294261).epsilon(eps));
}

TEMPLATE_TEST_CASE("laws of Carlson's integrals", "[math]", float, double, long double) {
  using S = TestType;
  const S eps = gyrostat::epsilon<S>;
  const S x = S(0.02), y = S(1.3), z = S(40), p = S(0.7);
  const auto near = [&](S a, S b) { return std::abs(a - b) <= 12 * eps * std::abs(b); };
  CHECK(near(carlson_RF(x, y, z), carlson_RF(z, x, y)));
  CHECK(near(carlson_RF<S>(16 * x, 16 * y, 16 * z), carlson_RF(x, y, z) / 4));
  CHECK(near(carlson_RD<S>(4 * x, 4 * y, 4 * z), carlson_RD(x, y, z) / 8));
  CHECK(near(carlson_RJ(x, y, z, z), carlson_RD(x, y, z)));
  CHECK(near(carlson_RJ(x, y, z, p), carlson_RJ(z, y, x, p)));
  // DLMF 19.21.8
  CHECK(near(carlson_RD(x, y, z) + carlson_RD(y, z, x) + carlson_RD(z, x, y), 3 / std::sqrt(x * y * z)));
  CHECK(near(carlson_RC(x, y), std::acos(std::sqrt(x / y)) / std::sqrt(y - x)));
  CHECK(near(carlson_RF(z, z, z), 1 / std::sqrt(z)));
}

TEST_CASE("the series of R_F does for a double and for two words", "[math]") {
  using Wide = gyrostat::DoubleDouble;
  // 40 digits (mpmath); the first needs no duplication in two words, the second none in one
  struct Row {
    double x, y, z;
    Wide value;
  };
  const Row rows[] = {{1, 1.002, .999, {0x1.ffea30d03ef86p-1, -0x1.874ff3c2e4657p-58}},
                      {1, 1.05, .96, {0x1.ff407b478d92dp-1, -0x1.4601b4a081129p-55}},
                      {.5, 2, .001, {0x1.7e7d00f1c6002p+0, -0x1.9035f80cf0c47p-54}}};
  for (const Row& row : rows) {
    CAPTURE(row.x, row.y, row.z);
    CHECK(std::abs(carlson_RF<double>(row.x, row.y, row.z) - row.value.high) <=
          2 * gyrostat::epsilon<double> * row.value.high);
    CHECK(abs(carlson_RF<Wide>(row.x, row.y, row.z) - row.value) <= 16 * gyrostat::epsilon<Wide> * row.value);
  }
}

TEMPLATE_TEST_CASE("Carlson's R_J where the fourth argument is far above the others", "[math]", float, double,
                   long double) {
  using S = TestType;
  // 3/p (R_F - pi/2 / sqrt(p)) but for the next order, 1/p of it
  const S rf = carlson_RF<S>(1, 2, 3);
  for (const S p : {S(1e12), S(1e24), S(1e30), S(1e36)}) {
    CAPTURE(p);
    const S limit = 3 * (rf - gyrostat::pi<S> / 2 / std::sqrt(p));
    CHECK(std::abs(carlson_RJ<S>(1, 2, 3, p) * p / limit - 1) <= 16 * gyrostat::epsilon<S> + 10 / p);
  }
}

TEMPLATE_TEST_CASE("Carlson's integrals outside their domain", "[math]", float, double, long double) {
  using S = TestType;
  const S bad = gyrostat::nan<S>, endless = gyrostat::infinity<S>;
  CHECK(carlson_RF<S>(0, 0, 1) == endless);
  CHECK(carlson_RD<S>(0, 0, 1) == endless);
  CHECK(carlson_RD<S>(1, 1, 0) == endless);
  CHECK(carlson_RJ<S>(1, 2, 3, 0) == endless);
  CHECK(std::isnan(carlson_RF<S>(-1, 1, 1)));
  CHECK(std::isnan(carlson_RF<S>(bad, 1, 1)));
  CHECK(std::isnan(carlson_RD<S>(1, bad, 1)));
  CHECK(std::isnan(carlson_RD<S>(1, 1, -1)));
  CHECK(std::isnan(carlson_RJ<S>(1, 1, 1, -1)));
  CHECK(std::isnan(carlson_RJ<S>(1, 1, bad, 1)));
}
