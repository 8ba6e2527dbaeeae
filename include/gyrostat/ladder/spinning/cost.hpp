// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"
#include "gyrostat/ladder/spinning/second_order_rung.hpp"
#include "gyrostat/ladder/trials.hpp"

/// What the rungs of the family `spinning` cost, s.
namespace gyrostat::spinning {

inline constexpr FormulaCost linear_cost{2.5e-6, 0.2e-6};
inline constexpr SeriesCost axial_cost{2e-6, 0.5e-6, 0.4e-6, 0.5};
inline constexpr FormulaCost second_order_cost{20e-6, 1e-6}, second_order_grid_cost{35e-6, 0.3e-6};
inline constexpr SeriesCost series_cost{4e-6, 2.2e-6, 0.35e-6, 0.5};

namespace detail {

inline double cost_of_series(const SeriesCost& cost, const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = scene.problem().phase(times.back());
  return cost(phase, first_step_tolerance_of_spinner(scene.goal().tightest, phase), times.size());
}

}  // namespace detail

inline double cost_of_linear(const Scene& scene) noexcept {
  return scene.problem().torque[2] != 0 ? detail::cost_of_series(axial_cost, scene)
                                        : linear_cost(scene.question().times.size());
}
inline double cost_of_second_order(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  return (goes_along_grid(times) ? second_order_grid_cost : second_order_cost)(times.size());
}
/// It is never the cheapest.
inline double cost_of_picard(const Scene&) noexcept { return infinity<double>; }
inline double cost_of_full(const Scene& scene) noexcept { return detail::cost_of_series(series_cost, scene); }

}  // namespace gyrostat::spinning
