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
