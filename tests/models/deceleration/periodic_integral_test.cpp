// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/models/deceleration/periodic_integral.hpp"

#include <cmath>

#include "catch.hpp"

using gyrostat::pi;
using Pair = gyrostat::deceleration::PeriodicPair<double>;

namespace {
double f(double x) { return std::exp(std::sin(2 * pi<double> * x)); }
double g(double x) {
  return std::sin(2 * pi<double> * x) * std::exp(std::sin(2 * pi<double> * x)) * std::cos(2 * pi<double> * x);
}
}  // namespace

TEST_CASE("a periodic pair knows its means, its values and its integrals", "[deceleration]") {
  const int n = GENERATE(32, 64, 256);
  const Pair::Roots roots(n);
  double first[256], second[256];
  for (int i = 0; i < n; ++i) {
    first[i] = f(double(i) / n);
    second[i] = g(double(i) / n);
  }
  const Pair pair(roots, first, second);
  CHECK(pair.mean().first == Approx(1.2660658777520084).epsilon(1e-14));  // Bessel I0(1)
  CHECK(std::abs(pair.mean().second) < 1e-15);
  for (const double x : {0., .13, .5, .77}) {
    CHECK(pair.at(x).first == Approx(f(x)).epsilon(1e-13));
    CHECK(pair.at(x).second == Approx(g(x)).margin(1e-13));
    CHECK(pair.times(-2).at(x).first == Approx(-2 * f(x)).epsilon(1e-13));
  }

  const Pair integral = pair.integral();
  CHECK(integral.mean().first == 0);
  CHECK(integral.mean().second == 0);
  double a[256], b[256];
  integral.sample(roots, a, b);
  for (int i = 0; i < n; i += 5) {
    const double x = double(i) / n, h = 1e-4;
    CHECK(a[i] == Approx(integral.at(x).first).margin(1e-14));
    CHECK(b[i] == Approx(integral.at(x).second).margin(1e-14));
    CHECK((integral.at(x + h).first - integral.at(x - h).first) / (2 * h) ==
          Approx(f(x) - pair.mean().first).margin(1e-5));
    CHECK((integral.at(x + h).second - integral.at(x - h).second) / (2 * h) == Approx(g(x)).margin(1e-5));
  }
}

TEST_CASE("an empty periodic pair is zero", "[deceleration]") {
  CHECK(Pair().at(.3).first == 0);
  CHECK(Pair().times(2).at(.3).second == 0);
}
