// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

struct Track;

/// A valid scene.
class Scene {
 public:
  Scene() = default;

  /// not_finite; not_positive (inertia, mass); triangle_inequality (beyond 8 eps); and what check_times finds.
  GYROSTAT_COMPILED_ONCE static Result<Scene> make(const Problem<double>& problem, const Question& question);

  /// The same motion, asked otherwise; `question` must be one that make would take.
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.question_ = question;
    return other;
  }

  const Problem<double>& problem() const noexcept { return problem_; }
  const Question& question() const noexcept { return question_; }
  /// What is asked of the columns.
  Goal<std::size(column_kinds)> goal() const noexcept {
    return Goal<std::size(column_kinds)>::of(question_, tables, scales(problem_, question_.times.back()));
  }

  /// Solves the full equations in place of the library's Taylor series (cvode_motion.hpp); nullptr: Taylor.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;

 private:
  Problem<double> problem_;
  Question question_;
};

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/scene_definition.hpp"
#endif
