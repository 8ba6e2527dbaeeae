// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/free/motion.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/free/reduced.hpp"

namespace gyrostat::free {

/// A cone about an axis of the body, and a direction of space that may be in it.
struct ViewRequest {
  Vec3<double> axis{0, 0, 1};       ///< unit, body axes
  Vec3<double> direction{1, 0, 0};  ///< unit, inertial axes
  double half_angle = 0;            ///< rad, in [0, pi]
};

/// A valid scene: body and wheels as given, and the gyrostat that they come to.
class Scene {
 public:
  Scene() = default;

  /// What Reduced::of and check_times find; beyond_range (moments or momentum); `unsound` tells which wheel is.
  GYROSTAT_COMPILED_ONCE static Result<Scene> make(const Assembly<double>& assembly, const Question& question,
                                                   UnsoundWheel<double>* unsound = nullptr);

  /// The same motion, asked otherwise; `question` must be one that make would take.
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.question_ = question;
    return other;
  }

  /// The same scene, with what a view asks for; nothing: without. Errors: not_finite, zero_vector, and out_of_domain where a direction is not of unit length
  /// within 1e-8 or the angle leaves [0, pi].
  Result<Scene> viewed(const std::optional<ViewRequest>& view) const {
    if (view) {
      const double lengths[] = {view->axis.norm(), view->direction.norm()};
      if (!std::isfinite(lengths[0] + lengths[1] + view->half_angle)) return Errc::not_finite;
      for (const double length : lengths)
        if (length == 0) return Errc::zero_vector;
        else if (std::abs(length - 1) > 1e-8 + 4 * epsilon<double>) return Errc::out_of_domain;
      if (!(view->half_angle >= 0 && view->half_angle <= pi<double>)) return Errc::out_of_domain;
    }
    Scene other = *this;
    other.view_ = view;
    return other;
  }

  const Assembly<double>& assembly() const noexcept { return assembly_; }
  const Reduced<double>& gyrostat() const noexcept { return gyrostat_; }
  /// The same in its principal axes.
  const PrincipalProblem<double>& principal() const noexcept { return principal_; }
  /// The same to twice the digits, of the data as they are.
  Reduced<DoubleDouble> precise() const { return Reduced<DoubleDouble>::taken(assembly_); }
  const std::optional<ViewRequest>& view() const noexcept { return view_; }
  const Question& question() const noexcept { return question_; }
  std::size_t wheels() const noexcept { return gyrostat_.wheels.size(); }
  /// The angle of a wheel is told that turns freely: it hangs on the integral of omega. That of a held one is its rate times time.
  bool needs_turned() const noexcept {
    return gives(column::rotor_angle) && std::any_of(gyrostat_.wheels.begin(), gyrostat_.wheels.end(),
                                                     [](const auto& wheel) { return wheel.turns_freely; });
  }

  /// What moves at t = 0: omega, rad/s, and M, N m s.
  GYROSTAT_COMPILED_ONCE Vec3<double> angular_velocity() const noexcept;
  Vec3<double> angular_momentum() const noexcept { return gyrostat_.problem.momentum(); }

  /// The scales of the columns, in their units.
  ColumnErrors<double> scales() const noexcept {
    constexpr double least = 1e-3;
    double fastest = angular_velocity().norm();
    for (const auto& wheel : assembly_.wheels) fastest = std::max(fastest, std::abs(wheel.rate));
    ColumnErrors<double> scale;
    scale[column::angular_momentum] = least * gyrostat_.problem.rotor_momentum.norm();
    scale[column::rotor_rate] = least * fastest;
    scale[column::rotor_angle] = least;
    return scale;
  }
  /// What is asked of the columns.
  Goal<std::size(column_kinds)> goal() const noexcept {
    return Goal<std::size(column_kinds)>::of(question_, tables, scales());
  }
  /// Whether a column is asked for, and the scene has it.
  bool gives(std::size_t column) const noexcept {
    const bool all = question_.asked.empty() && question_.rung != any_rung;
    return (all || aim_of(question_, tables, false, column)) &&
           (tables.columns[column].width != per_rotor || wheels() > 0);
  }

 private:
  Assembly<double> assembly_;
  Reduced<double> gyrostat_;
  PrincipalProblem<double> principal_;
  std::optional<ViewRequest> view_;
  Question question_;
};

}  // namespace gyrostat::free

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/free/scene_definition.hpp"
#endif
