// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Watches whether steps would overrun their budget; looks once in `some` steps. Where they do not lengthen and would by far, at the second look; else behind
/// seven, if they go on to lengthen as they did: by half of the budget, or, where they did not, at all.
template <Real Scalar, std::uint64_t some = 65536>
class Pace {
 public:
  /// The motion begins anew at t, as where a law changes.
  void restart(Scalar t) noexcept { mark_ = t, stretch_ = first_ = 0, looks_ = 0; }
  /// After so many steps, now, where they go on to `last` and `budget` is theirs.
  bool is_hopeless(std::uint64_t steps, Scalar now, Scalar last, std::uint64_t budget) noexcept {
    if (steps == 0 || steps % some != 0) return false;
    const Scalar before = stretch_;
    stretch_ = now - mark_, mark_ = now;
    if (looks_++ == 0) first_ = stretch_;
    const Scalar all = Scalar(budget) / Scalar(some), done = Scalar(steps) / Scalar(some);
    const Scalar alike = (last - now) / stretch_;  // looks that are left at this pace
    if (stretch_ <= before && alike > 4 * all) return true;
    if (looks_ < 7) return false;
    const Scalar grown = stretch_ / first_;
    if (grown <= Scalar(1.001L)) return done + alike > all;
    const Scalar rate = std::log(grown) / Scalar(looks_ - 1);
    return done + std::log1p(std::expm1(rate) * alike) / rate > Scalar(1.5L) * all;
  }

 private:
  Scalar mark_ = 0, stretch_ = 0;  ///< when it was looked last, and how far the steps before had come, s
  Scalar first_ = 0;               ///< how far the first ones had come, s
  int looks_ = 0;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
