// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Whether these are times of a motion that starts at 0. Errc::not_finite, or not_increasing (a time before the start, or before the one ahead of it).
template <Real Scalar>
Errc check_span(std::span<const Scalar> times) noexcept {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!(std::abs(times[i]) < infinity<Scalar>)) return Errc::not_finite;
    if (times[i] < 0 || (i > 0 && times[i] < times[i - 1])) return Errc::not_increasing;
  }
  return Errc::ok;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
