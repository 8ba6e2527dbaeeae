// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "gyrostat/models/deceleration/orbit.hpp"
#include "gyrostat/models/deceleration/problem.hpp"

namespace gyrostat::deceleration {

/// Kind and modulus of the free orbit through M.
struct OrbitKind {
  Regime regime = Regime::rest;
  double k2 = 0;
};

/// Whether M stands in the body but for roundings, which an orbit made of differences of the energy may take for a turn.
inline bool rests_in_body(const Problem<double>& problem, const Vec3<double>& M) noexcept {
  const double rate = (problem.inverse_inertia.cwiseProduct(M)).norm() + problem.gyro_rate().norm();
  return M.cross(problem.angular_velocity(M)).norm() <= 32 * epsilon<double> * M.norm() * rate;
}

GYROSTAT_COMPILED_ONCE OrbitKind orbit_kind(const Problem<double>& problem, const Vec3<double>& M) noexcept;

/// How far the modulus of the polhode through M, no rotors, can be off by what rounding makes of the data.
GYROSTAT_COMPILED_ONCE double k2_of_data(const Problem<double>& problem, const Polhode<double>& p,
                                         const Vec3<double>& M) noexcept;

/// How far the modulus of the orbit on a level can be off when the level is, N m s and rad/s.
GYROSTAT_COMPILED_ONCE double k2_of_level(const Problem<double>& problem, const Level<double>& level,
                                          const OrbitKind& at, double R, double eta) noexcept;

/// How far the modulus at M can be off when |M| and the energy are off by the given errors, N m s and J, and orbit_place() by `place`: an error
/// along the orbit does not count.
GYROSTAT_COMPILED_ONCE double k2_uncertainty(const Problem<double>& problem, const Vec3<double>& M, const OrbitKind& at,
                                             double norm, double energy, double place = infinity<double>) noexcept;

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/orbit_kind_definition.hpp"
#endif
