// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/deceleration/track.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"

namespace gyrostat::deceleration {

/// Rung `equal-torque`: one control torque for all axes and no rotor momentum; exact.
template <class Elliptic>
Track equal_torque_track(const Scene& scene) {
  if (!scene.equal_control()) return refused<Track>(Errc::not_applicable, "the control torques are not equal");
  if (scene.has_rotor())
    return refused<Track>(Errc::not_applicable, "with rotor momentum only |M| has a closed form, not the energy");
  if (scene.data().wants_attitude) return refused<Track>(Errc::not_applicable, "the closed form has no attitude");
  if (!(scene.problem().momentum.norm() > 0))
    return refused<Track>(Errc::not_applicable, "the body is at rest at the start");

  const EqualTorqueMotion<double, Elliptic> motion(scene.problem());
  if (!(motion.modulus().kp2 > 0)) return refused<Track>(Errc::separatrix, "the motion starts on the separatrix");
  Track track;
  double rounding = 0;
  for (const double t : scene.data().times) {
    const auto now = motion.at(t);
    track.norm.push_back(now.norm);
    track.energy.push_back(now.norm * now.norm * motion.energy_ratio() / 2);
    track.k2.push_back(now.norm > 0 ? motion.modulus().k2 : 0);
    track.regime.push_back(now.norm > 0 ? motion.regime() : Regime::rest);
    track.momentum.push_back(now.momentum);
    rounding = std::max(rounding, motion.rounding(t));
  }
  track.stop_time = motion.stop_time();
  const double norm = scene.problem().momentum.norm();
  track.norm_error = 8 * epsilon<double> * norm;
  track.energy_error = 16 * epsilon<double> * norm * norm * motion.energy_ratio() / 2;
  track.k2_error = 16 * epsilon<double>;
  track.momentum_error = rounding * norm;
  track.stop_error = 8 * epsilon<double>;
  return track;
}

}  // namespace gyrostat::deceleration
