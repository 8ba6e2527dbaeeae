// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Watches whether steps will overrun their budget; looks once in `some` steps. They will, from the second look on, if they do not lengthen and would need
/// four times the budget; from the seventh, if they overrun it at their present length or, where they have lengthened, by half of it though that goes on.
template <Real Scalar, std::uint64_t some = 65536>
class Pace {
 public:
  /// The motion begins anew at t, as where a law changes.
  void restart(Scalar t) noexcept { mark_ = t, stretch_ = first_ = 0, looks_ = 0; }
  /// After `steps` steps up to the time `now` of a run to `last` that may take `budget` steps.
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
  Scalar mark_ = 0, stretch_ = 0;  ///< time of the last look, and the time covered between the last two, s
  Scalar first_ = 0;               ///< time covered up to the first look, s
  int looks_ = 0;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
