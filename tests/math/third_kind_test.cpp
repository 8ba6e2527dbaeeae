// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/third_kind.hpp"

#include <cmath>

#include "catch.hpp"
#include "gyrostat/math/incomplete.hpp"

using namespace gyrostat;
using namespace gyrostat::math;

TEST_CASE("third kind: the incomplete integral Pi over many turns", "[math]") {
  using S = long double;
  double worst = 0;
  for (const S k2 : {0.0L, 1e-6L, 0.3L, 0.7L, 0.999L, 1 - 1e-9L})
    for (const S n : {0.0L, 0.2L, 0.9L, 0.99999L}) {
      const auto m = Modulus<S>::from_k2(k2);
      const JacobiAt<S> functions(m);
      const ThirdKind<S> rest(m, 1 - n);
      for (S phi = -7; phi < 40; phi += 0.73L) {
        const S u = incomplete_F(phi, m);
        const S want = incomplete_Pi(phi, n, m);
        const S got = u + n * rest(JacobiTurn<S>::of(functions, u));
        worst = std::max(worst, double(std::abs(got - want) / (1 + std::abs(want))));
      }
    }
  CHECK(worst < 1e-13);  // the argument as a function of the amplitude is stiff near k = 1
}

TEST_CASE("third kind: shifted by a quarter period", "[math]") {
  using S = double;
  for (const S kp2 : {1.0, 0.5, 1e-3, 1e-12, 1e-40}) {
    const auto m = Modulus<S>::from_kp2(kp2);
    const JacobiAt<S> functions(m);
    const S K = functions.quarter_period();
    for (S u = -5.3 * K; u < 6 * K; u += 0.37 * K) {
      const auto here = JacobiTurn<S>::of(functions, u), at = here.minus_quarter(m, K),
                 beyond = here.plus_quarter(m, K);
      CHECK(2 * K * at.turns + at.rest == Approx(u - K).margin(1e-12 * K));
      CHECK(2 * K * beyond.turns + beyond.rest == Approx(u + K).margin(1e-12 * K));
      CHECK(std::abs(at.rest) <= K * (1 + 1e-15));
      const auto want = functions(at.rest);
      CHECK(at.sn == Approx(want.sn).epsilon(1e-12).margin(1e-13));
      CHECK(at.cn == Approx(want.cn).epsilon(1e-10).margin(1e-14));
      CHECK(at.dn == Approx(want.dn).epsilon(1e-10));
    }
  }
}

TEST_CASE("third kind: the argument from Jacobi's functions, also next to the separatrix", "[math]") {
  for (const double kp2 : {1.0, 0.3, 1e-10, 1e-40}) {
    const JacobiAt<double> functions(Modulus<double>::from_kp2(kp2));
    const double K = functions.quarter_period();
    for (double share = -1; share <= 1; share += 0.0625) {
      const auto j = functions(share * K);
      CHECK(jacobi_argument(j.sn, std::max(j.cn, 0.0), j.dn) == Approx(share * K).epsilon(1e-14).margin(1e-300));
    }
  }
}

TEST_CASE("third kind: relative accuracy where n and k approach one", "[math]") {
  // int sn^2/(1 - n sn^2): the error of double against long double
  double worst = 0;
  for (const double kp2 : {0.4, 1e-8, 1e-30})
    for (const double complement : {0.5, 1e-10, 1e-30}) {
      const auto m = Modulus<double>::from_kp2(kp2);
      const Modulus<long double> wide{1 - static_cast<long double>(kp2), kp2};
      const JacobiAt<double> functions(m);
      const JacobiAt<long double> exact(wide);
      const ThirdKind<double> integral(m, complement);
      const ThirdKind<long double> truth(wide, complement);
      for (double share = 0.05; share < 1; share += 0.09) {
        const double u = share * functions.quarter_period();
        const auto got = integral(JacobiTurn<double>::of(functions, u));
        const auto want = truth(JacobiTurn<long double>::of(exact, u));
        worst = std::max(worst, double(std::abs(got - want) / want));
      }
    }
  CHECK(worst < 3e-14);
}
