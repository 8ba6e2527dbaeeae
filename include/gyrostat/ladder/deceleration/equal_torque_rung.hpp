// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/orbit_kind.hpp"
#include "gyrostat/ladder/deceleration/track.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/models/deceleration/equal_torque.hpp"
#include "gyrostat/models/free/motion_error.hpp"

namespace gyrostat::deceleration {

/// How the free motion that a body under equal torques goes through is found, as little as what is asked needs.
enum class Unbraked : std::uint8_t {
  not_needed,  ///< columns that do not turn with the body follow from |M| alone
  in_double,   ///< M: set up in double, if the quick form of the free motion is sound there
  in_two,      ///< set up in double-double, with the error that neighbours show
};

/// What the rung will do for the scene.
GYROSTAT_COMPILED_ONCE Unbraked unbraked_motion(const Scene& scene) noexcept;

/// Rung `equal-torque`: one control torque for all axes and no rotor momentum; exact.
GYROSTAT_COMPILED_ONCE Track equal_torque_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/equal_torque_rung_definition.hpp"
#endif
