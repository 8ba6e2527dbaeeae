// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/rung.hpp"
#include "gyrostat/models/free/quick_lanes.hpp"

namespace gyrostat::free {

/// Answers a scene with the cheapest rung whose own error estimate meets the tolerance: closed-form, full. Where no rung answers, the
/// refusal says why and the answer holds only what was tried. Beside the columns the answer has the scalars of the table: kind, period,
/// turn about the angular momentum in a period, and so on.
GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor = nullptr);

/// The same answers to scenes, at most QuickLanes::size of them, as far as they can be had side by side, without what was tried: a bit, 2^i, for each that
/// has its answer. The room of earlier answers is used again.
GYROSTAT_COMPILED_ONCE unsigned solve_together(std::span<const Scene> scenes, std::span<Answer> answers);

/// The ladder for a sweep (ladder/sweep.hpp).
struct SweepSolver {
  static constexpr std::size_t width = QuickLanes::size;
  Answer operator()(const Scene& scene, Refusal& refusal, Monitor* monitor) const {
    return solve(scene, refusal, monitor);
  }
  unsigned together(std::span<const Scene> scenes, std::span<Answer> answers, Monitor* = nullptr) const {
    return solve_together(scenes, answers);
  }
};

/// What an answer by that rung would cost where it applies, by its place in the table, s.
GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept;

}  // namespace gyrostat::free

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/free/solve_definition.hpp"
#endif
