// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/free/closed_form_rung.hpp"
#include "gyrostat/ladder/free/full_rung.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"

/// What the rungs of the family `free` cost, s.
namespace gyrostat::free {

/// Of a regular precession; of states alone, in lanes; where a set-up in double does, where it does not, and beside a separatrix, where errors are
/// looked at in many places.
inline constexpr FormulaCost precession_cost{1.3e-6, 0.05e-6}, lanes_form_cost{5e-6, 0.06e-6},
    quick_form_cost{13e-6, 0.06e-6}, closed_form_cost{56e-6, 0.06e-6}, separatrix_form_cost{200e-6, 0.06e-6};
/// Where the angles of wheels that turn freely are asked: the neighbours' integrals, and Kronrod's rule at each time.
inline constexpr FormulaCost precession_angle_cost{1e-6, 0.1e-6}, quick_angle_cost{55e-6, 4e-6},
    rotor_angle_cost{90e-6, 4e-6};
inline constexpr SeriesCost series_cost{5e-6, 1.8e-6, 0.15e-6, 0.5};

namespace detail {

/// The angle that the body turns through up to the last time, rad.
inline double turned_angle(const Scene& scene) noexcept {
  return turning_rate(scene.principal()) * scene.question().times.back();
}

/// Whether the quick form will do, if there is one: it states some hundred roundings, and some twenty a radian.
inline bool suits_quick_form(const Scene& scene) noexcept {
  return epsilon<double> * (300 + 20 * turned_angle(scene)) < scene.goal().tightest;
}
/// How the closed form is set up.
enum class SetUp : std::uint8_t { precession, in_lanes, quick, precise, beside_separatrix };

/// Where a set-up in double does.
inline SetUp quick_set_up(const Scene& scene) noexcept {
  return asks_for_states(scene) ? SetUp::in_lanes : SetUp::quick;
}
/// Of a motion that QuickLanes takes that where it suits, else `precise`.
inline SetUp set_up_of(const Scene& scene) noexcept {
  const auto motion = Motion<double>::make(scene.gyrostat().problem);
  if (motion && motion->hyperbolic()) return SetUp::beside_separatrix;
  if (motion && motion->is_regular_precession() && motion->kind() != Kind::spherical) return SetUp::precession;
  const bool quick = suits_quick_form(scene) && motion && MotionError<double>::is_tame(*motion, scene.assembly());
  return quick ? quick_set_up(scene) : SetUp::precise;
}

inline FormulaCost cost_of_set_up(SetUp how) noexcept {
  constexpr FormulaCost costs[] = {precession_cost, lanes_form_cost, quick_form_cost, closed_form_cost,
                                   separatrix_form_cost};
  return costs[int(how)];
}
inline double cost_of_form(const Scene& scene, SetUp how) noexcept {
  const std::size_t times = scene.question().times.size();
  const FormulaCost& of_angles = how == SetUp::precession ? precession_angle_cost
                                 : how <= SetUp::quick    ? quick_angle_cost
                                                          : rotor_angle_cost;
  return cost_of_set_up(how)(times) + (scene.needs_turned() ? of_angles(times) : 0);
}

inline double cost_of_states(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = turned_angle(scene);
  const double tolerance = first_step_tolerance_of_phase(scene.goal().tightest, phase, honesty::loosest_step);
  return series_cost(phase, tolerance, times.size());
}

}  // namespace detail

inline double cost_of_closed_form(const Scene& scene) noexcept {
  return detail::cost_of_form(scene, detail::set_up_of(scene));
}
/// With the closed form where scalars are told, which come from it.
inline double cost_of_full(const Scene& scene) noexcept {
  const double of_scalars = tells_scalars(scene.question()) ? detail::cost_of_set_up(detail::set_up_of(scene))(0) : 0;
  return detail::cost_of_states(scene) + of_scalars;
}

}  // namespace gyrostat::free
