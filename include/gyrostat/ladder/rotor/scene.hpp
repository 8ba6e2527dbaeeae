// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

struct Track;

/// What moves at t = 0, in body axes.
struct Start {
  Quat<double> attitude{};                 ///< body to inertial, of unit norm
  Vec3<double> angular_velocity{0, 0, 0};  ///< Omega of the carrier, rad/s
  double rotor_rate = 0;                   ///< omega, relative to the carrier, rad/s
};

/// A valid scene.
class Scene {
 public:
  Scene() = default;

  /// not_finite; zero_vector (an attitude without length); beyond_range (moments, momentum or rates); and what check_times finds.
  GYROSTAT_COMPILED_ONCE static Result<Scene> make(const Gyrostat<double>& gyrostat, const Start& start,
                                                   const Question& question);

  /// The same motion, asked otherwise; `question` must be one that make would take.
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.question_ = question;
    return other;
  }

  const Gyrostat<double>& gyrostat() const noexcept { return gyrostat_; }
  /// As the caller gave it, but for the norm of the attitude.
  const Start& given() const noexcept { return given_; }
  const State<double>& start() const noexcept { return start_; }
  const Question& question() const noexcept { return question_; }
  /// What is asked of the columns.
  Goal<std::size(column_kinds)> goal() const noexcept {
    return Goal<std::size(column_kinds)>::of(question_, tables, scales(gyrostat_, start_));
  }

  /// Solves the full equations in place of the library's own integrators (cvode_motion.hpp); nullptr: its own.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;

 private:
  Gyrostat<double> gyrostat_;
  Start given_;
  State<double> start_;
  Question question_;
};

}  // namespace gyrostat::rotor

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/rotor/scene_definition.hpp"
#endif
