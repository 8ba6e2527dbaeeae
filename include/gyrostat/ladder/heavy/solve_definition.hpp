// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/heavy/cost.hpp"
#include "gyrostat/ladder/heavy/exact_rung.hpp"
#include "gyrostat/ladder/heavy/full_rung.hpp"
#include "gyrostat/ladder/heavy/series_2_rung.hpp"
#include "gyrostat/ladder/heavy/series_rung.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"

namespace gyrostat::heavy {

namespace detail {

/// Warnings of a fast periodic motion (docs/heavy.md, section 10). warn(place, value) adds one.
template <class Warn>
void warn_of_periodic(const Scaled<double>& s, const Warn& warn) {
  const Doubts doubt = doubts(s);
  if (doubt.slow) warn(warning::slow_spin, 1 / std::sqrt(s.load.norm()));
  if (doubt.strong_gradient) warn(warning::strong_gradient, s.gradient);
  // a slow spin is near everything
  if (!doubt.slow && doubt.near_a) warn(warning::near_equal_moments_1, s.off_a);
  if (!doubt.slow && doubt.near_b) warn(warning::near_equal_moments_2, s.off_b);
  if (!doubt.slow && doubt.near_lamina) warn(warning::near_lamina, s.flatness);
  if (doubt.upright) warn(warning::upright, s.M3);
  const Floquet<double> floquet(s);
  const double off = std::sqrt(std::max(floquet.squared, 0.0)) - 0.5;
  if (floquet.tongue > 0 && std::abs(off) < 2 * floquet.tongue + floquet.squared_error) warn(warning::resonance, off);
}

}  // namespace detail

/// What is known of period and stability, and warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  const Problem<double>& problem = scene.problem();
  const auto warn = [&](std::size_t which, double value) {
    answer.warnings.push_back({&warning_kinds[which], warning_kinds[which].text, value});
  };
  tell(answer, scene.periodic() ? track.periodicity : periodicity_from(scene));
  if (scene.periodic()) {
    const auto& [spin, cosine] = *scene.periodic();
    if (const auto scaled = Scaled<double>::make(problem, spin, cosine)) {
      detail::warn_of_periodic(*scaled, warn);
      const Floquet<double> floquet(*scaled);
      if (!floquet.alone && answer.model != rung_kinds[rung::exact].name) warn(warning::not_unique, floquet.squared);
    }
    if (stability(track.periodicity) == 0) warn(warning::unstable, multipliers(track.periodicity.trace).first.re);
  }
  if (problem.gradient() > 0) {
    const double distance = 3 * problem.gravity() / problem.gradient();
    const double size = std::sqrt(problem.inertia().sum() / (2 * problem.mass()));
    if (!(distance > 100 * size)) warn(warning::gradient, distance);
  }
}

/// In the order of rung_kinds.
inline constexpr Rung<Scene, Track> models[] = {{&exact_track, &cost_of_exact},
                                                {&series_2_track, &cost_of_series_2},
                                                {&series_track, &cost_of_series},
                                                {&full_track, &cost_of_full}};

GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept {
  return models[rung].cost(scene);
}

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

}  // namespace gyrostat::heavy
