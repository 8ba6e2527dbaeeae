// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/general/instances.hpp"
#include "gyrostat/ladder/general/motion.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/full.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/torque_law.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/euler.hpp"

namespace gyrostat::general {

namespace detail {

/// The sum of the sizes of all torques at t, N m.
GYROSTAT_COMPILED_ONCE double sum_of_torques(const Problem<double>& problem, const Pose<double>& pose,
                                             double t) noexcept;
/// The same with the sizes of what their factors and tables are sums of: what the rounding of the torques is relative to, N m.
GYROSTAT_COMPILED_ONCE double terms_of_torques(const Problem<double>& problem, const Pose<double>& pose,
                                               double t) noexcept;

}  // namespace detail

/// By how much the start may be off where it was not given but computed: absolute, each the length of an error
/// of any direction.
struct StartError {
  double attitude = 0;          ///< rad
  double angular_velocity = 0;  ///< rad/s
  double rotor_rate = 0;        ///< over the wheels, rad/s
  double rotor_angle = 0;       ///< over the wheels, rad
  double velocity = 0;          ///< m/s
  double position = 0;          ///< m

  bool any() const noexcept {
    return attitude > 0 || angular_velocity > 0 || rotor_rate > 0 || rotor_angle > 0 || velocity > 0 || position > 0;
  }
};

struct Track;

/// A valid scene: what is given, body and wheels reduced, the torques summed, and the families that it is an instance of.
class Scene {
 public:
  Scene() = default;

  /// What check_times() and check() find, which says in words what is wrong, and with which wheel or torque; beyond_range (moments, or the rate that the body could come to). recognised: look for families.
  GYROSTAT_COMPILED_ONCE static Result<Scene> make(const Problem<double>& problem, const Question& question,
                                                   bool recognised = true);

  /// The same motion, asked otherwise; `question` must be one that make would take, with the same last time.
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.question_ = question;
    return other;
  }

  /// What is asked, of the same body from another start, or under other torques.
  Result<Scene> with(const Problem<double>& problem) const {
    auto made = make(problem, question_, recognised_);
    if (!made) return made;
    Scene other = made->driven_by(own_torque_);
    other.euler_ = euler_, other.full_equations = full_equations;
    return other;
  }

  /// The same scene, its start known to within an error.
  Scene known_within(const StartError& error) const {
    Scene other = *this;
    other.start_error_ = error;
    return other;
  }

  /// The same scene, with a column of angles in this sequence.
  Scene told_by(const EulerAxes& euler) const {
    Scene other = *this;
    other.euler_ = euler;
    return other;
  }

  /// The same scene under a torque of the caller's own, too: no family knows it, and none is looked for.
  Scene driven_by(const OwnTorque& torque) const {
    Scene other = *this;
    other.own_torque_ = torque;
    if (torque.any()) other.recognised_ = false, other.instances_ = {};
    return other;
  }

  /// Solves the full equations instead of Taylor series and Radau.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;

  const Problem<double>& problem() const noexcept { return problem_; }
  /// What acts beside the torques of the problem; none by default.
  const OwnTorque& own_torque() const noexcept { return own_torque_; }
  /// All external torque on the body, N m.
  Vec3<double> torque(double t, const Seen<double>& seen) const noexcept {
    return load_at(problem_, seen, t, t).torque + own_torque_(t, seen);
  }
  /// The sequence of the column `euler`, where there is one.
  const std::optional<EulerAxes>& euler() const noexcept { return euler_; }
  const StartError& start_error() const noexcept { return start_error_; }
  const Wheels<double>& wheels() const noexcept { return wheels_; }
  const Sizes<double>& sizes() const noexcept { return sizes_; }
  /// The full equations have states beside attitude, momentum and the turn of the body.
  bool is_large() const noexcept { return large_; }
  /// Wheels settle so fast that the full equations are solved by collocation.
  bool is_stiff() const noexcept { return stiff_; }
  /// The greatest rate at which wheels settle, 1/s.
  double settling_rate() const noexcept { return settling_rate_; }
  /// Times at which a law changes.
  std::size_t breaks() const noexcept { return breaks_; }
  /// What is asked of the columns.
  Goal<std::size(column_kinds)> goal() const noexcept {
    return Goal<std::size(column_kinds)>::of(question_, tables, scales());
  }
  const Instances& instances() const noexcept { return instances_; }
  /// Whether families are looked for.
  bool is_recognised() const noexcept { return recognised_; }
  const Question& question() const noexcept { return question_; }

  /// The scales of the columns, in their units.
  GYROSTAT_COMPILED_ONCE ColumnErrors scales() const noexcept;

  /// Whether the scene has the column at all.
  bool has_column(std::size_t column) const noexcept {
    switch (column) {
      case column::rotor_rate:
      case column::rotor_angle: return wheels_.count > 0;
      case column::velocity:
      case column::position: return !problem_.fixed;
      case column::attitude_orbit: return problem_.orbit.has_value();
      case column::down: return has_vertical();
      case column::euler: return euler_.has_value();
      default: return true;
    }
  }
  /// Whether a column is asked for, and the scene has it.
  bool gives(std::size_t column) const noexcept {
    const bool all = question_.asked.empty() && question_.rung != any_rung;
    return (all || aim_of(question_, tables, false, column)) && has_column(column);
  }
  /// A torque or a force knows what is down.
  bool has_vertical() const noexcept {
    return std::any_of(problem_.torques.begin(), problem_.torques.end(), [](const Torque<double>& torque) {
      return torque.type == TorqueType::weight || (torque.type == TorqueType::gravity_gradient && torque.gradient);
    });
  }

 private:
  Problem<double> problem_;
  OwnTorque own_torque_;
  StartError start_error_;
  std::optional<EulerAxes> euler_;
  Wheels<double> wheels_;
  Sizes<double> sizes_;
  bool large_ = false, stiff_ = false, recognised_ = false;
  double settling_rate_ = 0;
  std::size_t breaks_ = 0;
  Instances instances_;
  Question question_;
};

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/scene_definition.hpp"
#endif
