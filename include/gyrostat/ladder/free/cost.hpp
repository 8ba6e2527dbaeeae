// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/free/full_rung.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"

/// What the rungs of the family `free` cost, s.
namespace gyrostat::free {

inline constexpr FormulaCost closed_form_cost{120e-6, 0.06e-6};
/// Where the angles of wheels are asked: the neighbours' integrals, and a series at each time.
inline constexpr FormulaCost rotor_angle_cost{500e-6, 0.5e-6};
inline constexpr SeriesCost series_cost{4e-6, 1.5e-6, 0.6e-6, 0.5};

inline double cost_of_closed_form(const Scene& scene) noexcept {
  const std::size_t times = scene.question().times.size();
  return closed_form_cost(times) + (scene.gives(column::rotor_angle) ? rotor_angle_cost(times) : 0);
}
inline double cost_of_full(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = turning_rate(scene.gyrostat().problem) * times.back();
  const double tolerance = first_step_tolerance(scene.goal().tightest, phase, honesty::loosest_step);
  return series_cost(phase, tolerance, times.size());
}

}  // namespace gyrostat::free
