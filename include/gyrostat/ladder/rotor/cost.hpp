// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"
#include "gyrostat/ladder/trials.hpp"

/// What the rungs of the family `rotor` cost, s.
namespace gyrostat::rotor {

inline constexpr FormulaCost closed_form_cost{1.5e-6, 0.25e-6};
/// From a start that is near; where the full equations bring it near first, that is more.
inline constexpr FormulaCost linear_tail_cost{40e-6, 1e-6};
inline constexpr SeriesCost series_cost{6e-6, 1.7e-6, 0.3e-6, 0.25};

inline double cost_of_closed_form(const Scene& scene) noexcept {
  return closed_form_cost(scene.question().times.size());
}
inline double cost_of_linear_tail(const Scene& scene) noexcept {
  return linear_tail_cost(scene.question().times.size());
}
inline double cost_of_full(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = turning_rate(scene.gyrostat(), scene.start()) * times.back();
  const double tolerance = first_step_tolerance_of_phase(scene.goal().tightest, phase, honesty::loosest_step);
  return series_cost(phase, tolerance, times.size());
}

}  // namespace gyrostat::rotor
