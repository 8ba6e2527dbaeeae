// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/free/turns.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/core/double_double.hpp"

namespace free_turns_test {

using namespace gyrostat;
using gyrostat::free::detail::Fraction, gyrostat::free::detail::Growth, gyrostat::free::detail::Turns,
    gyrostat::free::detail::Winding;
using Wide = DoubleDouble;

TEST_CASE("of many turns the last fraction is kept", "[free]") {
  std::mt19937_64 draw(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    // the turns are rate t + start, each to two words
    const Wide rate = Wide(any(draw)) + Wide(1e-17 * any(draw)), start = Wide(any(draw)) + Wide(1e-17 * any(draw));
    const double t = any(draw) * std::pow(10., double(i % 10));
    const auto found = Fraction<double>::of(Turns<double>::split(rate), t, Turns<double>::split(start));
    const Wide turns = rate * Wide(t) + start, left = turns - Wide(found.whole) - Wide(found.high) - Wide(found.low);
    CAPTURE(i, t);
    CHECK(found.whole == std::nearbyint(found.whole));
    CHECK(std::abs(found.high) <= 0.5 + 1e-15);
    CHECK(std::abs(found.low) <= 1e-16);
    CHECK(1e30 * std::abs(double(left)) <= 1 + std::abs(t));
  }
  const auto half = Fraction<double>::of({0.25, 0}, 1e9 + 2, {0, 0});
  CHECK(half.whole + half.high == 0.25e9 + 0.5);
}

TEST_CASE("rows of unit numbers are wound up, and exponentials grown", "[free]") {
  constexpr int most = 64;
  double re[most + 8], im[most + 8], up[most + 8];
  for (const double turns : {0.01, -0.3, 0.5, 7.25}) {
    const Winding<double> winding(Fraction<double>::of({turns, 0}, 1, {0, 0}));
    const Growth<double> growth(turns / 8);
    for (const int n : {1, 8, 9, 33, most}) {
      winding.wind(math::unit(0.4), re, im, n);
      growth.grow(1.5, up, n);
      for (int k = 0; k < n; ++k) {
        CAPTURE(turns, n, k);
        const double angle = 0.4 + 2 * pi<double> * std::remainder(turns * k, 1.);
        CHECK(re[k] == Approx(std::cos(angle)).margin(1e-14));
        CHECK(im[k] == Approx(std::sin(angle)).margin(1e-14));
        CHECK(up[k] == Approx(1.5 * std::exp(turns / 8 * k)).epsilon(1e-14));
      }
    }
  }
}

}  // namespace free_turns_test
