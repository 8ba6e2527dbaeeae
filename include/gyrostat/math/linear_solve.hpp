// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// The length of a row that solve_in_place takes for n unknowns.
constexpr std::size_t padded(std::size_t n) noexcept { return (n + 3) / 4 * 4; }

/// b becomes the x of A x = b, by Gauss's elimination with pivoting of rows; A is lost. False, and b without meaning, where A is singular
/// to the last digit or not finite. No allocation.
/// @param a rows of padded(n) numbers, n of them used   @param b n numbers
template <Real Scalar>
[[nodiscard]] bool solve_in_place(std::span<Scalar> a, std::span<Scalar> b) noexcept {
  const std::size_t n = b.size(), stride = padded(n);
  if (a.size() < n * stride) return false;
  const auto row = [&](std::size_t i) noexcept { return a.data() + i * stride; };
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(row(i)[k]) > std::abs(row(pivot)[k])) pivot = i;
    const Scalar inverse = 1 / row(pivot)[k];
    if (!(std::abs(inverse) < infinity<Scalar>) || inverse == 0) return false;
    const std::size_t from = k / 4 * 4;
    if (pivot != k) {
      for (std::size_t j = from; j < stride; j += 4) {
        const Lanes<Scalar> one = load(row(k) + j), other = load(row(pivot) + j);
        store(row(k) + j, other);
        store(row(pivot) + j, one);
      }
      const Scalar value = b[k];
      b[k] = b[pivot];
      b[pivot] = value;
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const Scalar factor = row(i)[k] * inverse;
      if (factor == 0) continue;
      const Lanes<Scalar> by = lanes(-factor);
      for (std::size_t j = from; j < stride; j += 4)
        store(row(i) + j, multiply_add(by, load(row(k) + j), load(row(i) + j)));
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    Scalar sum = b[i];
    for (std::size_t j = i + 1; j < n; ++j) sum -= row(i)[j] * b[j];
    b[i] = sum / row(i)[i];
  }
  return true;
}

}  // namespace gyrostat::math
