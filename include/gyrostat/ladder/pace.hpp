// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Watches whether steps that do not lengthen would overrun their budget by far, or such as stay alike at all; looks once in 65536 steps.
template <Real Scalar>
class Pace {
 public:
  /// The motion begins anew at t, as where a law changes.
  void restart(Scalar t) noexcept { mark_ = t, stretch_ = 0, alike_ = 0; }
  /// After so many steps, now, where they go on to `last` and `budget` is theirs.
  bool is_hopeless(std::uint64_t steps, Scalar now, Scalar last, std::uint64_t budget) noexcept {
    constexpr std::uint64_t some = 1 << 16;
    if (steps == 0 || steps % some != 0) return false;
    const Scalar before = stretch_;
    stretch_ = now - mark_, mark_ = now;
    alike_ = std::abs(stretch_ - before) <= before / 64 ? alike_ + 1 : 0;
    const Scalar left = (last - now) / stretch_ * Scalar(some);
    return (stretch_ <= before && left > 4 * Scalar(budget)) || (alike_ >= 6 && Scalar(steps) + left > Scalar(budget));
  }

 private:
  Scalar mark_ = 0, stretch_ = 0;  ///< when it was looked last, and how far the steps before had come, s
  int alike_ = 0;                  ///< how often in a row they came as far as those before
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
