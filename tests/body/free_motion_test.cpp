// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/body/free_motion.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"

using namespace gyrostat;

namespace {

/// Moments C < B < A of random bodies, and M.
struct Sample {
  long double a[3];  // 1/A, 1/B, 1/C
  long double m[3];  // squares of M along these axes
};

Sample sample(std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0.1, 3), component(-1, 1);
  long double x[3] = {part(random), part(random), part(random)};
  std::sort(x, x + 3);
  Sample s{{1 / (x[1] + x[2]), 1 / (x[0] + x[2]), 1 / (x[0] + x[1])}, {}};
  for (auto& m : s.m) m = std::pow(static_cast<long double>(component(random)), 2);
  return s;
}

template <Real S>
PolhodeGaps<S> gaps_of(const long double* a, int near) {
  const int far = 2 - near;
  return {S(std::abs(a[1] - a[near])), S(std::abs(a[far] - a[1])), S(std::abs(a[far] - a[near]))};
}

}  // namespace

TEST_CASE("tilt and modulus are those of energy and momentum, and the regime is that with kp2 >= 0") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    const auto [a, m] = sample(random);
    const bool largest = surrounds_largest(a[1] - a[0], a[2] - a[1], m[0], m[2]);
    const int near = largest ? 0 : 2, far = 2 - near;
    const auto gaps = gaps_of<long double>(a, near);
    const auto shape = PolhodeShape<long double>::of(gaps, m[near], m[1], m[far]);
    const long double square = m[0] + m[1] + m[2], ratio = (a[0] * m[0] + a[1] * m[1] + a[2] * m[2]) / square;
    CHECK(double(shape.tilt) == Approx(double((ratio - a[near]) / (a[far] - a[near]))).epsilon(1e-12));
    CHECK(double(shape.tilt + shape.along) == Approx(1).epsilon(1e-15));
    CHECK(double(shape.modulus.k2 + shape.modulus.kp2) == Approx(1).epsilon(1e-15));
    CHECK(double(shape.modulus.k2) ==
          Approx(double(gaps.mid_far * shape.tilt / (gaps.near_mid * shape.along))).epsilon(1e-14));
    CHECK(shape.modulus.kp2 >= 0);
    CHECK(shape.tilt <= gaps.separatrix_tilt());
    const auto other = PolhodeShape<long double>::of(gaps_of<long double>(a, far), m[far], m[1], m[near]);
    CHECK(other.modulus.kp2 <= 0);
    CHECK(other.sensitivity == infinity<long double>);
    // on small oscillations about the near axis: the rate of Euler's equations
    const auto small = PolhodeShape<long double>::of(gaps, 1, 1e-12L * m[1], 1e-12L * m[far]);
    CHECK(double(rate_per_momentum(gaps, small.along)) ==
          Approx(double(std::sqrt(gaps.near_mid * gaps.near_far))).epsilon(1e-10));
  }
}

TEST_CASE("each number has its own relative accuracy, by every component of M") {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> exponent(-12, 0);
  for (int i = 0; i < 500; ++i) {
    auto [a, m] = sample(random);
    for (auto& x : m) x *= std::pow(10.0L, static_cast<long double>(exponent(random)));
    const auto gaps = gaps_of<float>(a, 0);
    const PolhodeGaps<long double> same{gaps.near_mid, gaps.mid_far, gaps.near_far};
    const float near = float(m[0]), mid = float(m[1]), far = float(m[2]);
    const auto rounded = PolhodeShape<float>::of(gaps, near, mid, far);
    const auto truth = PolhodeShape<long double>::of(same, near, mid, far);
    const auto off = [](float x, long double y) { return double(std::abs(x / y - 1)); };
    CHECK(off(rounded.tilt, truth.tilt) < 8 * epsilon<float>);
    CHECK(off(rounded.along, truth.along) < 8 * epsilon<float>);
    CHECK(off(rounded.modulus.k2, truth.modulus.k2) < 8 * epsilon<float>);
    if (truth.sensitivity < 1000)
      CHECK(off(rounded.modulus.kp2, truth.modulus.kp2) < 8 * epsilon<float> * double(truth.sensitivity));
  }
}

TEST_CASE("an axis of symmetry, a sphere, and M across the axis") {
  const PolhodeGaps<double> symmetric{0.25, 0, 0.25};
  CHECK(symmetric.axisymmetric());
  const auto shape = PolhodeShape<double>::of(symmetric, 3, 1, 1);
  CHECK(shape.modulus.k2 == 0);
  CHECK(shape.modulus.kp2 == 1);
  CHECK(shape.tilt == Approx(0.4));
  CHECK(std::isnan(PolhodeShape<double>::of(symmetric, 0, 1, 1).modulus.k2));
  CHECK(std::isnan(PolhodeShape<double>::of({0, 0, 0}, 3, 1, 1).modulus.k2));
  CHECK(PolhodeGaps<double>{0.1, 0.3, 0.4}.separatrix_tilt() == Approx(0.25));
}

TEST_CASE("rounding does not put the modulus out of [0, 1]") {
  std::mt19937_64 random(5);
  int over = 0;
  for (int i = 0; i < 2000; ++i) {
    const Sample body = sample(random);
    for (const int near : {0, 2}) {
      const auto gaps = gaps_of<double>(body.a, near);
      const double square = std::uniform_real_distribution<double>(0.1, 10)(random);
      over += gaps.near_far * (gaps.near_mid * square) / (gaps.near_mid * (gaps.near_far * square)) > 1;
      const auto on_axis = PolhodeShape<double>::of(gaps, square, 0, 0);
      CHECK(on_axis.modulus.k2 == 0);
      CHECK(on_axis.modulus.kp2 <= 1);
      CHECK(on_axis.modulus.kp2 == Approx(1).epsilon(1e-15));
      CHECK(on_axis.along == 1);
      // on the separatrix, to rounding
      const auto edge = PolhodeShape<double>::of(gaps, square * gaps.mid_far, 0, square * gaps.near_mid);
      CHECK(edge.modulus.k2 <= 1);
    }
  }
  CHECK(over > 100);
}
