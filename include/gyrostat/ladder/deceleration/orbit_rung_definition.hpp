// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/deceleration/orbit_rung.hpp"

namespace gyrostat::deceleration {

namespace detail {

GYROSTAT_COMPILED_ONCE double orbit_breakdown(const Problem<double>& problem, double torque) noexcept {
  const double turn = problem.gyro_rate().norm();
  const double free = breakdown_momentum(problem, torque);
  return turn > 0 ? std::min(free, torque / turn) : free;
}

GYROSTAT_COMPILED_ONCE State<double> slow_state(const Problem<double>& problem, const Level<double>& level,
                                                Component component, bool at_rest) {
  State<double> state;
  if (at_rest) {
    state.norm = problem.law == Law::total ? 0.0 : problem.rotor_momentum.norm();
    state.energy = problem.law == Law::total ? problem.rotor_energy_scale() / 2 : 0.0;
    return state;
  }
  const auto orbit = Orbit<double>::at(problem, level, component);
  state.norm = level.R;
  state.energy = std::max(0.0, energy_of(problem, level));
  state.k2 = orbit ? orbit->modulus().k2 : nan<double>;
  state.regime = orbit ? orbit->regime() : component.regime;
  return state;
}

GYROSTAT_COMPILED_ONCE double k2_beside(const Problem<double>& problem, const State<double>& state, double norm,
                                        double energy) noexcept {
  if (!(state.norm > 0) || state.regime == Regime::rest || state.regime == Regime::point) return 0;
  const Level<double> level{state.norm, (state.energy - problem.rotor_energy_scale() / 2) / state.norm};
  return k2_of_level(problem, level, {state.regime, state.k2}, norm,
                     (energy + std::abs(level.eta) * norm) / state.norm);
}

GYROSTAT_COMPILED_ONCE Impasse impasse(const Problem<double>& problem, const Level<double>& level, Component component,
                                       Errc failure) {
  if (failure == Errc::step_limit || component.regime != Regime::one_component) return {failure};
  const auto band = band_of(problem, level);
  if (!band || !(band->separatrix_distance() < 1e-4)) return {failure};
  const bool below = band->below.kind == Critical::saddle &&
                     !(band->above.kind == Critical::saddle && band->to_above < band->to_below);
  const auto next = capture(problem, level.R, below ? band->below.lobes : band->above.lobes, component);
  if (!next) return {next.error() == Errc::undetermined ? Errc::separatrix : failure};
  if (next->determined()) return {Errc::separatrix};
  return {Errc::undetermined, std::max({next->plus, next->minus, next->outside})};
}

}  // namespace detail

}  // namespace gyrostat::deceleration
