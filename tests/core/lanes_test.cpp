// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/lanes.hpp"

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

using namespace gyrostat;

TEMPLATE_TEST_CASE("four numbers side by side", "", float, double, long double) {
  using S = TestType;
  const S from[5] = {7, 1, 2, 3, -4};
  const auto a = load(from + 1);
  const auto b = lanes(S(10), S(20), S(30), S(40));
  S to[4];
  store(to, multiply_add(a, b, lanes(S(1))));
  CHECK((to[0] == 11 && to[1] == 41 && to[2] == 91 && to[3] == -159));
  store(to, a + b - a * b);
  CHECK((to[0] == 1 && to[1] == -18 && to[2] == -57 && to[3] == 196));
  store(to, shuffle<3, 2, 1, 0>(a));
  CHECK((to[0] == -4 && to[1] == 3 && to[2] == 2 && to[3] == 1));
  store(to, with_last(a, b));
  CHECK((to[0] == 1 && to[1] == 2 && to[2] == 3 && to[3] == 40));
  store(to, sum(a));
  CHECK((to[0] == 2 && to[1] == 2 && to[2] == 2 && to[3] == 2));
  CHECK(greatest_magnitude(a) == 4);
  constexpr S bad = std::numeric_limits<S>::quiet_NaN();
  for (int i = 0; i < 4; ++i) {
    S with[4] = {1, 2, 3, 4};
    with[i] = bad;
    CHECK(!(greatest_magnitude(load(with)) == greatest_magnitude(load(with))));
  }
}

TEMPLATE_TEST_CASE("counting up and down", "", double, long double) {
  int digits = 0;
  count_up<TestType, 4>([&](auto k) { digits = 10 * digits + k; });
  CHECK(digits == 1234);
  digits = 0;
  count_down<TestType>(3, [&](int k) { digits = 10 * digits + k; });
  CHECK(digits == 321);
  count_down<TestType>(0, [&](int) { digits = 0; });
  CHECK(digits == 321);
}

TEST_CASE("the share of the next order rounds to either side") {
  unsigned long long bits = 0x9e3779b97f4a7c15ULL;
  const auto next = [&] {
    bits = bits * 6364136223846793005ULL + 1442695040888963407ULL;
    return 1 + double(bits >> 12) * 0x1p-52;
  };
  const auto bias = [&](auto k, bool in_turn) {
    long double sum = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
      const double v = next();
      double to[4];
      store(to, in_turn ? over_next(lanes(v), int(k)) : over_next(lanes(v), k));
      sum += (to[0] * (k + 1.0L) - v) / v;
    }
    return double(sum / count) / gyrostat::epsilon<double>;
  };
  // the rounded reciprocals of 3, 5, 6 and 7 are off by a quarter of epsilon and more
  count_up<double, 8>([&](auto k) {
    CAPTURE(int(k));
    CHECK(std::abs(bias(k, false)) < (k < 8 ? 0.01 : 0.3));
    CHECK(std::abs(bias(k, true)) < 0.01);
  });
  float narrow[4];
  store(narrow, over_next(lanes(3.0F), std::integral_constant<int, 2>{}));
  CHECK(narrow[0] == 1.0F);
  long double precise[4];
  store(precise, over_next(lanes(3.0L), 2));
  CHECK(precise[0] == 1.0L);
}
