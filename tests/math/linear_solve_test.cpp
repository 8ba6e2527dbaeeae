// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/linear_solve.hpp"

#include "catch.hpp"

#include <random>
#include <vector>

using namespace gyrostat;
using namespace gyrostat::math;

TEMPLATE_TEST_CASE("linear solve: the solution solves", "", float, double, long double) {
  using S = TestType;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 17U, 40U}) {
    const std::size_t stride = padded(n);
    std::vector<S> a(n * stride), b(n);
    for (S& x : a) x = S(u(random));
    for (S& x : b) x = S(u(random));
    auto lost = a, x = b;
    REQUIRE(solve_in_place<S>(lost, x));
    S size = 1;
    for (const S value : x) size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < n; ++i) {
      S sum = -b[i];
      for (std::size_t j = 0; j < n; ++j) sum += a[i * stride + j] * x[j];
      CHECK(std::abs(sum) < 16 * S(n) * epsilon<S> * size);
    }
  }
}

TEST_CASE("linear solve: pivots where the diagonal vanishes") {
  std::vector<double> a{0, 1, 0, 0, 2, 0, 0, 0}, b{3, 4};
  REQUIRE(solve_in_place<double>(a, b));
  CHECK(b[0] == 2);
  CHECK(b[1] == 3);
}

TEST_CASE("linear solve: what has no solution is refused") {
  std::vector<double> a{1, 2, 0, 0, 2, 4, 0, 0}, b{3, 4}, c{1, 0, 0, 0, 0, gyrostat::nan<double>, 0, 0};
  CHECK_FALSE(solve_in_place<double>(a, b));
  CHECK_FALSE(solve_in_place<double>(c, b));
  CHECK_FALSE(solve_in_place<double>(std::span<double>(c).first(4), b));
}
