// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/associate.hpp"

#include <cmath>

#include "table.hpp"

using gyrostat::math::detail::Associate;
using gyrostat::math::detail::logarithm_of_positive;

TEST_CASE("the logarithm of a positive number", "[math]") {
  double worst = 0;
  for (double x = 5e-324; x < 1e200; x *= 1.37 + (x < 1e-320 ? 1 : 0)) {
    const long double truth = std::log(static_cast<long double>(x));
    worst = std::max(worst,
                     static_cast<double>(std::abs(logarithm_of_positive(x) - truth) / std::max(1.0L, std::abs(truth))));
  }
  for (double x = 0.5; x < 2; x += 1e-4) {
    const long double truth = std::log(static_cast<long double>(x));
    worst = std::max(worst, static_cast<double>(std::abs(logarithm_of_positive(x) - truth)));
  }
  CHECK(worst < gyrostat::epsilon<double>);
  CHECK(worst > 0);
  CHECK(logarithm_of_positive(1.0) == 0);
  CHECK(std::isfinite(logarithm_of_positive(0.0)));
}

TEST_CASE("the associate integrals against the table", "[math]") {
  for (const auto& row : table::read("complete")) {
    const auto m = row.modulus<double>();
    const auto at = Associate::of(m.kp2);
    INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2"));
    // D = W K/k2, B = V K/k2; k2 in long double, so that its rounding does not count
    const long double k2 = row.of_k2 ? row.small : 1 - row.small;
    CHECK(table::ulps(at.D, row.value[3] * row.value[0] / k2) < 3);
    CHECK(table::ulps(at.B, row.value[4] * row.value[0] / k2) < 3);
  }
}
