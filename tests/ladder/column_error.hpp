// SPDX-License-Identifier: BSD-3-Clause
// The true error of a column.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/rotation/euler_312.hpp"

namespace gyrostat {

/// The angle between two attitudes, quaternions [x, y, z, w] or 3-1-2 angles, rad.
inline double turn_between(const double* a, const double* b, int width) {
  const auto attitude = [width](const double* x) {
    return width == 4 ? Quat<double>{x[3], x[0], x[1], x[2]} : quaternion_from_312(x[0], x[1], x[2]);
  };
  const Quat<double> p = attitude(a), q = attitude(b);
  const double apart = std::hypot(std::hypot(p.w - q.w, p.x - q.x), std::hypot(p.y - q.y, p.z - q.z));
  const double opposite = std::hypot(std::hypot(p.w + q.w, p.x + q.x), std::hypot(p.y + q.y, p.z + q.z));
  return 4 * std::asin(std::min(1.0, std::min(apart, opposite) / 2));
}

/// As the table of columns measures it: by the angle, rad; absolute; or relative to the greatest norm, or to the scale where that is greater.
inline double column_error(const Column& column, const Column& truth) {
  double most = 0, size = column.scale;
  const std::size_t w = std::size_t(column.row_width());
  const bool attitude = column.kind->measure == Measure::angle;
  for (std::size_t i = 0; i < column.values.size(); i += w) {
    double difference = 0, norm = 0;
    for (std::size_t j = i; j < i + w; ++j) {
      difference += (column.values[j] - truth.values[j]) * (column.values[j] - truth.values[j]);
      norm += truth.values[j] * truth.values[j];
    }
    if (attitude) most = std::max(most, turn_between(&column.values[i], &truth.values[i], int(w)));
    else most = std::max(most, std::sqrt(difference));
    size = std::max(size, std::sqrt(norm));
    if (std::isnan(difference)) return infinity<double>;
  }
  return column.kind->measure == Measure::absolute || attitude || size == 0 ? most : most / size;
}

}  // namespace gyrostat
