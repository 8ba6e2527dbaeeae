// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/spinning/linear_functions.hpp"

#include <algorithm>
#include <array>

#include "catch.hpp"

using namespace gyrostat;
using namespace gyrostat::spinning;
using math::Complex;
using math::exp_difference;

namespace {

template <class S>
Problem<S> body(S lambda3, S r0) {
  Problem<S> p;
  p.inertia = {8, 7, 11};
  p.rotor_momentum = lambda3;
  p.angular_velocity = {0, 0, r0};
  return p;
}

}  // namespace

TEST_CASE("the functions of the linear motion are the divided differences named", "[spinning]") {
  using S = long double;
  for (const S lambda3 : {2.0L, -11.0L, 4.0L, -4.0L, -3.6L, 0.0L}) {
    for (const S r0 : {1.0L, -1.0L, 0.0L}) {
      const auto p = body<S>(lambda3, r0);
      const LinearFunctions<S> functions(p);
      const S nu2 = p.nutation_squared(), nu = std::sqrt(std::abs(nu2));
      const Complex<S> inu = nu2 < 0 ? Complex<S>{-nu, 0} : Complex<S>{0, nu}, ir{0, r0}, zero;
      for (const S t : {-0.5L, 0.0L, 1e-3L, 0.7L, 3.0L, 40.0L}) {
        const auto f = functions.at(t, true);
        const S scale = nu2 < 0 ? std::exp(nu * std::abs(t)) : 1;
        const auto check = [&](Complex<S> got, auto nodes, int order) {
          for (auto& z : nodes) z = t * z;
          S power = 1, factorial = 1;
          for (int i = 1; i <= order; ++i) {
            power *= t;
            factorial *= S(i);
          }
          const S error = magnitude(got - power * exp_difference(nodes));
          CHECK(error <=
                (40 + 4 * (std::abs(r0) + nu) * std::abs(t)) * epsilon<S> * scale * std::abs(power) / factorial);
        };
        check({f.S, 0}, std::array{inu, -inu}, 1);
        check({f.V, 0}, std::array{zero, inu, -inu}, 2);
        check(f.E[1], std::array{zero, ir}, 1);
        check(f.E[2], std::array{zero, zero, ir}, 2);
        check(f.E[3], std::array{zero, zero, zero, ir}, 3);
        check(f.J[1], std::array{zero, ir + inu, ir - inu}, 2);
        check(f.J[3], std::array{zero, zero, zero, ir + inu, ir - inu}, 4);
        check(f.K[1], std::array{zero, ir, ir + inu, ir - inu}, 3);
        check(f.K[2], std::array{zero, zero, ir, ir + inu, ir - inu}, 4);
        check(f.K[3], std::array{zero, zero, zero, ir, ir + inu, ir - inu}, 5);
        check(f.H[1], std::array{zero, -ir, inu, -inu}, 3);
        check(f.H[2], std::array{zero, zero, -ir, inu, -inu}, 4);
        check(f.H[3], std::array{zero, zero, zero, -ir, inu, -inu}, 5);
        check(f.spin, std::array{ir}, 0);
      }
    }
  }
}

TEST_CASE("phases keep their digits over many turns", "[spinning]") {
  for (const double r0 : {0.7, -1.3}) {
    const auto p = body<double>(2.1, r0);
    const LinearFunctions<double> functions(p);
    const LinearFunctions<long double> wide(spinning::detail::problem_cast<long double>(p));
    double worst = 0;
    for (int i = 1; i <= 1000; ++i) {
      const double t = 97.7 * i;
      const auto f = functions.at(t, false);
      const auto g = wide.at(t, false);
      const auto nu2 = static_cast<long double>(p.nutation_squared());
      worst = std::max({worst, double(std::sqrt(nu2) * std::abs(f.S - g.S)), double(nu2 * std::abs(f.V - g.V)),
                        double(magnitude(math::complex_cast<long double>(f.spin) - g.spin))});
    }
    CHECK(worst < 2e-15);
  }
}
