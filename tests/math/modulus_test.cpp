// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/modulus.hpp"

#include <cmath>

#include "catch.hpp"

using gyrostat::math::Modulus;

TEMPLATE_TEST_CASE("a modulus keeps both squares", "[math]", float, double, long double) {
  using S = TestType;
  STATIC_REQUIRE(Modulus<S>::from_k2(S(0.25)).kp2 == S(0.75));
  STATIC_REQUIRE(Modulus<S>::from_kp2(S(0.25)).k2 == S(0.75));
  STATIC_REQUIRE(Modulus<S>::from_k2(S(0.25)).complement().k2 == S(0.75));
  const S tiny = gyrostat::epsilon<S> * gyrostat::epsilon<S>;
  const auto m = Modulus<S>::from_parts(S(3), tiny);
  CHECK(m.k2 == 1);
  CHECK(std::abs(m.kp2 / (tiny / 3) - 1) <= 2 * gyrostat::epsilon<S>);
  CHECK(m.legal());
  CHECK(std::isnan(Modulus<S>::from_parts(0, 0).k2));
  CHECK_FALSE(Modulus<S>::from_parts(0, 0).legal());
  CHECK_FALSE(Modulus<S>::from_k2(S(1.1)).legal());
  CHECK_FALSE(Modulus<S>::from_k2(S(-0.1)).legal());
  CHECK_FALSE(Modulus<S>::from_k2(gyrostat::nan<S>).legal());
  CHECK(Modulus<S>{}.legal());
}
