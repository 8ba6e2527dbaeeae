// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/root.hpp"

#include "catch.hpp"

using namespace gyrostat::math;
using gyrostat::Errc;

TEMPLATE_TEST_CASE("roots to rounding, in few calls", "[math]", float, double, long double) {
  using S = TestType;
  int calls = 0;
  const auto slope = [&](S x) {
    ++calls;
    return Slope<S>{std::cos(x) - x, -std::sin(x) - 1};
  };
  const auto newton = newton_root(slope, S(0), S(1), false);
  REQUIRE(newton);
  CHECK(std::abs(*newton - S(0.739085133215160641655312087673873404L)) <= 2 * gyrostat::epsilon<S>);
  CHECK(calls <= 6);
  calls = 0;
  const auto value = [&](S x) {
    ++calls;
    return std::cos(x) - x;
  };
  const auto secant = bracketed_root(value, S(0), S(1));
  REQUIRE(secant);
  CHECK(std::abs(*secant - *newton) <= 4 * gyrostat::epsilon<S>);
  CHECK(calls <= 14);
}

TEST_CASE("roots at any exponent, at poles, flat and at an end", "[math]") {
  int calls = 0;
  const auto tiny = [&](double x) {
    ++calls;
    return Slope<double>{x * x * x - 2e-60, 3 * x * x};
  };
  CHECK(*newton_root(tiny, 0.0, 10.0, true) == Approx(std::cbrt(2.0) * 1e-20).epsilon(1e-15));
  CHECK(calls < 60);
  CHECK(*newton_root([](double x) { return Slope<double>{x * x - 1e-300, 2 * x}; }, 0.0, 1.0, true) ==
        Approx(1e-150).epsilon(1e-15).margin(0));
  calls = 0;
  CHECK(*bracketed_root([&](double x) { return tiny(x).f; }, 0.0, 10.0) ==
        Approx(std::cbrt(2.0) * 1e-20).epsilon(1e-15));
  CHECK(calls < 60);
  // poles at both ends, with the signs known
  const auto poles = [](double x) {
    return Slope<double>{1 / x - 1e3 / (1 - x), -1 / (x * x) - 1e3 / ((1 - x) * (1 - x))};
  };
  CHECK(*newton_root(poles, 0.0, 1.0, false) == Approx(1 / 1001.0).epsilon(1e-15));
  // Newton alone diverges here
  const auto far = [](double x) { return Slope<double>{std::atan(x - 50), 1 / (1 + (x - 50) * (x - 50))}; };
  CHECK(*newton_root(far, -1e8, 1e9, true) == Approx(50.0).epsilon(1e-15));
  // a zero slope at the start
  const auto flat = [](double x) { return Slope<double>{x * x * x - x * x - 1, 3 * x * x - 2 * x}; };
  CHECK(*newton_root(flat, -3.0, 3.0, true) == Approx(1.4655712318767680267).epsilon(1e-15));
  // a root on the end, and the bracket of one point
  CHECK(*bracketed_root([](double x) { return x; }, 0.0, 1.0) == 0);
  CHECK(*newton_root(flat, 2.0, 2.0, true, 2.0) == 2.0);
  // a tolerance
  CHECK(std::abs(*bracketed_root([](double x) { return x * x - 2; }, 0.0, 2.0, 1e-3) - std::sqrt(2.0)) < 1e-3);
}

TEST_CASE("searches that fail say why", "[math]") {
  const double bad = gyrostat::nan<double>;
  const auto slope = [](double x) { return Slope<double>{x, 1}; };
  const auto value = [](double x) { return x; };
  CHECK(newton_root(slope, 1.0, -1.0, true).error() == Errc::not_increasing);
  CHECK(newton_root(slope, bad, 1.0, true).error() == Errc::not_increasing);
  CHECK(bracketed_root(value, 1.0, -1.0).error() == Errc::not_increasing);
  CHECK(bracketed_root(value, bad, 1.0).error() == Errc::not_increasing);
  CHECK(bracketed_root(value, 1.0, 2.0).error() == Errc::no_bracket);
  CHECK(newton_root([&](double) { return Slope<double>{bad, 1}; }, 0.0, 1.0, true).error() == Errc::not_finite);
  CHECK(bracketed_root([&](double x) { return x > 0.3 && x < 0.7 ? bad : x - 0.5; }, 0.0, 1.0).error() ==
        Errc::not_finite);
  // no root at all: the search ends at the step, within its cap
  int calls = 0;
  const auto jump = [&](double x) {
    ++calls;
    return x < 0.4 ? -1.0 : 1.0;
  };
  CHECK(*bracketed_root(jump, 0.0, 1.0) == Approx(0.4));
  CHECK(calls <= root_calls);
  calls = 0;
  const auto wild = [&](double x) {
    ++calls;
    return Slope<double>{x < 0.4 ? -1.0 : 1.0, 1e-9 * x};
  };
  CHECK(*newton_root(wild, 0.0, 1.0, true) == Approx(0.4));
  CHECK(calls <= root_calls);
}
