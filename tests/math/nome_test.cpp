// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/nome.hpp"

#include "gyrostat/math/complete.hpp"
#include "table.hpp"

using namespace gyrostat::math;

TEMPLATE_TEST_CASE("the nome is exp(-pi K'/K)", "[math]", double, long double) {
  using S = TestType;
  for (S k2 : {S(0.5), S(0.3), S(0.1), S(1e-2), S(1e-4)}) {
    const auto m = Modulus<S>::from_k2(k2);
    const S ratio = complete(m.complement()).K / complete(m).K;
    CHECK(std::abs(nome(m) / std::exp(-gyrostat::pi<S> * ratio) - 1) <= 20 * gyrostat::epsilon<S> * ratio);
  }
  // q = k2/16 (1 + k2/2 + 21 k2^2/64 ...)
  for (S k2 : {S(1e-300), S(1e-100), S(1e-10)})
    CHECK(std::abs(nome(Modulus<S>::from_k2(k2)) / (k2 / 16 * (1 + k2 / 2)) - 1) <= 4 * gyrostat::epsilon<S>);
  CHECK(nome(Modulus<S>{0, 1}) == 0);
}

TEMPLATE_TEST_CASE("theta functions", "[math]", double, long double) {
  using S = TestType;
  const S eps = gyrostat::epsilon<S>;
  const S q = std::exp(-gyrostat::pi<S>);
  const auto zero = ThetaConstants<S>::of(q);
  // theta_3^4 = theta_2^4 + theta_4^4; at q = exp(-pi) theta_2 = theta_4 and theta_3 = pi^(1/4)/Gamma(3/4)
  const auto fourth = [](S x) { return x * x * x * x; };
  CHECK(std::abs(fourth(zero.three) - 16 * q * fourth(zero.two) - fourth(zero.four)) <= 12 * eps);
  CHECK(std::abs(zero.three - S(1.08643481121330801457531612151022345707L)) <= 4 * eps);
  CHECK(std::abs(2 * std::pow(q, S(0.25)) * zero.two - zero.four) <= 8 * eps);
  const auto at_zero = Thetas<S>::of(q, 1);
  CHECK(std::abs(at_zero.two - zero.two) <= 2 * eps);
  CHECK(std::abs(at_zero.three - zero.three) <= 2 * eps);
  CHECK(std::abs(at_zero.four - zero.four) <= 2 * eps);
  // theta_1'(0) = theta_2 theta_3 theta_4
  CHECK(std::abs(at_zero.one - zero.two * zero.three * zero.four) <= 6 * eps);
  // the sums against their definition, at a real and at an imaginary argument half a quarter period away
  const S quarter = gyrostat::pi<S> / 4;
  for (const bool real : {true, false}) {
    const S z = real ? quarter : -std::log(q) / 4;
    const auto cosine = [&](S x) { return real ? std::cos(x) : std::cosh(x); };
    const auto sine = [&](S x) { return real ? std::sin(x) : std::sinh(x); };
    const auto t = Thetas<S>::of(q, cosine(2 * z));
    S one = 0, two = 0, three = 1, four = 1, slope_two = 0, slope_three = 0, slope_four = 0;
    for (int n = 0; n < 12; ++n) {
      const S between = std::pow(q, S(n * (n + 1))), power = std::pow(q, S(n * n)), sign = n % 2 ? S(-1) : S(1);
      one += sign * between * sine(S(2 * n + 1) * z) / sine(z);
      two += between * cosine(S(2 * n + 1) * z) / cosine(z);
      slope_two += between * S(2 * n + 1) * sine(S(2 * n + 1) * z) / sine(z);
      if (n == 0) continue;
      three += 2 * power * cosine(S(2 * n) * z);
      four += 2 * sign * power * cosine(S(2 * n) * z);
      slope_three += power * S(n) * sine(S(2 * n) * z) / sine(2 * z);
      slope_four -= sign * power * S(n) * sine(S(2 * n) * z) / sine(2 * z);
    }
    CHECK(std::abs(t.one - one) <= 8 * eps);
    CHECK(std::abs(t.two - two) <= 8 * eps);
    CHECK(std::abs(t.three - three) <= 8 * eps);
    CHECK(std::abs(t.four - four) <= 8 * eps);
    CHECK(std::abs(t.slope_two - slope_two) <= 8 * eps);
    CHECK(std::abs(t.slope_three - slope_three) <= 8 * eps * slope_three);
    CHECK(std::abs(t.slope_four - slope_four) <= 8 * eps * slope_four);
  }
}
