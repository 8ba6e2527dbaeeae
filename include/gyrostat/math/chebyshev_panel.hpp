// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// Running integrals and interpolation over [0, 1] by the polynomial through the Chebyshev points x_k = (1 - cos(pi k/degree))/2.
/// Exact for polynomials up to the degree; the error of a function that turns by an angle a over the panel is about
/// (a/4)^(degree+1)/(degree+1)!.
template <Real Scalar, int degree = 16>
class ChebyshevPanel {
 public:
  static constexpr std::size_t size = degree + 1;
  using Values = std::array<Scalar, size>;

  ChebyshevPanel() noexcept {
    constexpr long double n = degree;
    const auto cosine = [](std::size_t k) noexcept {
      return std::cos(pi<long double> * static_cast<long double>(k % (2 * degree)) / n);
    };
    const auto half_at_ends = [](std::size_t k) noexcept { return k == 0 || k == degree ? 0.5L : 1.0L; };
    for (std::size_t j = 0; j < size; ++j) {
      const long double s = std::sin(pi<long double> * static_cast<long double>(j) / (2 * n));
      node_[j] = static_cast<Scalar>(s * s);
      weight_[j] = static_cast<Scalar>((j % 2 == 0 ? 1 : -1) * half_at_ends(j));
      // l_k(y) = (2/n) sum T_m(y_k) T_m(y), y = 2x - 1 = -cos(pi k/n), the first and last k and m by half
      for (std::size_t k = 0; k < size; ++k) {
        long double sum = 0;
        for (std::size_t m = 0; m < size; ++m)
          sum += half_at_ends(m) * cosine(m * (degree - k)) * primitive(m, j, cosine);
        integral_[k][j] = static_cast<Scalar>(half_at_ends(k) * sum / n);
      }
    }
  }

  Scalar node(std::size_t k) const noexcept { return node_[k]; }

  /// start + h times the integrals of f from 0 to each node.
  Values integrated(const Values& f, Scalar h, Scalar start) const noexcept {
    Values sum{};
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t j = 0; j < size; ++j) sum[j] += f[k] * integral_[k][j];
    for (Scalar& value : sum) value = start + h * value;
    return sum;
  }

  /// What the values at the nodes are weighted with to give that at x in [0, 1].
  Values weights(Scalar x) const noexcept {
    Values w;
    Scalar sum = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const Scalar away = x - node_[k];
      if (away == 0) {
        w.fill(0);
        w[k] = 1;
        return w;
      }
      w[k] = weight_[k] / away;
      sum += w[k];
    }
    for (Scalar& value : w) value /= sum;
    return w;
  }

 private:
  /// int_{-1}^{y_j} T_m.
  template <class Cosine>
  static long double primitive(std::size_t m, std::size_t j, const Cosine& cosine) noexcept {
    const auto T = [&](std::size_t order) noexcept { return cosine(order * (degree - j)); };
    if (m == 0) return T(1) + 1;
    if (m == 1) return (T(1) * T(1) - 1) / 2;
    const long double up = static_cast<long double>(m + 1), down = static_cast<long double>(m - 1);
    const long double sign = m % 2 == 0 ? 1 : -1;  // of T_(m +- 1)(-1), negative
    return (T(m + 1) / up - T(m - 1) / down) / 2 + sign * (1 / up - 1 / down) / 2;
  }

  Values node_, weight_;
  std::array<Values, size> integral_;
};

}  // namespace gyrostat::math
