// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/gsl.hpp"

#include "table.hpp"

using namespace gyrostat::math;

TEST_CASE("GSL's complete integrals against the table", "[math]") {
  table::Worst worst({"K", "E", "F", "W", "V"});
  for (const auto& row : table::read("complete")) {
    const auto m = row.modulus<double>();
    const auto integral = Gsl::complete(m);
    const auto mean = Gsl::means(m);
    const double got[] = {integral.K, integral.E, mean.F, mean.W, mean.V};
    for (std::size_t i = 0; i < 5; ++i) {
      INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2") << " column " << i);
      const double error = table::ulps(got[i], row.value[i]);
      CHECK(error < 8);
      worst.see(i, error);
    }
  }
  CHECK(worst.of(0) < 4);
}

TEST_CASE("GSL's functions and the native ones are the same", "[math]") {
  for (const auto& row : table::read("functions")) {
    const auto m = row.modulus<double>();
    const double u = static_cast<double>(row.value[0]);
    // gsl_sf_elljac_e sees k2 alone: near k2 = 1 it answers for the rounded one
    const double slack =
        4e-15 * (1 + std::abs(u)) + (row.of_k2 ? 0.0 : 4e-16 * std::exp(std::min(2 * complete(m).K, 30.0)));
    INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2") << " u " << u);
    const auto a = Gsl::jacobi(u, m);
    const auto b = Native::jacobi(u, m);
    CHECK(a.sn == Approx(b.sn).margin(slack));
    CHECK(a.cn == Approx(b.cn).margin(slack));
    CHECK(a.dn == Approx(b.dn).margin(slack));
    CHECK(Gsl::zeta(u, m) == Approx(Native::zeta(u, m)).margin(slack));
  }
  for (const auto& row : table::read("incomplete")) {
    const auto m = row.modulus<double>();
    const double phi = static_cast<double>(row.value[0]), n = static_cast<double>(row.value[1]);
    INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2") << " phi " << phi << " n " << n);
    CHECK(Gsl::incomplete_F(phi, m) == Approx(Native::incomplete_F(phi, m)).epsilon(4e-15));
    CHECK(Gsl::incomplete_E(phi, m) == Approx(Native::incomplete_E(phi, m)).epsilon(4e-15));
    const double third = Gsl::incomplete_Pi(phi, n, m);
    if (std::isnan(third)) {
      CHECK(row.small < 1e-100L);  // where GSL's R_J ends
    } else {
      CHECK(third == Approx(Native::incomplete_Pi(phi, n, m)).epsilon(n < -100 ? 1e-13 : 1e-14));
    }
  }
}

TEST_CASE("GSL is never called outside its domain", "[math]") {
  const double bad = gyrostat::nan<double>, endless = gyrostat::infinity<double>;
  for (double x : {bad, endless, -endless, -0.5, 1.5, -1e-320}) {
    for (const Modulus<double> m : {Modulus<double>{x, 0.5}, Modulus<double>{0.5, x}}) {
      CHECK(std::isnan(Gsl::complete(m).K));
      CHECK(std::isnan(Gsl::means(m).V));
      CHECK(std::isnan(Gsl::jacobi(1, m).sn));
      CHECK(std::isnan(Gsl::zeta(1, m)));
      CHECK(std::isnan(Gsl::incomplete_F(1, m)));
      CHECK(std::isnan(Gsl::incomplete_E(1, m)));
      CHECK(std::isnan(Gsl::incomplete_Pi(1, 0.1, m)));
    }
  }
  const Modulus<double> half{0.5, 0.5};
  for (double x : {bad, endless, -endless}) {
    CHECK(std::isnan(Gsl::jacobi(x, half).sn));
    CHECK(std::isnan(Gsl::zeta(x, half)));
    CHECK(std::isnan(Gsl::incomplete_F(x, half)));
    CHECK(std::isnan(Gsl::incomplete_E(x, half)));
    CHECK(std::isnan(Gsl::incomplete_Pi(x, 0.1, half)));
    CHECK(std::isnan(Gsl::incomplete_Pi(1, x, half)));
  }
  const Modulus<double> separatrix{1, 0};
  CHECK(Gsl::complete(separatrix).K == endless);
  CHECK(Gsl::complete(separatrix).E == 1);
  CHECK(Gsl::means(separatrix).W == 1);
  CHECK(Gsl::jacobi(0.7, separatrix).sn == Approx(std::tanh(0.7)));
  CHECK(Gsl::zeta(0.7, separatrix) == Approx(std::tanh(0.7)));
  CHECK(std::isnan(Gsl::complete({1, 1e-310}).K));  // below the reach of R_F
}
