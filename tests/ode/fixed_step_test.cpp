// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/fixed_step.hpp"

#include <cmath>
#include <complex>

#include "catch.hpp"

using gyrostat::ode::classical_step;

TEMPLATE_TEST_CASE("a polynomial of degree 4 in the step, and so the error of order 4", "", double, long double) {
  using S = TestType;
  const auto f = [](const std::complex<S>& y) noexcept { return std::complex<S>(0, 1) * y; };
  for (const S h : {S(0.5L), S(-0.3L)}) {
    const std::complex<S> z(0, h);
    const std::complex<S> expected = S(1) + z * (S(1) + z / S(2) * (S(1) + z / S(3) * (S(1) + z / S(4))));
    CHECK(std::abs(classical_step(f, std::complex<S>(1), h) - expected) <= 4 * gyrostat::epsilon<S>);
  }
  S last = 0;
  for (const int steps : {20, 40, 80}) {
    std::complex<S> y = 1;
    for (int i = 0; i < steps; ++i) y = classical_step(f, y, S(1) / S(steps));
    const S error = std::abs(y - std::polar(S(1), S(1)));
    if (last > 0) CHECK(std::log2(last / error) == Approx(4).margin(0.1));
    last = error;
  }
}

TEST_CASE("what is not linear too") {
  const auto f = [](double y) noexcept { return y * y; };
  double y = 1;
  for (int i = 0; i < 100; ++i) y = classical_step(f, y, 0.005);
  CHECK(y == Approx(2).epsilon(1e-8));
}
