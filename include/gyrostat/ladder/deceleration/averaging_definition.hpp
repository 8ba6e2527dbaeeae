// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "gyrostat/ladder/deceleration/averaging.hpp"

namespace gyrostat::deceleration {

namespace detail {

GYROSTAT_COMPILED_ONCE const char* not_averaged(const Scene& scene) noexcept {
  if (scene.sphere()) return "a sphere has no fast polhode to average over";
  if (!(scene.problem().momentum.norm() > 0)) return "the body is at rest at the start";
  return nullptr;
}

GYROSTAT_COMPILED_ONCE void warn_of_start(Track& track, double mu, double gap, double narrow, double kp2) {
  if (mu > 0.1) track.warn(warning::not_slow, mu);
  if (gap < narrow) track.warn(warning::near_symmetric, gap);
  if (kp2 < std::max(1e-2, 10 * mu)) track.warn(warning::near_separatrix, kp2);
}

GYROSTAT_COMPILED_ONCE void state_errors(Track& track, const SlowError<double>& error) noexcept {
  track.error[column::angular_momentum_norm] = error.norm;
  track.error[column::energy] = error.energy;
  track.error[column::modulus_squared] = error.k2;
}

GYROSTAT_COMPILED_ONCE Halt not_followed(Errc failure) noexcept {
  if (failure == Errc::undetermined)
    return {failure, "the motion goes one of two ways behind a separatrix, and averaging does not tell which"};
  if (failure == Errc::separatrix) return {failure, "the motion comes to a separatrix"};
  if (failure == Errc::step_limit) return {failure, "the mean equations need too many steps"};
  return {failure, "the mean equations could not be integrated"};
}

}  // namespace detail

}  // namespace gyrostat::deceleration
