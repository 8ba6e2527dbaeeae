// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/math/periodic.hpp"

#include <array>
#include <cmath>

#include "catch.hpp"
#include "gyrostat/math/elliptic.hpp"

using namespace gyrostat::math;

namespace {

template <class Scalar>
struct PeriodicMean {
  Scalar value, error;
  int nodes;
  bool converged;
};

/// periodic_means() of one function.
template <class Scalar, class Function>
PeriodicMean<Scalar> periodic_mean(const Function& f, Scalar tolerance, int first = 16, int most = 4096) {
  const auto means =
      periodic_means<Scalar, 1>([&](Scalar x) { return std::array<Scalar, 1>{f(x)}; }, tolerance, first, most);
  return {means.value[0], means.error[0], means.nodes, means.converged};
}

}  // namespace

TEMPLATE_TEST_CASE("a periodic mean converges exponentially", "[math]", float, double, long double) {
  using S = TestType;
  const auto f = [](S x) { return 1 / (S(1.1) + std::cos(2 * gyrostat::pi<S> * x)); };
  const auto mean = periodic_mean<S>(f, 8 * gyrostat::epsilon<S>);
  CHECK(mean.converged);
  CHECK(std::abs(mean.value - 1 / std::sqrt(S(1.1) * S(1.1) - 1)) <= 100 * gyrostat::epsilon<S>);
  CHECK(mean.nodes <= 512);
  // each doubling squares the error
  double before = 0;
  for (int nodes : {16, 32, 64}) {
    const auto rule = periodic_mean<double>([](double x) { return 1 / (1.1 + std::cos(2 * gyrostat::pi<double> * x)); },
                                            0.0, nodes / 2, nodes);
    const double error = std::abs(rule.value - 1 / std::sqrt(1.1 * 1.1 - 1));
    CHECK_FALSE(rule.converged);
    CHECK(rule.nodes == nodes);
    CHECK(rule.error >= error);
    if (before > 0) CHECK(error < before * before);
    before = error;
  }
}

TEST_CASE("means of Jacobi's functions over an orbit", "[math]") {
  for (double k2 : {1e-8, 0.3, 0.9, 1 - 1e-6}) {
    const auto m = Modulus<double>::from_k2(k2);
    const JacobiAt<double> at(m);
    const auto rule = periodic_means<double, 3>(
        [&](double x) {
          const auto f = at(4 * at.quarter_period() * x);
          return std::array<double, 3>{m.k2 * f.sn * f.sn, m.k2 * f.cn * f.cn, f.dn * f.dn};
        },
        1e-14);
    const auto mean = means(m);
    CHECK(rule.converged);
    CHECK(rule.value[0] == Approx(mean.W).epsilon(1e-13));
    CHECK(rule.value[1] == Approx(mean.V).epsilon(1e-13));
    CHECK(rule.value[2] == Approx(mean.F).epsilon(1e-13));
  }
}

TEST_CASE("a mean that does not converge says so", "[math]") {
  int calls = 0;
  const auto rough = periodic_mean<double>(
      [&](double x) {
        ++calls;
        return std::sqrt(x);
      },
      1e-14, 16, 1024);
  CHECK_FALSE(rough.converged);
  CHECK(rough.nodes == 1024);
  CHECK(calls == 1024);
  CHECK(rough.error > 1e-6);
  calls = 0;
  const auto bad = periodic_mean<double>(
      [&](double x) {
        ++calls;
        return x > 0.5 ? gyrostat::nan<double> : x;
      },
      1e-14);
  CHECK_FALSE(bad.converged);
  CHECK(std::isnan(bad.value));
  CHECK(calls == 32);
  // zero is a mean like any other
  const auto zero = periodic_mean<double>([](double) { return 0.0; }, 1e-14);
  CHECK(zero.converged);
  CHECK(zero.value == 0);
}

TEST_CASE("a mean of thousands of numbers that are nearly alike loses no digits", "[math]") {
  constexpr double below = 1 - 0x1p-42;
  // no two rules agree; in a plain sum each of these numbers would be 1 from some thousands on
  const auto mean = periodic_mean<double>([](double x) { return x == 0 ? below + 0x1p-10 : below; }, 0, 16, 1 << 14);
  CHECK(mean.nodes == 1 << 14);
  CHECK(std::abs(mean.value - (below + 0x1p-24)) <= gyrostat::epsilon<double>);
}
