// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/models/deceleration/averaging_error.hpp"

namespace gyrostat::deceleration {

/// How many breakdown momenta are left when the full equations take over from the averaged ones: the later, the less the
/// mean equations err there and the more turns the full ones make.
inline double hand_over_share(const Scene& scene) noexcept {
  return std::clamp(std::pow(scene.goal().tightest, -0.25), 8.0, 100.0);
}

namespace detail {

/// Error of what the control opposes, N m s: |M|, or |J omega| = `carrier`, which follows from the energy.
GYROSTAT_COMPILED_ONCE double opposed_error(const Problem<double>& problem, const SlowError<double>& error,
                                            double carrier) noexcept;

}  // namespace detail

/// Goes on from M (principal axes) at time `begin` with the full equations: appends the samples that the track still
/// lacks, finds the stop, and adds to the track's errors what `error` at the hand-over grows to, as a neighbour shows
/// that starts as far away along its orbit as the phase may be wrong.
GYROSTAT_COMPILED_ONCE Errc hand_over(Track& track, const Scene& scene, const Vec3<double>& M, double begin,
                                      const SlowError<double>& error, Monitor* monitor);

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/hand_over_definition.hpp"
#endif
