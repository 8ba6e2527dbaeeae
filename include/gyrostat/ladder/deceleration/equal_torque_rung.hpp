// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/deceleration/orbit_kind.hpp"
#include "gyrostat/ladder/deceleration/track.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"

namespace gyrostat::deceleration {

/// Rung `equal-torque`: one control torque for all axes and no rotor momentum; exact.
template <class Elliptic>
Track equal_torque_track(const Scene& scene) {
  if (!scene.equal_control()) return refused<Track>(Errc::not_applicable, "the control torques are not equal");
  if (scene.has_rotor())
    return refused<Track>(Errc::not_applicable, "with rotor momentum only |M| has a closed form, not the energy");
  if (!(scene.problem().momentum.norm() > 0))
    return refused<Track>(Errc::not_applicable, "the body is at rest at the start");

  const auto& problem = scene.problem();
  const EqualTorqueMotion<double, Elliptic> motion(problem);
  if (!(motion.modulus().kp2 > 0)) return refused<Track>(Errc::separatrix, "the motion starts on the separatrix");
  Track track;
  double rounding = 0;
  for (const double t : scene.question().times) {
    const auto now = motion.at(t);
    if (!now.momentum.allFinite()) return refused<Track>(Errc::not_applicable, phase_lost);
    State<double> state;
    state.momentum = now.momentum;
    state.norm = now.norm;
    state.energy = now.norm * now.norm * motion.energy_ratio() / 2;
    state.k2 = now.norm > 0 ? motion.modulus().k2 : 0;
    state.regime = now.norm > 0 ? motion.regime() : Regime::rest;
    track.states.push_back(state);
    rounding = std::max(rounding, motion.rounding(t));
  }
  track.stop_time = motion.stop_time();
  const double norm = problem.momentum.norm();
  track.error[column::angular_momentum_norm] = 8 * epsilon<double> * norm;
  track.error[column::energy] = 16 * epsilon<double> * norm * norm * motion.energy_ratio() / 2;
  track.error[column::energy] += problem.energy_error(problem.momentum);
  track.error[column::modulus_squared] =
      motion.polhode() ? 2 * k2_of_data(problem, *motion.polhode(), problem.momentum) : 0;
  track.know_momentum(problem, rounding * norm);
  track.stop_error = 8 * epsilon<double>;
  return track;
}

}  // namespace gyrostat::deceleration
