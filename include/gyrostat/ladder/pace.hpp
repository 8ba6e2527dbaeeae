// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Watches whether steps that do not lengthen would overrun their budget by far; looks once in 65536 steps.
template <Real Scalar>
class Pace {
 public:
  /// The motion begins anew at t, as where a law changes.
  void restart(Scalar t) noexcept { mark_ = t, stretch_ = 0; }
  /// After so many steps, now, where they go on to `last` and `budget` is theirs.
  bool is_hopeless(std::uint64_t steps, Scalar now, Scalar last, std::uint64_t budget) noexcept {
    constexpr std::uint64_t some = 1 << 16;
    if (steps == 0 || steps % some != 0) return false;
    const Scalar before = stretch_;
    stretch_ = now - mark_, mark_ = now;
    return stretch_ <= before && (last - now) / stretch_ * Scalar(some) > 4 * Scalar(budget);
  }

 private:
  Scalar mark_ = 0, stretch_ = 0;  ///< when it was looked last, and how far the steps before had come, s
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
