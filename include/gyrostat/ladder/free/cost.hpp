// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/free/full_rung.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"

/// What the rungs of the family `free` cost, s.
namespace gyrostat::free {

/// Where a set-up in double does, and where it does not.
inline constexpr FormulaCost quick_form_cost{15e-6, 0.06e-6}, closed_form_cost{140e-6, 0.06e-6};
/// Where the angles of wheels are asked: the neighbours' integrals, and a series at each time.
inline constexpr FormulaCost quick_angle_cost{200e-6, 0.5e-6}, rotor_angle_cost{500e-6, 0.5e-6};
inline constexpr SeriesCost series_cost{1e-6, 1.5e-6, 0.6e-6, 0.5};

namespace detail {

/// The angle that the body turns through up to the last time, rad.
inline double turned_angle(const Scene& scene) noexcept {
  return turning_rate(scene.principal()) * scene.question().times.back();
}

/// Whether the quick form will do: it states some hundred roundings, and some twenty a radian.
inline bool suits_quick_form(const Scene& scene) noexcept {
  return epsilon<double> * (300 + 20 * turned_angle(scene)) < scene.goal().tightest;
}

}  // namespace detail

inline double cost_of_closed_form(const Scene& scene) noexcept {
  const std::size_t times = scene.question().times.size();
  const bool quick = detail::suits_quick_form(scene);
  const double angles = scene.gives(column::rotor_angle) ? (quick ? quick_angle_cost : rotor_angle_cost)(times) : 0;
  return (quick ? quick_form_cost : closed_form_cost)(times) + angles;
}
/// With the closed form where scalars are told, which come from it.
inline double cost_of_full(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = detail::turned_angle(scene);
  const double tolerance = first_step_tolerance(scene.goal().tightest, phase, honesty::loosest_step);
  const double of_scalars = (detail::suits_quick_form(scene) ? quick_form_cost : closed_form_cost)(0);
  return series_cost(phase, tolerance, times.size()) + (tells_scalars(scene.question()) ? of_scalars : 0);
}

}  // namespace gyrostat::free
