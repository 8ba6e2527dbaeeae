// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/many.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "gyrostat/math/carlson.hpp"
#include "gyrostat/math/complete.hpp"

namespace many_test {

using namespace gyrostat;
using math::Many;

/// Calls with numbers[0..size) and the Many of them.
template <class Draw, class Check>
void for_draws(unsigned seed, Draw draw, Check check) {
  std::mt19937_64 engine(seed);
  for (int trip = 0; trip < 2000; ++trip) {
    double x[8], y[8];
    for (int i = 0; i < 8; ++i) x[i] = draw(engine), y[i] = draw(engine);
    check(x, y);
  }
}

double between(std::mt19937_64& engine, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(engine);
}

TEST_CASE("numbers side by side have the arithmetic of one") {
  for_draws(
      1, [](auto& e) { return between(e, .1, 4); },
      [](const double* x, const double* y) {
        const Many a = Many::from(x), b = Many::from(y), nothing = gyrostat::nan<double>;
        const Many quotient = a / b, root = math::sqrt(a), larger = math::max(a, b), smaller = math::min(a, b),
                   size = math::abs(1 - a), whole = math::nearest(a), chosen = math::choose((a < b) & (b < 2.), a, -b);
        const unsigned bits = (a > b).bits();
        for (int i = 0; i < Many::size; ++i) {
          CHECK(quotient[i] == x[i] / y[i]);
          CHECK(std::abs(root[i] / std::sqrt(x[i]) - 1) <= epsilon<double>);
          CHECK(larger[i] == std::max(x[i], y[i]));
          CHECK(smaller[i] == std::min(x[i], y[i]));
          CHECK(size[i] == std::abs(1 - x[i]));
          CHECK(whole[i] == std::nearbyint(x[i]));
          CHECK(chosen[i] == (x[i] < y[i] && y[i] < 2 ? x[i] : -y[i]));
          CHECK((bits >> i & 1) == (x[i] > y[i]));
        }
        CHECK(math::sqrt(Many(0.))[0] == 0);
        CHECK((nothing < a).bits() == 0);
        CHECK((a < nothing).bits() == 0);
      });
}

TEST_CASE("circular and exponential functions side by side") {
  double off[2] = {0, 0};
  for_draws(
      2, [](auto& e) { return between(e, -1.3, 1.3) * (between(e, 0, 1) < .2 ? 1e3 : 1); },
      [&](const double* x, const double* y) {
        const auto at = math::circle(Many::from(x));
        const Many power = math::exp(.5 * Many::from(y));
        for (int i = 0; i < Many::size; ++i) {
          const long double z = 2 * pi<long double> * (x[i] - std::nearbyint(x[i]));
          off[0] = std::max({off[0], std::abs(double(at.c[i] - std::cos(z))), std::abs(double(at.s[i] - std::sin(z)))});
          off[1] = std::max(off[1], std::abs(double(power[i] / std::exp(.5L * y[i]) - 1)));
        }
      });
  CHECK(off[0] < 2 * epsilon<double>);
  CHECK(off[1] < 3 * epsilon<double>);
}

TEST_CASE("elliptic integrals side by side") {
  double off[3] = {0, 0, 0};
  for_draws(
      3, [](auto& e) { return std::pow(10, between(e, -18, 6)); },
      [&](const double* x, const double* y) {
        double k2[8], kp2[8];
        for (int i = 0; i < 8; ++i) {
          kp2[i] = std::max(std::min(x[i], 1 / x[i]), 1e-4);
          k2[i] = i % 2 ? 1 - kp2[i] : std::min(y[i], 1 / y[i]);
          if (i % 2 == 0) kp2[i] = 1 - k2[i];
          kp2[i] = std::max(kp2[i], 1e-4);
        }
        const auto [K, Kp] = math::quarter_periods(Many::from(k2), Many::from(kp2));
        Many a[2] = {Many::from(x), Many::from(y)}, b[2] = {Many::from(y), 1.}, F[2];
        math::carlson_RF(a, b, F);
        for (int i = 0; i < Many::size; ++i) {
          off[0] = std::max(off[0], std::abs(K[i] / math::complete(math::Modulus<double>::from_kp2(kp2[i])).K - 1));
          if (k2[i] > 1e-20)
            off[2] = std::max(off[2], std::abs(Kp[i] / math::complete(math::Modulus<double>::from_kp2(k2[i])).K - 1));
          off[1] = std::max(off[1], std::abs(F[0][i] / math::carlson_RF<double>(x[i], y[i], 1) - 1));
          off[1] = std::max(off[1], std::abs(F[1][i] / math::carlson_RF<double>(y[i], 1, 1) - 1));
        }
      });
  CHECK(off[0] < 8 * epsilon<double>);
  CHECK(off[1] < 8 * epsilon<double>);
  CHECK(off[2] < 8 * epsilon<double>);
}

}  // namespace many_test
