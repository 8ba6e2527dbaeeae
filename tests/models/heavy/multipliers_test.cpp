// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/heavy/multipliers.hpp"

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::heavy;

TEMPLATE_TEST_CASE("heavy multipliers: their sum is the trace, their product one", "[heavy]", float, double,
                   long double) {
  using S = TestType;
  constexpr S eps = epsilon<S>;
  for (const S trace :
       {S(-1e6L), S(-30), S(-2.001L), S(-2), S(-1.999L), S(-0.3L), S(0), S(1), S(1.99999L), S(2), S(2.5L), S(1e5L)}) {
    const auto m = multipliers(trace);
    const auto sum = m.first + m.second, product = m.first * m.second;
    CHECK(std::abs(sum.re - trace) <= 4 * eps * std::abs(trace));
    CHECK(sum.im == 0);
    CHECK(std::abs(product.re - 1) < 8 * eps);
    CHECK(std::abs(product.im) < eps);
    CHECK(math::magnitude(m.first) >= math::magnitude(m.second));
    if (std::abs(trace) <= 2) CHECK(std::abs(2 * std::cos(2 * pi<S> * m.turns) - trace) < 16 * eps);
  }
  CHECK(multipliers(S(-7)).turns == S(0.5L));
  CHECK(multipliers(S(7)).turns == 0);
  CHECK(multipliers(S(0)).turns == S(0.25L));
  CHECK(std::isnan(multipliers(gyrostat::nan<S>).turns));
}

TEST_CASE("heavy multipliers: undecided near the borders and within the error", "[heavy]") {
  CHECK(orbit_stability(1.9, 1e-12) == OrbitStability::stable);
  CHECK(orbit_stability(-1.9, 1e-12) == OrbitStability::stable);
  CHECK(orbit_stability(2.1, 1e-12) == OrbitStability::unstable);
  CHECK(orbit_stability(-2.1, 1e-12) == OrbitStability::unstable);
  CHECK(orbit_stability(2 - 0.5e-7, 0.0) == OrbitStability::undecided);
  CHECK(orbit_stability(-2 - 0.5e-7, 0.0) == OrbitStability::undecided);
  CHECK(orbit_stability(2.1, 0.2) == OrbitStability::undecided);
  CHECK(orbit_stability(1.0, gyrostat::nan<double>) == OrbitStability::undecided);
  CHECK(orbit_stability(gyrostat::nan<double>, 0.0) == OrbitStability::undecided);
}
