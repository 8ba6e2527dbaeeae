// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/complete.hpp"

#include <random>

#include "table.hpp"

using namespace gyrostat::math;
using gyrostat::infinity;
using gyrostat::pi;

TEMPLATE_TEST_CASE("complete integrals and means against the table", "[math]", float, double, long double) {
  table::Worst worst({"K", "E", "F", "W", "V"});
  int rows = 0;
  for (const auto& row : table::read("complete")) {
    if (!row.fits<TestType>()) continue;
    ++rows;
    const auto m = row.modulus<TestType>();
    const auto integral = complete(m);
    const auto mean = means(m);
    const TestType got[] = {integral.K, integral.E, mean.F, mean.W, mean.V};
    for (std::size_t i = 0; i < 5; ++i) {
      INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2") << " column " << i);
      const double error = table::ulps(got[i], row.value[i]);
      CHECK(error < (sizeof(TestType) == 4 ? 1.1 : sizeof(TestType) == 8 ? 4.0 : 12.0));
      worst.see(i, error);
    }
    CHECK(mean.K == integral.K);
  }
  CHECK(rows > 30);
  CHECK(worst.of(0) < (sizeof(TestType) == 4 ? 0.8 : sizeof(TestType) == 8 ? 2.5 : 3.0));  // K
  CHECK(worst.of(1) < (sizeof(TestType) == 4 ? 0.8 : sizeof(TestType) == 8 ? 2.5 : 8.0));  // E
  SUCCEED("ulp: " << worst.text());
  CHECK(worst.of(0) > 0);  // the table is not the function itself
}

TEST_CASE("the means by the nome agree with the fitted ones", "[math]") {
  for (const auto& row : table::read("complete")) {
    const auto m = row.modulus<double>();
    const auto nome = gyrostat::math::detail::means_by_nome(m);
    const auto fitted = means(m);
    INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2"));
    CHECK(table::ulps(nome.K, row.value[0]) < 3);
    CHECK(nome.F == Approx(fitted.F).epsilon(2e-15));
    CHECK(nome.W == Approx(fitted.W).epsilon(2e-15).margin(0));
    CHECK(nome.V == Approx(fitted.V).epsilon(2e-15).margin(0));
  }
}

TEMPLATE_TEST_CASE("complete integrals at the ends and outside", "[math]", float, double, long double) {
  using S = TestType;
  const S eps = gyrostat::epsilon<S>;
  const auto circle = complete(Modulus<S>{0, 1});
  CHECK(std::abs(circle.K - pi<S> / 2) <= 2 * eps);
  CHECK(std::abs(circle.E - pi<S> / 2) <= 2 * eps);
  const auto still = means(Modulus<S>{0, 1});
  CHECK(std::abs(still.F - 1) <= eps);
  CHECK(still.W == 0);
  CHECK(still.V == 0);

  const auto separatrix = complete(Modulus<S>{1, 0});
  CHECK(separatrix.K == infinity<S>);
  CHECK(separatrix.E == 1);
  const auto mean = means(Modulus<S>{1, 0});
  CHECK(mean.K == infinity<S>);
  CHECK(mean.F == 0);
  CHECK(mean.W == 1);
  CHECK(mean.V == 0);

  const S bad[] = {gyrostat::nan<S>, S(-0.1), S(1.5), infinity<S>, -infinity<S>};
  for (S x : bad) {
    for (const Modulus<S> m : {Modulus<S>{x, S(0.5)}, Modulus<S>{S(0.5), x}}) {
      CHECK(std::isnan(complete(m).K));
      CHECK(std::isnan(complete(m).E));
      CHECK(std::isnan(means(m).K));
      CHECK(std::isnan(means(m).F));
      CHECK(std::isnan(means(m).W));
      CHECK(std::isnan(means(m).V));
    }
  }
}

TEST_CASE("subnormal complements", "[math]") {
  // K = ln 4 - ln(kp2)/2 to rounding
  for (double kp2 : {1e-305, 2.5e-308, 1e-308, 1e-315, 5e-324}) {
    const auto m = Modulus<double>::from_kp2(kp2);
    CHECK(complete(m).K == Approx(std::log(4.0) - std::log(kp2) / 2).epsilon(1e-15));
    CHECK(complete(m).E == 1);
    CHECK(complete(m.complement()).K == Approx(pi<double> / 2).epsilon(1e-15));
    CHECK(means(m.complement()).W == Approx(kp2 / 2).epsilon(1e-15).margin(5e-324));
  }
}

TEMPLATE_TEST_CASE("Legendre's relation and the sums of the means", "[math]", float, double, long double) {
  using S = TestType;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-30, 0);
  for (int i = 0; i < 300; ++i) {
    const S small = S(std::pow(10.0, exponent(random))) / 2;
    auto m = Modulus<S>::from_k2(small);
    if (i % 2) m = m.complement();
    const auto a = complete(m);
    const auto b = complete(m.complement());
    const S eps = gyrostat::epsilon<S>;
    // the cancelling form E K' + E' K - K K' loses K K' eps
    CHECK(std::abs(a.E * b.K + b.E * a.K - a.K * b.K - pi<S> / 2) <= 8 * eps * a.K * b.K);
    const auto mean = means(m);
    CHECK(std::abs(mean.F + mean.W - 1) <= 4 * eps);
    CHECK(std::abs(mean.W + mean.V - m.k2) <= 6 * eps * m.k2);
    CHECK(std::abs(mean.V + m.kp2 - mean.F) <= 6 * eps * mean.F);
  }
}

TEST_CASE("the loop over arrays gives the numbers of the single call", "[math]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-308, 0);
  std::vector<double> k2, kp2;
  for (int i = 0; i < 1003; ++i) {
    auto m = Modulus<double>::from_k2(std::pow(10.0, exponent(random)));
    if (i % 2) m = m.complement();
    k2.push_back(m.k2);
    kp2.push_back(m.kp2);
  }
  for (double x : {0.0, 1.0, gyrostat::nan<double>, -1.0, 2.0, infinity<double>}) {
    k2.push_back(x);
    kp2.push_back(1 - x);
  }
  std::vector<double> K(k2.size()), E(k2.size());
  complete(k2.data(), kp2.data(), K.data(), E.data(), k2.size());
  for (std::size_t i = 0; i < k2.size(); ++i) {
    const auto one = complete(Modulus<double>{k2[i], kp2[i]});
    INFO(k2[i] << ' ' << kp2[i]);
    CHECK(std::isnan(K[i]) == std::isnan(one.K));
    if (std::isnan(one.K)) continue;
    // the same operations, fused or not
    CHECK((K[i] == one.K || std::abs(K[i] - one.K) <= 4e-16 * one.K));
    CHECK(std::abs(E[i] - one.E) <= 4e-16 * one.E);
  }
}
