// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/chebyshev_panel.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::math;

TEMPLATE_TEST_CASE("a Chebyshev panel integrates and interpolates polynomials exactly", "[math]", float, double,
                   long double) {
  using S = TestType;
  const ChebyshevPanel<S> panel;
  using Values = typename ChebyshevPanel<S>::Values;
  CHECK(panel.node(0) == 0);
  CHECK(panel.node(16) == 1);
  for (int power = 0; power <= 16; ++power) {
    Values f;
    for (std::size_t k = 0; k < f.size(); ++k) f[k] = std::pow(panel.node(k), S(power));
    const Values F = panel.integrated(f, 2, 3);
    for (std::size_t k = 0; k < f.size(); ++k)
      CHECK(std::abs(F[k] - 3 - 2 * std::pow(panel.node(k), S(power + 1)) / S(power + 1)) < 16 * epsilon<S>);
    for (const S x : {S(0), S(0.123L), panel.node(5), S(0.9L), S(1)}) {
      const Values w = panel.weights(x);
      S value = 0;
      for (std::size_t k = 0; k < f.size(); ++k) value += w[k] * f[k];
      CHECK(std::abs(value - std::pow(x, S(power))) < 16 * epsilon<S>);
    }
  }
}

TEST_CASE("a Chebyshev panel of three radians is exact to rounding", "[math]") {
  const ChebyshevPanel<double> panel;
  ChebyshevPanel<double>::Values f;
  for (std::size_t k = 0; k < f.size(); ++k) f[k] = std::cos(3 * panel.node(k) + 0.4);
  const auto F = panel.integrated(f, 3, 0);
  for (std::size_t k = 0; k < f.size(); ++k)
    CHECK(F[k] == Approx(std::sin(3 * panel.node(k) + 0.4) - std::sin(0.4)).margin(4e-16));
  const auto w = panel.weights(0.777);
  double value = 0;
  for (std::size_t k = 0; k < f.size(); ++k) value += w[k] * f[k];
  CHECK(value == Approx(std::cos(3 * 0.777 + 0.4)).margin(4e-16));
}

TEST_CASE("what is not a number stays so on a Chebyshev panel", "[math]") {
  const ChebyshevPanel<double> panel;
  CHECK(std::isnan(panel.weights(gyrostat::nan<double>)[3]));
  ChebyshevPanel<double>::Values f{};
  f[2] = gyrostat::nan<double>;
  CHECK(std::isnan(panel.integrated(f, 1, 0)[16]));
}
