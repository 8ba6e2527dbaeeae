// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/many.hpp"

#include <cmath>
#include <limits>
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

TEST_CASE("inverse square roots side by side") {
  double off = 0;
  for_draws(
      4, [](auto& e) { return std::pow(10, between(e, -290, 290)); },
      [&](const double* x, const double*) {
        const Many root = math::inverse_sqrt(Many::from(x));
        for (int i = 0; i < Many::size; ++i) off = std::max(off, std::abs(root[i] * std::sqrt(x[i]) - 1));
      });
  CHECK(off < 3 * epsilon<double>);
}

TEST_CASE("elliptic integrals side by side") {
  double off[4] = {0, 0, 0, 0};
  for_draws(
      3, [](auto& e) { return std::pow(10, between(e, -18, 6)); },
      [&](const double* x, const double* y) {
        double k2[8], kp2[8];
        for (int i = 0; i < 8; ++i) {
          const double small = std::max(std::min(x[i], 1 / x[i]), 1e-16);
          k2[i] = i % 2 ? 1 - small : small, kp2[i] = i % 2 ? small : 1 - small;
        }
        const auto got = math::first_kind(Many::from(k2), Many::from(kp2), Many::from(y), Many::from(x));
        for (int i = 0; i < Many::size; ++i) {
          const double K = math::complete(math::Modulus<double>::from_kp2(kp2[i])).K,
                       Kp = math::complete(math::Modulus<double>::from_kp2(k2[i])).K;
          // amplitude phi of cotangent c: F = R_F(c^2, c^2 + k'^2, c^2 + 1)
          const auto F = [](double c, double complement) {
            const double z = 1 + c * c;
            return math::carlson_RF<double>(c * c / z, (c * c + complement) / z, 1) / std::sqrt(z);
          };
          off[0] = std::max(off[0], std::abs(got.K[i] / K - 1));
          off[1] = std::max(off[1], std::abs(got.Kp[i] / Kp - 1));
          off[2] = std::max(off[2], std::abs(got.F_part[i] * 4 * K / F(y[i], kp2[i]) - 1));
          off[3] = std::max(off[3], std::abs(got.Fp[i] / F(x[i], k2[i]) - 1));
        }
      });
  for (const double each : off) CHECK(each < 8 * epsilon<double>);
}

TEST_CASE("amplitudes of a quarter and of nothing side by side") {
  double zero[8], infinite[8], half[8];
  for (int i = 0; i < 8; ++i)
    zero[i] = i % 2 ? -0. : 0., infinite[i] = std::numeric_limits<double>::infinity(), half[i] = .5;
  const Many m = Many::from(half);
  const auto whole = math::first_kind(m, m, Many::from(zero), Many::from(zero));
  const auto none = math::first_kind(m, m, Many::from(infinite), Many::from(infinite));
  for (int i = 0; i < Many::size; ++i) {
    CHECK(whole.F_part[i] == Approx(.25).epsilon(1e-15));
    CHECK(whole.Fp[i] == Approx(whole.Kp[i]).epsilon(1e-15));
    CHECK((none.F_part[i] == 0 && none.Fp[i] == 0));
  }
}

}  // namespace many_test
