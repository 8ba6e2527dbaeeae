// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

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
  static Result<Scene> make(const Problem<double>& problem, const Question& question) {
    const auto& p = problem;
    const auto& a = p.angles;
    if (!p.inertia.allFinite() || !p.torque.allFinite() || !p.force.allFinite() || !p.angular_velocity.allFinite() ||
        !p.velocity.allFinite() || !p.position.allFinite() || !std::isfinite(p.mass) ||
        !std::isfinite(p.rotor_momentum) || !std::isfinite(p.charge_momentum) || !std::isfinite(a.psi) ||
        !std::isfinite(a.phi) || !std::isfinite(a.theta))
      return Errc::not_finite;
    if (!(p.mass > 0) || !(p.inertia.minCoeff() > 0)) return Errc::not_positive;
    const double most = p.inertia.maxCoeff();
    if (most > (p.inertia.sum() - most) + 8 * epsilon<double> * most) return Errc::triangle_inequality;
    if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
    Scene scene;
    scene.problem_ = problem;
    scene.question_ = question;
    return scene;
  }

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
