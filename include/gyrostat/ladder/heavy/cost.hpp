// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/heavy/euler_case.hpp"
#include "gyrostat/models/heavy/full.hpp"

/// What the rungs of the family `heavy` cost, s.
namespace gyrostat::heavy {

inline constexpr FormulaCost exact_cost{10e-6, 0.3e-6};
/// Without torque: the free motion and its neighbours; where down comes from an attitude, of two more bodies.
inline constexpr FormulaCost euler_cost{100e-6, 0.1e-6};
inline constexpr FormulaCost series_2_cost{10e-6, 0.1e-6};
inline constexpr FormulaCost forced_series_cost{10e-6, 0.15e-6};
inline constexpr SeriesCost series_cost{4e-6, 1.3e-6, 0.15e-6, 0.8};
/// Where shooting looks for the periodic motion first.
inline constexpr double shooting_cost = 200e-6;

inline double cost_of_exact(const Scene& scene) noexcept {
  const std::size_t times = scene.question().times.size();
  if (!EulerCase<double>::holds(scene.problem())) return exact_cost(times);
  return euler_cost(times) + (scene.converts_start() && !scene.converts_body() ? 2 * euler_cost(0) : 0);
}
inline double cost_of_series_2(const Scene& scene) noexcept { return series_2_cost(scene.question().times.size()); }
inline double cost_of_series(const Scene& scene) noexcept { return forced_series_cost(scene.question().times.size()); }
inline double cost_of_full(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  if (scene.periodic()) return shooting_cost + exact_cost(times.size());
  const double phase = rate_size(scene.problem(), scene.start()) * times.back();
  const double tolerance = first_step_tolerance(scene.goal().tightest, phase, honesty::loosest_step);
  return series_cost(phase, tolerance, times.size());
}

}  // namespace gyrostat::heavy
