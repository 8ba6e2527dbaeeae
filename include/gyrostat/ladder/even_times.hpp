// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Whether two times or more lie on an even grid, to rounding.
inline bool even(std::span<const double> times) noexcept {
  if (times.size() < 2) return false;
  const double start = times.front(), step = (times.back() - start) / double(times.size() - 1);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(std::abs(times[i] - (start + double(i) * step)) <= 4 * epsilon<double> * times.back())) return false;
  return true;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
