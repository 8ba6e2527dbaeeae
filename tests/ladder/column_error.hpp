// SPDX-License-Identifier: BSD-3-Clause
// The true error of a column.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/answer.hpp"

namespace gyrostat {

/// As the table of columns measures it: by the angle, rad; absolute; or relative to the greatest norm, or to the scale where that is greater.
inline double column_error(const Column& column, const Column& truth) {
  double most = 0, size = column.scale;
  const std::size_t w = std::size_t(column.kind->width);
  const bool attitude = column.kind->measure == Measure::angle;
  for (std::size_t i = 0; i < column.values.size(); i += w) {
    double difference = 0, opposite = 0, norm = 0;
    for (std::size_t j = i; j < i + w; ++j) {
      difference += (column.values[j] - truth.values[j]) * (column.values[j] - truth.values[j]);
      opposite += (column.values[j] + truth.values[j]) * (column.values[j] + truth.values[j]);
      norm += truth.values[j] * truth.values[j];
    }
    if (attitude) most = std::max(most, 4 * std::asin(std::min(1.0, std::sqrt(std::min(difference, opposite)) / 2)));
    else most = std::max(most, std::sqrt(difference));
    size = std::max(size, std::sqrt(norm));
    if (std::isnan(difference)) return infinity<double>;
  }
  return column.kind->measure == Measure::absolute || attitude || size == 0 ? most : most / size;
}

}  // namespace gyrostat
