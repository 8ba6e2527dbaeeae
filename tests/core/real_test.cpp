// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/real.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"

using gyrostat::epsilon;
using gyrostat::Real;

static_assert(Real<float> && Real<double> && Real<long double>);
static_assert(!Real<int> && !Real<double&> && !Real<const char*>);

TEMPLATE_TEST_CASE("the constants belong to their scalar", "", float, double, long double) {
  const TestType one(1);
  CHECK(one + epsilon<TestType> > one);
  CHECK((one + epsilon<TestType> / 2 == one) == (std::numeric_limits<TestType>::digits <= 64));
  CHECK(std::isnan(gyrostat::nan<TestType>));
  CHECK(std::isinf(gyrostat::infinity<TestType>));
  CHECK(gyrostat::infinity<TestType> > 0);
  // sin(pi) is what pi misses of the true one: half a unit in its last place at most
  CHECK(std::abs(std::sin(gyrostat::pi<TestType>)) <= 2 * epsilon<TestType>);
}
