// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "gyrostat/ladder/deceleration/averaged_rung.hpp"
#include "gyrostat/ladder/deceleration/equal_torque_rung.hpp"
#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/ladder/deceleration/orbit_rung.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"
#include "gyrostat/models/deceleration/capture.hpp"

namespace gyrostat::deceleration {

namespace detail {

/// Rotor momentum, or actuators off the principal axes: the orbit algorithm; otherwise the closed forms of Euler.
inline bool needs_orbit(const Scene& scene) noexcept { return scene.has_rotor() || !scene.principal_control(); }

template <class Elliptic>
Track averaged(const Scene& scene, Monitor* monitor) {
  return needs_orbit(scene) ? orbit_averaged_track<Elliptic>(scene, monitor) : averaged_track<Elliptic>(scene);
}
template <class Elliptic>
Track averaged_2(const Scene& scene, Monitor* monitor) {
  return needs_orbit(scene) ? orbit_averaged_2_track<Elliptic>(scene, monitor)
                            : averaged_2_track<Elliptic>(scene, monitor);
}
template <class Elliptic>
Track equal_torque(const Scene& scene, Monitor*) {
  return equal_torque_track<Elliptic>(scene);
}

/// Distance of the start's energy from the next separatrix at its |M|, over the range of energies there; NaN where there
/// is none (a sphere, M = 0, a rotor that leaves one component only).
inline double separatrix_distance(const Scene& scene) noexcept {
  const auto band = band_of(scene.problem(), level_of(scene.problem(), scene.problem().momentum));
  return band ? band->separatrix_distance() : nan<double>;
}

/// Numbers and warnings that belong to the scene, whichever rung answers.
template <class Elliptic>
void describe(Answer& answer, const Scene& scene) {
  const auto& problem = scene.problem();
  const bool control = scene.greatest_control() > 0;
  const bool total = problem.law == Law::total;
  const Vec3<double> end = total ? Vec3<double>(scene.R_BP() * -problem.gyro_rate()) : Vec3<double>(0, 0, 0);
  if (control) answer.quantities.push_back({"final_angular_velocity", 3, {end[0], end[1], end[2]}});
  answer.quantities.push_back({"small_parameter", 1, {small_parameter(scene)}});
  answer.quantities.push_back({"separatrix_distance", 1, {separatrix_distance(scene)}});

  const auto warn = [&](const char* code, const char* text, double value) {
    answer.warnings.push_back({code, text, value});
  };
  if (!control) warn("no-control", "no control torque acts: the motion decays at best, and never stops", nan<double>);
  else if (!Hold<double>(problem).holds)
    warn("does-not-stop", "the control cannot hold the carrier at rest against the drag of the stored momentum",
         problem.drag * problem.rotor_momentum.norm());
  else if (total && scene.has_rotor())
    warn("does-not-stop", "the law brings M to zero, not the carrier to rest: it ends turning at -J^-1 l",
         problem.gyro_rate().norm());
}

}  // namespace detail

template <class Elliptic>
Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  using DecelerationRung = Rung<Scene, Track>;
  static constexpr std::array<DecelerationRung, 4> rungs{{{"equal-torque", &detail::equal_torque<Elliptic>},
                                                          {"averaged", &detail::averaged<Elliptic>},
                                                          {"averaged-2", &detail::averaged_2<Elliptic>},
                                                          {"full", &full_track}}};
  Answer answer =
      climb<Scene, Track>(rungs, scene, scene.data().tolerance, rung_of(scene.data().model), monitor, refusal);
  if (refusal.code == Errc::ok) detail::describe<Elliptic>(answer, scene);
  return answer;
}

}  // namespace gyrostat::deceleration
