// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/rotation/quaternion_series.hpp"

#include <cmath>
#include <random>
#include <type_traits>

#include "catch.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace quaternion_series_test {

using namespace gyrostat;

/// Random coefficients; the product by this order after order against the sum of products of quaternions.
template <Real S, int order>
void check_product() {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> number(-1, 1);
  S x[order + 1][12], o[order + 1][4];
  for (auto& row : x)
    for (auto& value : row) value = S(number(random));
  for (auto& row : o)
    for (auto& value : row) value = S(number(random));
  QuaternionSeries<S, order> series;
  const int at = 4;
  const auto check = [&](int k, const Lanes<S>& made) {
    Quat<S> sum{0, 0, 0, 0};
    for (int j = 0; j <= k; ++j) {
      const S* q = &x[k - j][at];
      const Quat<S> term = Quat<S>{q[0], q[1], q[2], q[3]} * Quat<S>{0, o[j][0], o[j][1], o[j][2]};
      sum = {sum.w + term.w, sum.x + term.x, sum.y + term.y, sum.z + term.z};
    }
    CAPTURE(order, k);
    const S wanted[] = {sum.w, sum.x, sum.y, sum.z};
    for (int i = 0; i < 4; ++i) CHECK(std::abs(made[i] - wanted[i]) <= 16 * order * epsilon<S>);
  };
  check(0, series.begin(x, at, load(o[0])));
  count_up<S, order>([&](auto k) { check(k, series.extend(k, x, at, load(o[k]))); });
}

TEST_CASE("the product of a quaternion and a rate, order after order, is the sum of the products", "[rotation]") {
  check_product<double, 20>();
  check_product<double, 7>();
  check_product<long double, 30>();
  check_product<float, 4>();
}

TEST_CASE("q' = q (0, w)/2 with a constant rate is the turn about an axis", "[rotation]") {
  constexpr int order = 24;
  const Vec3<double> half(0.1, -0.2, 0.15);
  double x[order + 1][4] = {{0.5, -0.5, 0.5, 0.5}};
  QuaternionSeries<double, order> series;
  store(x[1], series.begin(x, 0, lanes(half[0], half[1], half[2], 0.)));
  count_up<double, order - 1>(
      [&](auto k) { store(x[k + 1], lanes(1. / (k + 1)) * series.extend(k, x, 0, lanes(0.))); });
  const double angle = half.norm();
  const Vec3<double> axis = half / angle * std::sin(angle);
  const Quat<double> wanted =
      Quat<double>{0.5, -0.5, 0.5, 0.5} * Quat<double>{std::cos(angle), axis[0], axis[1], axis[2]};
  const double right[] = {wanted.w, wanted.x, wanted.y, wanted.z};
  for (int i = 0; i < 4; ++i) {
    double sum = 0;
    for (int k = order; k >= 0; --k) sum += x[k][i];
    CHECK(std::abs(sum - right[i]) < 4e-16);
  }
}

}  // namespace quaternion_series_test
