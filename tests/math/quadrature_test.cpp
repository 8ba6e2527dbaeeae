// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/quadrature.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace gyrostat;
using gyrostat::math::halved_panels;
using gyrostat::math::kronrod_points;

TEMPLATE_TEST_CASE("Kronrod's rule is exact to degree 23, Gauss's in it to degree 13", "", float, double, long double) {
  using S = TestType;
  for (int degree = 0; degree <= 24; ++degree) {
    S kronrod = 0, gauss = 0;
    for (const auto& p : kronrod_points<S>) {
      kronrod += p.weight * std::pow(p.node, S(degree));
      gauss += p.gauss_weight * std::pow(p.node, S(degree));
    }
    const S exact = degree % 2 == 0 ? S(2) / S(degree + 1) : S(0);
    CAPTURE(degree);
    if (degree <= 23) CHECK(std::abs(kronrod - exact) <= 8 * epsilon<S>);
    if (degree <= 13) CHECK(std::abs(gauss - exact) <= 8 * epsilon<S>);
    if (degree == 14) CHECK(std::abs(gauss - exact) > S(1e-5));
  }
}

TEST_CASE("the parts follow each other without a gap, and only those that are refused are halved") {
  struct Part {
    double left, right;
  };
  std::vector<Part> parts;
  const auto reached = [&](int panels, int deepest, double place) {
    parts.clear();
    return halved_panels(0.0, 3.0, panels, deepest, [&](double middle, double half, bool halvable) -> Result<bool> {
      const bool holds = middle - half < place && place < middle + half;
      if (holds && halvable) return false;
      parts.push_back({middle - half, middle + half});
      return true;
    });
  };
  for (const double place : {1e-9, 0.4, 1.1, 1.9999, 2.9999}) {
    for (const int deepest : {0, 1, 7}) {
      REQUIRE(reached(3, deepest, place) == Errc::ok);
      CHECK(parts.size() == std::size_t(3 + deepest));
      CHECK(parts.front().left == 0);
      CHECK(parts.back().right == Approx(3).epsilon(1e-15));
      double least = 3;
      for (std::size_t i = 1; i < parts.size(); ++i) CHECK(parts[i].left == Approx(parts[i - 1].right).epsilon(1e-15));
      for (const Part& p : parts) least = std::min(least, p.right - p.left);
      CHECK(least == Approx(std::ldexp(1.0, -deepest)));
    }
  }
}

TEST_CASE("halving finds the sharp peak that one panel misses") {
  const double sharp = 1e-3;
  const auto f = [&](double x) { return 1 / (sharp + x * x); };
  double sum = 0;
  int calls = 0;
  const Errc wrong = halved_panels(-1.0, 2.0, 1, 12, [&](double middle, double half, bool) -> Result<bool> {
    double kronrod = 0, gauss = 0;
    for (const auto& p : kronrod_points<double>) {
      const double value = half * f(middle + half * p.node);
      ++calls;
      kronrod += p.weight * value;
      gauss += p.gauss_weight * value;
    }
    if (std::abs(kronrod - gauss) > 1e-6 * kronrod) return false;
    sum += kronrod;
    return true;
  });
  REQUIRE(wrong == Errc::ok);
  const double root = std::sqrt(sharp);
  CHECK(sum == Approx((std::atan(2 / root) + std::atan(1 / root)) / root).epsilon(1e-7));
  CHECK(calls < 1000);
}

TEST_CASE("an error ends the walk") {
  int calls = 0;
  const Errc wrong = halved_panels(0.0, 1.0, 8, 3, [&](double, double, bool) -> Result<bool> {
    if (++calls == 3) return Errc::not_finite;
    return true;
  });
  CHECK(wrong == Errc::not_finite);
  CHECK(calls == 3);
}
