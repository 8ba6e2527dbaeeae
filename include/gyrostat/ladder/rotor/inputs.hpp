// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "gyrostat/body/inertia.hpp"
#include "gyrostat/ladder/inputs.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"
#include "gyrostat/models/rotor/assembly.hpp"

namespace gyrostat::rotor {

inline constexpr InputKind input_kinds[] = {{"body.inertia", 9},
                                            {"carrier.inertia", 9},
                                            {"carrier.mass", 1},
                                            {"rotor.axis", 3},
                                            {"rotor.axial_inertia", 1},
                                            {"rotor.mass", 1},
                                            {"rotor.equatorial_inertia", 1},
                                            {"rotor.offset", 3},
                                            {"motor.slope", 1},
                                            {"motor.no_load_rate", 1},
                                            {"initial.angular_velocity", 3},
                                            {"initial.rotor_rate", 1},
                                            {"initial.attitude", 4}};

/// The scene of the numbers of input_kinds; the inertia is given whole, or as carrier and rotor apart. Errors: those of
/// Inertia::from_tensor, Assembly::inertia, Gyrostat::make and Scene::make; out_of_domain: not so many numbers.
inline Result<Scene> scene_of(std::span<const double> numbers, const Question& question) {
  if (numbers.size() != input_width(input_kinds)) return Errc::out_of_domain;
  InputReader next(numbers);
  Mat3<double> whole = next.tensor();
  Assembly<double> parts;
  parts.carrier_inertia = next.tensor();
  parts.carrier_mass = next.number();
  parts.axis = next.direction();
  parts.axial_inertia = next.number();
  parts.rotor_mass = next.number();
  parts.equatorial_inertia = next.number();
  parts.offset = next.vector();
  if (!is_given(whole)) {
    if (const Errc wrong = Inertia<double>::check_tensor(parts.carrier_inertia); wrong != Errc::ok) return wrong;
    const auto together = parts.inertia();
    if (!together) return together.error();
    whole = *together;
  }
  if (const Errc wrong = Inertia<double>::check_tensor(whole); wrong != Errc::ok) return wrong;
  const double slope = next.number(), no_load_rate = next.number();
  const auto gyrostat =
      Gyrostat<double>::make(*symmetric_part<double>(whole), parts.axis, parts.axial_inertia, slope, no_load_rate);
  if (!gyrostat) return gyrostat.error();
  Start start;
  start.angular_velocity = next.vector();
  start.rotor_rate = next.number();
  start.attitude = next.quaternion();
  return Scene::make(*gyrostat, start, question);
}

}  // namespace gyrostat::rotor
