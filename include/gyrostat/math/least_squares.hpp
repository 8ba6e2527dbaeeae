// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// The x of least |A x - b|, by Householder's reflections with pivoting of columns. `columns[j][i]` is A in row i, column j. Columns that
/// lie in the span of the others to `threshold` of the longest are left out: their x is zero. NaN gives NaN. No allocation.
template <Real Scalar, std::size_t Rows, std::size_t Columns>
[[nodiscard]] std::array<Scalar, Columns> least_squares(std::array<std::array<Scalar, Rows>, Columns> columns,
                                                        std::array<Scalar, Rows> b, Scalar threshold) noexcept {
  static_assert(Rows >= Columns);
  const auto length = [](const std::array<Scalar, Rows>& a, std::size_t from) noexcept {
    Scalar greatest = 0;
    for (std::size_t i = from; i < Rows; ++i)
      greatest = std::abs(a[i]) > greatest ? std::abs(a[i]) : greatest + 0 * a[i];
    if (!(greatest > 0)) return greatest;
    Scalar sum = 0;
    for (std::size_t i = from; i < Rows; ++i) sum += (a[i] / greatest) * (a[i] / greatest);
    return greatest * std::sqrt(sum);
  };
  std::array<std::size_t, Columns> place{};
  for (std::size_t j = 0; j < Columns; ++j) place[j] = j;
  std::array<Scalar, Columns> diagonal{};
  Scalar longest = 0;
  std::size_t rank = 0;
  for (; rank < Columns; ++rank) {
    std::size_t pivot = rank;
    Scalar most = -1;
    for (std::size_t j = rank; j < Columns; ++j) {
      const Scalar here = length(columns[j], rank);
      if (here > most || here != here) {
        most = here;
        pivot = j;
      }
      if (here != here) break;
    }
    if (rank == 0) longest = most;
    if (most <= threshold * longest) break;
    std::swap(columns[rank], columns[pivot]);
    std::swap(place[rank], place[pivot]);
    auto& v = columns[rank];
    // reflects the column onto its axis: R's diagonal is -sign(v) |v|
    diagonal[rank] = v[rank] > 0 ? -most : most;
    v[rank] -= diagonal[rank];
    const Scalar scale = diagonal[rank] * v[rank];  // -|reflector|^2/2
    const auto reflect = [&](std::array<Scalar, Rows>& a) noexcept {
      Scalar dot = 0;
      for (std::size_t i = rank; i < Rows; ++i) dot += v[i] * a[i];
      dot /= scale;
      for (std::size_t i = rank; i < Rows; ++i) a[i] += dot * v[i];
    };
    for (std::size_t j = rank + 1; j < Columns; ++j) reflect(columns[j]);
    reflect(b);
  }
  std::array<Scalar, Columns> x{};
  for (std::size_t j = rank; j-- > 0;) {
    Scalar sum = b[j];
    for (std::size_t k = j + 1; k < rank; ++k) sum -= columns[k][j] * x[place[k]];
    x[place[j]] = sum / diagonal[j];
  }
  return x;
}

}  // namespace gyrostat::math
