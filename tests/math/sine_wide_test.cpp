// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/sine_wide.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "catch.hpp"

using namespace gyrostat;

TEMPLATE_TEST_CASE("sines and cosines side by side", "", float, double, long double) {
  using S = TestType;
  std::mt19937_64 random(1);
  for (const double range : {1e-9, 0.7, 3.0, 20.0, 1e4, 1e6}) {
    std::uniform_real_distribution<double> any(-range, range);
    for (int trial = 0; trial < 2000; ++trial) {
      alignas(64) S x[8];
      for (S& each : x) each = static_cast<S>(any(random));
      const auto found = math::sine_cosine<S>(load_wide(x));
      for (int i = 0; i < wide_size<S>; ++i) {
        CAPTURE(x[i]);
        CHECK(std::abs(found.sine[i] - std::sin(x[i])) <= 2 * epsilon<S> * std::min(S(1), std::abs(x[i])));
        CHECK(std::abs(found.cosine[i] - std::cos(x[i])) <= 2 * epsilon<S>);
      }
    }
  }
}

TEST_CASE("a lane without a number makes none of the others", "[math]") {
  alignas(64) double x[8] = {1, 2, std::numeric_limits<double>::quiet_NaN(), 3, 1, 2, 3, 4};
  const auto found = math::sine_cosine<double>(load_wide(x));
  CHECK(std::isnan(found.sine[2]));
  CHECK(std::isnan(found.cosine[2]));
  CHECK(found.sine[3] == Approx(std::sin(3.0)));
  CHECK(found.cosine[1] == Approx(std::cos(2.0)));
}
