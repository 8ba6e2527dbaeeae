// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/incomplete.hpp"

#include "gyrostat/math/jacobi.hpp"
#include "table.hpp"

using namespace gyrostat::math;
using gyrostat::pi;

TEMPLATE_TEST_CASE("incomplete integrals against the table", "[math]", float, double, long double) {
  // columns: phi, n, F, E, Pi. Forgiven is the error that a relative error of one eps in phi makes.
  table::Worst worst({"F", "E", "Pi"});
  int rows = 0;
  for (const auto& row : table::read("incomplete")) {
    if (!row.fits<TestType>()) continue;
    ++rows;
    const auto m = row.modulus<TestType>();
    const auto phi = static_cast<TestType>(row.value[0]);
    const auto n = static_cast<TestType>(row.value[1]);
    const TestType got[] = {incomplete_F(phi, m), incomplete_E(phi, m), incomplete_Pi(phi, n, m)};
    const long double s = std::sin(row.value[0]), c = std::cos(row.value[0]);
    const long double delta = std::sqrt(c * c + static_cast<long double>(m.kp2) * s * s);
    const long double slope[] = {1 / delta, delta, 1 / delta / (1 - row.value[1] * s * s)};
    for (std::size_t i = 0; i < 3; ++i) {
      const long double slack =
          std::abs(slope[i] * row.value[0]) * static_cast<long double>(gyrostat::epsilon<TestType>);
      const double error = table::ulps(got[i], row.value[i + 2], slack);
      INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2") << " phi "
                    << static_cast<double>(row.value[0]) << " n " << static_cast<double>(row.value[1]) << " column "
                    << i);
      CHECK(error < (i == 2 ? 12.0 : 6.0));
      worst.see(i, error);
    }
  }
  SUCCEED(worst.text());
  CHECK(rows > 150);
}

TEMPLATE_TEST_CASE("incomplete integrals at the ends", "[math]", float, double, long double) {
  using S = TestType;
  const S eps = gyrostat::epsilon<S>;
  for (S k2 : {S(0.1), S(0.7)}) {
    const auto m = Modulus<S>::from_k2(k2);
    const auto whole = complete(m);
    CHECK(std::abs(incomplete_F(pi<S> / 2, m) - whole.K) <= 8 * eps);
    CHECK(std::abs(incomplete_E(pi<S> / 2, m) - whole.E) <= 8 * eps);
    CHECK(std::abs(incomplete_F(S(0.4) + 6 * pi<S>, m) - incomplete_F(S(0.4), m) - 12 * whole.K) <= 80 * eps);
    CHECK(std::abs(incomplete_Pi(S(0.9), S(0), m) - incomplete_F(S(0.9), m)) <= 4 * eps);
    // Pi with n = k2 is known: (E - k2 sin cos/delta)/kp2
    const S s = std::sin(S(0.9)), c = std::cos(S(0.9));
    const S known = (incomplete_E(S(0.9), m) - k2 * s * c / std::sqrt(1 - k2 * s * s)) / m.kp2;
    CHECK(std::abs(incomplete_Pi(S(0.9), k2, m) - known) <= 12 * eps);
    // am inverts F; the zeta function is E(am u) - F u
    const S u = S(0.77);
    const auto f = jacobi(u, m);
    CHECK(std::abs(incomplete_F(f.am, m) - u) <= 8 * eps);
    CHECK(std::abs(incomplete_E(f.am, m) - means(m).F * u - zeta(u, m)) <= 8 * eps);
  }
  const Modulus<S> circle{0, 1}, separatrix{1, 0};
  CHECK(std::abs(incomplete_F(S(7), circle) - 7) <= 16 * eps);
  CHECK(std::abs(incomplete_E(S(7), circle) - 7) <= 16 * eps);
  CHECK(std::abs(incomplete_F(S(1), separatrix) - std::asinh(std::tan(S(1)))) <= 8 * eps);
  CHECK(std::abs(incomplete_E(S(1), separatrix) - std::sin(S(1))) <= 2 * eps);
  CHECK(incomplete_F(S(4), separatrix) == gyrostat::infinity<S>);
  CHECK(incomplete_F(S(0), separatrix) == 0);

  const S bad = gyrostat::nan<S>, endless = gyrostat::infinity<S>;
  for (S phi : {bad, endless, -endless}) {
    CHECK(std::isnan(incomplete_F(phi, circle)));
    CHECK(std::isnan(incomplete_E(phi, circle)));
    CHECK(std::isnan(incomplete_Pi(phi, S(0.5), circle)));
  }
  CHECK(std::isnan(incomplete_F(S(1), {S(2), S(-1)})));
  CHECK(std::isnan(incomplete_E(S(1), {S(-1), S(2)})));
  CHECK(std::isnan(incomplete_Pi(S(1), bad, circle)));
  CHECK(std::isnan(incomplete_Pi(S(1), S(2), circle)));  // the integrand has a pole on the way
  CHECK(std::isnan(incomplete_Pi(S(4), S(1.1), circle)));
}
