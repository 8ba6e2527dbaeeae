// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/jacobi.hpp"

#include <random>

#include "gyrostat/math/complete.hpp"
#include "table.hpp"

using namespace gyrostat::math;
using gyrostat::epsilon;

TEMPLATE_TEST_CASE("Jacobi's functions and zeta against the table", "[math]", float, double, long double) {
  // columns: u, sn, cn, dn, am, zeta. Forgiven is the error that a relative error of one eps in u makes.
  table::Worst worst({"sn", "cn", "dn", "am", "zeta"});
  int rows = 0;
  for (const auto& row : table::read("functions")) {
    if (!row.fits<TestType>()) continue;
    ++rows;
    const auto m = row.modulus<TestType>();
    const auto u = static_cast<TestType>(row.value[0]);
    const auto f = jacobi(u, m);
    const TestType got[] = {f.sn, f.cn, f.dn, f.am, zeta(u, m)};
    const long double sn = row.value[1], cn = row.value[2], dn = row.value[3];
    const long double slope[] = {cn * dn, sn * dn, static_cast<long double>(m.k2) * sn * cn, dn,
                                 static_cast<long double>(m.k2) * cn * cn - static_cast<long double>(means(m).V)};
    for (std::size_t i = 0; i < 5; ++i) {
      const long double slack = std::abs(slope[i] * row.value[0]) * static_cast<long double>(epsilon<TestType>);
      const double error = table::ulps(got[i], row.value[i + 1], slack);
      INFO("small " << static_cast<double>(row.small) << (row.of_k2 ? " k2" : " kp2") << " u "
                    << static_cast<double>(row.value[0]) << " column " << i << " got " << static_cast<double>(got[i])
                    << " for " << static_cast<double>(row.value[i + 1]));
      CHECK(error < (sizeof(TestType) == 4 ? 1.0 : sizeof(TestType) == 8 ? 8.0 : 12.0));
      worst.see(i, error);
    }
  }
  CHECK(rows > 150);
  SUCCEED(worst.text());
  CHECK(worst.of(0) < 6);
}

TEMPLATE_TEST_CASE("laws of Jacobi's functions", "[math]", float, double, long double) {
  using S = TestType;
  const S eps = epsilon<S>;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-20, 0), argument(-1, 1);
  for (int i = 0; i < 400; ++i) {
    auto m = Modulus<S>::from_k2(S(std::pow(10.0, exponent(random))) / 2);
    if (i % 2) m = m.complement();
    const S K = complete(m).K;
    const S u = S(argument(random)) * K;
    const S v = S(argument(random)) * K;
    const auto a = jacobi(u, m);
    const auto b = jacobi(v, m);
    CHECK(std::abs(a.sn * a.sn + a.cn * a.cn - 1) <= 12 * eps);
    // dn^2 = cn^2 + kp2 sn^2, all positive
    CHECK(std::abs(a.dn * a.dn - a.cn * a.cn - m.kp2 * a.sn * a.sn) <= 16 * eps * a.dn * a.dn);
    CHECK(std::abs(std::sin(a.am) - a.sn) <= 8 * eps);
    CHECK(std::abs(std::cos(a.am) - a.cn) <= 8 * eps);
    // addition, DLMF 22.8.1 and the zeta function's, 22.16.35
    const auto c = jacobi(u + v, m);
    const S below = 1 - m.k2 * a.sn * a.sn * b.sn * b.sn;
    CHECK(std::abs(c.sn * below - (a.sn * b.cn * b.dn + b.sn * a.cn * a.dn)) <= 40 * eps * std::max(S(1), K));
    CHECK(std::abs(zeta(u + v, m) - zeta(u, m) - zeta(v, m) + m.k2 * a.sn * b.sn * c.sn) <=
          40 * eps * std::max(S(1), K));
    // symmetry and period
    const auto r = jacobi(-u, m);
    CHECK(r.sn == -a.sn);
    CHECK(r.cn == a.cn);
    CHECK(r.dn == a.dn);
    CHECK(r.am == -a.am);
    CHECK(zeta(-u, m) == -zeta(u, m));
    CHECK(std::abs(zeta(u + 2 * K, m) - zeta(u, m)) <= 20 * eps * std::max(S(1), K));
  }
}

TEST_CASE("derivatives of Jacobi's functions", "[math]") {
  for (double k2 : {1e-6, 0.1, 0.49, 0.51, 0.9, 1 - 1e-6}) {
    const JacobiAt<double> at(Modulus<double>::from_k2(k2));
    const double F = means(at.modulus()).F;
    const double h = 1e-5;
    for (double u = -3.3; u < 4; u += 0.37) {
      const auto a = at(u - h), b = at(u + h), f = at(u);
      CHECK((b.sn - a.sn) / (2 * h) == Approx(f.cn * f.dn).margin(1e-9));
      CHECK((b.cn - a.cn) / (2 * h) == Approx(-f.sn * f.dn).margin(1e-9));
      CHECK((b.dn - a.dn) / (2 * h) == Approx(-k2 * f.sn * f.cn).margin(1e-9));
      CHECK((b.am - a.am) / (2 * h) == Approx(f.dn).margin(1e-9));
      CHECK((at.zeta(u + h) - at.zeta(u - h)) / (2 * h) == Approx(f.dn * f.dn - F).margin(1e-9));
    }
  }
}

TEMPLATE_TEST_CASE("Jacobi's functions at the ends and outside", "[math]", float, double, long double) {
  using S = TestType;
  const S eps = epsilon<S>;
  for (S u : {S(0), S(0.3), S(-1.7), S(4), S(100), S(-1000)}) {
    const auto circle = jacobi(u, Modulus<S>{0, 1});
    const S slack = 3 * eps * (1 + std::abs(u));
    CHECK(std::abs(circle.sn - std::sin(u)) <= slack);
    CHECK(std::abs(circle.cn - std::cos(u)) <= slack);
    CHECK(circle.dn == 1);
    CHECK(std::abs(circle.am - u) <= slack);
    CHECK(zeta(u, Modulus<S>{0, 1}) == 0);
    const auto separatrix = jacobi(u, Modulus<S>{1, 0});
    CHECK(std::abs(separatrix.sn - std::tanh(u)) <= 2 * eps);
    CHECK(std::abs(separatrix.cn - 1 / std::cosh(u)) <= slack * separatrix.cn + 2 * std::numeric_limits<S>::min());
    CHECK(separatrix.dn == separatrix.cn);
    CHECK(std::abs(zeta(u, Modulus<S>{1, 0}) - std::tanh(u)) <= 2 * eps);
  }
  const S bad = gyrostat::nan<S>, endless = gyrostat::infinity<S>;
  const Modulus<S> half{S(0.5), S(0.5)};
  for (const auto& f :
       {jacobi(bad, half), jacobi(endless, half), jacobi(-endless, half), jacobi(S(1), {bad, S(0.5)}),
        jacobi(S(1), {S(0.5), bad}), jacobi(S(1), {S(1.5), S(-0.5)}), jacobi(S(1), {S(-0.5), S(1.5)})}) {
    CHECK(std::isnan(f.sn));
    CHECK(std::isnan(f.cn));
    CHECK(std::isnan(f.dn));
    CHECK(std::isnan(f.am));
  }
  CHECK(std::isnan(zeta(bad, half)));
  CHECK(std::isnan(zeta(endless, half)));
  CHECK(std::isnan(zeta(S(1), {S(1.5), S(-0.5)})));
  const auto far = jacobi(std::numeric_limits<S>::max(), half);
  CHECK((std::isnan(far.sn) || std::abs(far.sn) <= 1 + eps));
}

TEST_CASE("zeta does not grow with its argument", "[math]") {
  const JacobiAt<double> at(Modulus<double>::from_k2(0.8));
  double most = 0;
  for (int i = 0; i < 2000; ++i) most = std::max(most, std::abs(at.zeta(i * 1e6 / 7)));
  CHECK(most < 0.35);
  CHECK(most > 0.2);
}
