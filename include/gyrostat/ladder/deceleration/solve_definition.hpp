// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "gyrostat/ladder/deceleration/averaged_rung.hpp"
#include "gyrostat/ladder/deceleration/cost.hpp"
#include "gyrostat/ladder/deceleration/equal_torque_rung.hpp"
#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/ladder/deceleration/orbit_rung.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"

namespace gyrostat::deceleration {

namespace detail {

template <class Elliptic>
Track averaged(const Scene& scene, Monitor* monitor) {
  return needs_orbit(scene) ? orbit_averaged_track<Elliptic>(scene, monitor) : averaged_track<Elliptic>(scene);
}
template <class Elliptic>
Track averaged_2(const Scene& scene, Monitor* monitor) {
  return needs_orbit(scene) ? orbit_averaged_2_track<Elliptic>(scene, monitor)
                            : averaged_2_track<Elliptic>(scene, monitor);
}

}  // namespace detail

/// Numbers and warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  const auto& problem = scene.problem();
  const bool control = scene.greatest_control() > 0;
  const bool total = problem.law == Law::total;
  const Vec3<double> end = total ? Vec3<double>(scene.R_BP() * -problem.gyro_rate()) : Vec3<double>(0, 0, 0);
  const auto tell = [&](std::size_t which, std::array<double, 3> values) {
    answer.quantities.push_back({&scalar_kinds[which], values});
  };
  const Hold<double> hold(problem);
  const bool stops = hold.may_stop() && (hold.weakest > 0 || std::isfinite(track.stop_time));
  if (control && stops) tell(scalar::final_angular_velocity, {end[0], end[1], end[2]});
  tell(scalar::small_parameter, {small_parameter(scene)});
  tell(scalar::separatrix_distance, {detail::separatrix_distance(scene)});

  const auto warn = [&](std::size_t which, double value, const char* text = nullptr) {
    answer.warnings.push_back({&warning_kinds[which], text ? text : warning_kinds[which].text, value});
  };
  if (!control) {
    if (track.stop_time != 0) warn(warning::no_control, nan<double>);
  } else if (!hold.holds) {
    warn(warning::does_not_stop, problem.drag * problem.rotor_momentum.norm(),
         total ? "the control cannot hold the momentum at zero against the drag of the carrier, which turns there"
               : "the control cannot hold the carrier at rest against the drag of the stored momentum");
  } else if (!hold.comes || std::isinf(track.stop_time)) {
    warn(warning::does_not_stop, nan<double>,
         "the control leaves an axis alone, about which the body turns on for ever");
  } else if (total && scene.has_rotor()) {
    warn(warning::does_not_stop, problem.gyro_rate().norm(),
         hold.weakest > 0 ? nullptr
                          : "the control leaves an axis alone, along which M may stay; at best the carrier ends "
                            "turning at -J^-1 l");
  }
}

namespace detail {

template <class Elliptic>
inline constexpr Rung<Scene, Track> models[] = {{&equal_torque_track, &cost_of_equal_torque},
                                                {&averaged<Elliptic>, &cost_of_averaged},
                                                {&averaged_2<Elliptic>, &cost_of_averaged_2},
                                                {&full_track, &cost_of_full}};

}  // namespace detail

template <class Elliptic>
Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, detail::models<Elliptic>, scene, monitor, refusal);
}

}  // namespace gyrostat::deceleration
