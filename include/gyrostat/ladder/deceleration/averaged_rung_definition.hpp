// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/deceleration/averaged_rung.hpp"

namespace gyrostat::deceleration {

namespace detail {

GYROSTAT_COMPILED_ONCE PolhodeStart start_of(const Scene& scene) {
  if (const char* why = not_averaged(scene)) return {{}, refused<Track>(Errc::not_applicable, why)};
  const auto& problem = scene.problem();
  const auto p = polhode_through<double>(problem.inverse_inertia, problem.inverse_gaps(), problem.momentum);
  if (!std::isfinite(p.modulus.k2) || !std::isfinite(p.modulus.kp2))
    return {p, refused<Track>(Errc::not_applicable,
                              "M lies across an axis of symmetry: there is no polhode to average over")};
  // 1e-8 of M beside the unstable rotation the body stays there for many turns, of which averaging knows nothing
  if (!(p.modulus.kp2 > epsilon<double>))
    return {p, refused<Track>(Errc::separatrix, "the motion starts on the separatrix, or next to it")};
  return {p, {}};
}

GYROSTAT_COMPILED_ONCE void warn_of_start(Track& track, const Scene& scene, const Polhode<double>& p) {
  const double M = scene.problem().momentum.norm();
  const double breakdown = breakdown_momentum(scene.problem(), scene.greatest_control());
  const double mu = breakdown * breakdown / (M * M);
  warn_of_start(track, mu, symmetry_gap(scene.problem()), scene.equal_control() ? 0 : std::max(1e-3, 10 * mu),
                p.modulus.kp2);
}

GYROSTAT_COMPILED_ONCE void warn_of_motion(Track& track, const AveragingError<double>& error, bool crossed,
                                           bool stuck) {
  if (crossed)
    track.warn(warning::crosses_separatrix, nan<double>,
               "the motion crosses the separatrix: the sign of the momentum about its new axis is not determined");
  if (stuck) track.warn(warning::sticks_to_separatrix);
  if (error.greatest_squeeze() > 0.1)
    track.warn(warning::near_separatrix, error.greatest_squeeze(),
               "one oscillation changes 1 - k2 by a large part of itself");
}

GYROSTAT_COMPILED_ONCE State<double> slow_state(const MeanState<double>& s) {
  State<double> state;
  state.norm = s.norm;
  state.energy = s.norm * s.norm * s.polhode.energy_ratio() / 2;
  state.k2 = s.norm > 0 ? s.polhode.modulus.k2 : 0;
  state.regime = s.norm > 0 ? s.polhode.regime : Regime::rest;
  return state;
}

}  // namespace detail

}  // namespace gyrostat::deceleration
