// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/rotor/full_rung.hpp"
#include "gyrostat/ladder/rotor/state_columns.hpp"
#include "gyrostat/ladder/rotor/track.hpp"
#include "gyrostat/models/rotor/linear_tail.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"

namespace gyrostat::rotor {

namespace detail {

/// The steady rotations that attract exponentially: two at most.
struct ExponentialAttractors {
  std::array<SteadyRotation<double>, 2> at{};
  std::array<SteadyStability<double>, 2> stability{};
  std::size_t count = 0;

  ExponentialAttractors(const Gyrostat<double>& body, double l) noexcept {
    for (const auto& steady : steady_rotations(body, l)) {
      const auto here = stability_of(body, l, steady);
      if (here.verdict != Verdict::asymptotically_stable || !(here.decay_rate > 0) || count == at.size()) continue;
      at[count] = steady;
      stability[count++] = here;
    }
  }
  /// The tail from a state towards the nearest of them.
  LinearTail<double> tail(const Gyrostat<double>& body, const State<double>& state) const noexcept {
    const auto nearness = [&](std::size_t i) { return state.momentum.dot(at[i].direction); };
    const std::size_t i = count > 1 && nearness(1) > nearness(0) ? 1 : 0;
    return {body, state, at[i], stability[i]};
  }
};

}  // namespace detail

/// Rung `linear-tail`: near a steady rotation that attracts exponentially, the motion in closed form to second order in the distance
/// (docs/rotor.md, section 6). From a start too far away the full equations are solved first, until it is near enough, where
/// that saves work.
GYROSTAT_COMPILED_ONCE Track linear_tail_track(const Scene& scene, Monitor* monitor);

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/linear_tail_rung_definition.hpp"
#endif
