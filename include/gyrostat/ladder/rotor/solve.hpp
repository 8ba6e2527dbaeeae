// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"
#include "gyrostat/ladder/rung.hpp"

namespace gyrostat::rotor {

/// Answers a scene with the cheapest rung whose own error estimate meets the tolerance: closed-form, linear-tail, full. Where no
/// rung answers, the refusal says why and the answer holds only what was tried.
/// Beside the columns the answer has `attractor`, the index of the steady rotation (steady_rotations, ascending level) that the motion
/// is certain to tend to, as known at the last time, and its `decay_rate`, 1/s; NaN where it is not certified or there is none.
GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor = nullptr);

/// Answers to scenes, at most SweepSolver::width of them, by the same ladder but with `full` in lanes (ladder/rotor/full_lanes.hpp): a bit, 2^i, for
/// each that has an answer which meets its question; the others are left to solve. An answer of `full` differs from that of solve in its last bits,
/// as its own estimate tells, and is the same whatever scenes are beside it. What was tried is not told.
GYROSTAT_COMPILED_ONCE unsigned solve_together(std::span<const Scene> scenes, std::span<Answer> answers,
                                               Monitor* monitor = nullptr);

/// The ladder for a sweep (ladder/sweep.hpp).
struct SweepSolver {
  static constexpr std::size_t width = 32;
  Answer operator()(const Scene& scene, Refusal& refusal, Monitor* monitor) const {
    return solve(scene, refusal, monitor);
  }
  unsigned together(std::span<const Scene> scenes, std::span<Answer> answers, Monitor* monitor = nullptr) const {
    return solve_together(scenes, answers, monitor);
  }
};

/// What an answer by that rung would cost where it applies, by its place in the table, s.
GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept;

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/solve_definition.hpp"
#endif
