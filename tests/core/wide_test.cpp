// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/wide.hpp"

#include "catch.hpp"

#include <limits>

using namespace gyrostat;

TEMPLATE_TEST_CASE("as many numbers side by side as a register holds", "", float, double, long double) {
  using S = TestType;
  constexpr int n = wide_size<S>;
  S from[9], to[8];
  for (int i = 0; i < 9; ++i) from[i] = static_cast<S>(i) - 3;
  const Wide<S> a = load_wide(from + 1), b = wide(S(10));
  store(to, multiply_add(a, b, wide(S(1))));
  for (int i = 0; i < n; ++i) CHECK(to[i] == 10 * from[i + 1] + 1);
  store(to, a + b - a * b);
  for (int i = 0; i < n; ++i) CHECK(to[i] == from[i + 1] + 10 - 10 * from[i + 1]);
  store(to, greater_of<S>(a, wide(S(0))));
  for (int i = 0; i < n; ++i) CHECK(to[i] == (from[i + 1] > 0 ? from[i + 1] : 0));
  for (int i = 0; i < n; ++i) CHECK(a[i] == from[i + 1]);

  constexpr S bad = std::numeric_limits<S>::quiet_NaN();
  const Wide<S> nothing = wide(bad);
  CHECK(greater_of<S>(nothing, a)[1] == a[1]);
  CHECK(!(greater_of<S>(a, nothing)[1] == a[1]));
}

TEMPLATE_TEST_CASE("numbers side by side are compared and chosen one by one", "", float, double, long double) {
  using S = TestType;
  constexpr int n = wide_size<S>;
  constexpr S bad = std::numeric_limits<S>::quiet_NaN();
  S x[8] = {0, 1, 2, 3, 4, 5, 6, 7}, y[8] = {3, 1, bad, 0, 9, 5, bad, 1}, to[8];
  const Wide<S> a = load_wide(x), b = load_wide(y);
  const auto lower = less<S>(a, b), higher = less<S>(b, a);
  for (int i = 0; i < n; ++i) {
    CHECK((bits<S>(lower) >> i & 1) == (x[i] < y[i]));
    CHECK((bits<S>(lower | higher) >> i & 1) == (x[i] < y[i] || y[i] < x[i]));
    CHECK((bits<S>(lower & higher) >> i & 1) == 0);
    CHECK((bits<S>(lower & lower) >> i & 1) == (x[i] < y[i]));
  }
  store(to, choose<S>(lower, a, wide(S(-1))));
  for (int i = 0; i < n; ++i) CHECK(to[i] == (x[i] < y[i] ? x[i] : -1));
  store(to, a / wide(S(4)));
  for (int i = 0; i < n; ++i) CHECK(to[i] == x[i] / 4);
  store(to, square_root<S>(a));
  for (int i = 0; i < n; ++i) CHECK(to[i] * to[i] == Approx(x[i]));
}
