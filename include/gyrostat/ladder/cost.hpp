// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"

/// What an answer will cost, foreseen from a scene: shapes of the formulas; each family has its numbers (ladder/*/cost.hpp), fitted to
/// what its rungs took on one core of some 3 GHz (the honesty benches print spent over predicted).
namespace gyrostat::inline GYROSTAT_LEVEL {

/// A rung that evaluates formulas: once for the scene, and at each time.
struct FormulaCost {
  double set_up, time;  ///< s

  constexpr double operator()(std::size_t times) const noexcept { return set_up + double(times) * time; }
};

/// A run of Taylor series with the runs of its companions.
struct SeriesCost {
  double set_up;  ///< s
  double step;    ///< s, of all runs
  double time;    ///< s an asked time, of all runs
  double steps;   ///< a radian, at a step tolerance of one rounding

  /// angle: turned through up to the last time, rad.
  double operator()(double angle, double step_tolerance, std::size_t times) const noexcept {
    constexpr double order = 20;
    const double longer = std::pow(std::fmax(step_tolerance / epsilon<double>, 1e-300), 1 / order);
    return set_up + (2 + steps * angle / longer) * step + double(times) * time;
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
