// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/least_squares.hpp"

#include "catch.hpp"

#include <random>

using namespace gyrostat;
using namespace gyrostat::math;

namespace {

template <class S, std::size_t R, std::size_t C>
struct System {
  std::array<std::array<S, R>, C> columns{};
  std::array<S, R> b{};

  std::array<S, R> residual(const std::array<S, C>& x) const {
    std::array<S, R> r = b;
    for (std::size_t i = 0; i < R; ++i)
      for (std::size_t j = 0; j < C; ++j) r[i] -= columns[j][i] * x[j];
    return r;
  }
};

template <class S, std::size_t R, std::size_t C>
System<S, R, C> any(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  System<S, R, C> s;
  for (auto& column : s.columns)
    for (auto& a : column) a = S(u(random));
  for (auto& b : s.b) b = S(u(random));
  return s;
}

}  // namespace

TEMPLATE_TEST_CASE("least squares: the residual is across all columns", "", float, double, long double) {
  using S = TestType;
  std::mt19937 random(1);
  for (int n = 0; n < 50; ++n) {
    const auto s = any<S, 7, 4>(random);
    const auto r = s.residual(least_squares(s.columns, s.b, S(0)));
    for (const auto& column : s.columns) {
      S dot = 0;
      for (std::size_t i = 0; i < 7; ++i) dot += column[i] * r[i];
      CHECK(std::abs(dot) < 64 * epsilon<S>);
    }
  }
}

TEMPLATE_TEST_CASE("least squares: a square system is solved, whatever its units", "", float, double, long double) {
  using S = TestType;
  std::mt19937 random(2);
  for (int n = 0; n < 50; ++n) {
    auto s = any<S, 3, 3>(random);
    for (auto& a : s.columns[1]) a *= S(1e12L);
    for (const S r : s.residual(least_squares(s.columns, s.b, S(0)))) CHECK(std::abs(r) < 1000 * epsilon<S>);
  }
}

TEST_CASE("least squares: a column in the span of the others is left out") {
  std::mt19937 random(3);
  auto s = any<double, 6, 3>(random);
  for (std::size_t i = 0; i < 6; ++i) s.columns[2][i] = s.columns[0][i] - 2 * s.columns[1][i];
  const auto x = least_squares(s.columns, s.b, 1e-13);
  CHECK((x[0] == 0) + (x[1] == 0) + (x[2] == 0) == 1);
  const System<double, 6, 2> rest{{s.columns[0], s.columns[1]}, s.b};
  const auto two = rest.residual(least_squares(rest.columns, rest.b, 1e-13)), three = s.residual(x);
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(two[i] - three[i]) < 1e-13);
  const System<double, 6, 3> none{};
  for (const double zero : least_squares(none.columns, s.b, 0.0)) CHECK(zero == 0);
}

TEST_CASE("least squares: NaN in, NaN out") {
  std::mt19937 random(4);
  auto s = any<double, 4, 2>(random);
  s.columns[1][2] = gyrostat::nan<double>;
  const auto x = least_squares(s.columns, s.b, 0.0);
  CHECK((x[0] != x[0] && x[1] != x[1]));
}
