// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/fill.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"

namespace gyrostat::free {

/// The motion in closed form, and what is known of its errors.
struct ClosedForm {
  Motion<double> motion;
  MotionError<double> error;
  bool precise;  ///< set up to twice the digits
};

/// Of the scene's data to twice the digits; an error where the data fit no motion (Motion::make).
GYROSTAT_COMPILED_ONCE Result<ClosedForm> closed_form_of(const Scene& scene) noexcept;

/// The same in double for a tenth of the cost; nothing where its rounding may weigh (MotionError::quick), or the scalars need not be as well known as
/// is asked.
GYROSTAT_COMPILED_ONCE std::optional<ClosedForm> quick_form_of(const Scene& scene) noexcept;

/// What a rung finds at the asked times.
struct Track : Outcome {
  std::vector<State<double>> states;
  std::vector<Vec3<double>> turned;  ///< integral of omega since t = 0, body axes, rad; where a wheel needs it
  ColumnErrors<double> error;        ///< estimated greatest errors over the times, as the columns measure them
  std::optional<ClosedForm> form;    ///< of a rung that has it
};

/// Angle of a wheel in the body since t = 0, rad.
inline double rotor_angle(const Reduced<double>::Turning& wheel, double t, const Vec3<double>& turned) noexcept {
  return wheel.turns_freely ? wheel.rate * t - wheel.axis.dot(turned) : wheel.rate * t;
}

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track);

}  // namespace gyrostat::free

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/free/track_definition.hpp"
#endif
