// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/elementary.hpp"

#include "table.hpp"

using namespace gyrostat::math::detail;

TEST_CASE("elementary functions on their short ranges", "[math]") {
  table::Worst worst({"sin", "cos", "sinh", "cosh", "angle"});
  for (int i = -4000; i <= 4000; ++i) {
    const double z = i * (0.7853981633974484 / 4000) * (i % 3 ? 1 : 1e-6);
    const auto circular = sine_cosine(z);
    worst.see(0, table::ulps(circular.s, std::sin(static_cast<long double>(z))));
    worst.see(1, table::ulps(circular.c, std::cos(static_cast<long double>(z))));
    for (double y : {z, 25 * z, 380 * z}) {
      const auto hyperbolic = sinh_cosh(y);
      worst.see(2, table::ulps(hyperbolic.s, std::sinh(static_cast<long double>(y))));
      worst.see(3, table::ulps(hyperbolic.c, std::cosh(static_cast<long double>(y))));
    }
    const double x = std::abs(i % 7) * 0.17, y = z * (i % 5);
    if (x == 0 && y == 0) continue;
    worst.see(4, table::ulps(angle(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  SUCCEED(worst.text());
  for (std::size_t column = 0; column < 5; ++column) {
    INFO(column);
    CHECK(worst.of(column) < 3);
  }
  CHECK(std::isnan(sine_cosine(gyrostat::nan<double>).s));
  CHECK(std::isnan(sinh_cosh(gyrostat::nan<double>).c));
  CHECK(std::isnan(angle(gyrostat::nan<double>, 1.0)));
  CHECK(angle(-0.0, 1.0) == 0);
  CHECK(std::signbit(angle(-0.0, 1.0)));
}
