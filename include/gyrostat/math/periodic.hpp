// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/compensated.hpp"
#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// Means of N functions over one period.
template <Real Scalar, std::size_t N>
struct PeriodicMeans {
  std::array<Scalar, N> value{};
  std::array<Scalar, N> error{};  ///< difference of the last two rules: far above the error left where they converge
  int nodes = 0;                  ///< nodes of the last rule = calls made
  bool converged = false;
};

/// Means over one period of N functions at once, by the trapezoid rule on 2^j nodes, doubled until two rules agree.
/// `f(x)` gives a std::array<Scalar, N> at the phase x in [0, 1) of the period. The rule converges exponentially for
/// an analytic f (error exp(-2 pi a nodes) for a strip of half-width a), and each doubling keeps the nodes it has.
/// Stops when every difference is below tolerance times the mean of |f_i|, or at `most` nodes with converged false.
/// NaN in f ends it at once with NaN means and converged false. `first` and `most` are powers of two. No allocation.
template <Real Scalar, std::size_t N, class Function>
[[nodiscard]] inline PeriodicMeans<Scalar, N> periodic_means(const Function& f, Scalar tolerance, int first = 16,
                                                             int most = 4096) noexcept {
  PeriodicMeans<Scalar, N> result;
  std::array<Scalar, N> sum{}, low{};  // thousands of numbers that are nearly alike would round alike
  std::array<Scalar, N> size{};
  const auto add = [&](int nodes, int from, int step) {
    for (int j = from; j < nodes; j += step) {
      const std::array<Scalar, N> value = f(Scalar(j) / Scalar(nodes));
      for (std::size_t i = 0; i < N; ++i) {
        add_to(sum[i], low[i], value[i]);
        size[i] += std::abs(value[i]);
      }
    }
  };
  add(first, 0, 1);
  int nodes = first;
  for (std::size_t i = 0; i < N; ++i) {
    result.value[i] = sum[i] / Scalar(nodes);
    result.error[i] = infinity<Scalar>;
  }
  while (nodes < most && !result.converged) {
    nodes *= 2;
    add(nodes, 1, 2);
    bool agree = true;
    bool finite = true;
    for (std::size_t i = 0; i < N; ++i) {
      const Scalar mean = sum[i] / Scalar(nodes);
      result.error[i] = std::abs(mean - result.value[i]);
      result.value[i] = mean;
      agree = agree && result.error[i] <= tolerance * (size[i] / Scalar(nodes));
      finite = finite && std::isfinite(mean);
    }
    result.converged = agree;
    if (!finite) break;
  }
  result.nodes = nodes;
  return result;
}

}  // namespace gyrostat::math
