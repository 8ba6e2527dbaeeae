// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/core/lane_pair.hpp"

#include "catch.hpp"

#include <array>

using namespace gyrostat;

namespace {

template <class S>
std::array<S, 8> numbers(const LanePair<S>& a) {
  std::array<S, 8> to;
  store_pair(to.data(), a);
  return to;
}

}  // namespace

TEMPLATE_TEST_CASE("two times four numbers side by side", "", float, double, long double) {
  using S = TestType;
  using Eight = std::array<S, 8>;
  const S from[9] = {-1, 0, 1, 2, 3, 4, 5, 6, 7};
  const LanePair<S> a = load_pair(from + 1), ten = lane_pair(S(10));
  CHECK(numbers<S>(a) == Eight{0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(numbers<S>(multiply_add(a, ten, ten)) == Eight{10, 20, 30, 40, 50, 60, 70, 80});
  CHECK(numbers<S>(a + ten - a * ten) == Eight{10, 1, -8, -17, -26, -35, -44, -53});
  CHECK(numbers<S>(shuffle_halves<1, 2, 0, 3, S>(a)) == Eight{1, 2, 0, 3, 5, 6, 4, 7});
  CHECK(numbers<S>(exchanged<S>(a)) == Eight{4, 5, 6, 7, 0, 1, 2, 3});
  CHECK(numbers<S>(halves<S>(ten, a)) == Eight{10, 10, 10, 10, 4, 5, 6, 7});
  CHECK(numbers<S>(lane_pair(load(from), load(from + 5))) == Eight{-1, 0, 1, 2, 4, 5, 6, 7});
}
