// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>

#include "gyrostat/body/inertia.hpp"
#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::deceleration {

struct Track;

/// What acts on the body and how it starts, in body axes. Defaults describe a body left alone.
struct Setup {
  Vec3<double> rotor_momentum{0, 0, 0};  ///< l, relative to the carrier, N m s
  Vec3<double> control{0, 0, 0};         ///< eps b along the body axes, >= 0, N m
  double drag = 0;                       ///< eps lambda, >= 0, 1/s
  Law law = Law::total, drag_law = Law::total;
  Vec3<double> momentum{0, 0, 0};  ///< M at t = 0, N m s
  Quat<double> attitude{};         ///< body to inertial at t = 0, of unit norm
  /// omega at t = 0, rad/s, where it is what was given and momentum what follows from it, J omega + l: the motion starts from it.
  std::optional<Vec3<double>> angular_velocity{};
};

/// A valid scene: the problem in principal axes and the way back to the body axes.
class Scene {
 public:
  Scene() = default;

  /// not_finite, negative (control, drag), zero_vector (an attitude without length), out_of_domain (a momentum that is not that of the given
  /// angular velocity), beyond_range (moments or momentum), and what check_times finds.
  GYROSTAT_COMPILED_ONCE static Result<Scene> make(const Inertia<double>& body, const Setup& setup,
                                                   const Question& question);

  /// The same motion, asked otherwise; `question` must be one that make would take.
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.ask(question);
    return other;
  }

  const Problem<double>& problem() const noexcept { return problem_; }
  const Setup& setup() const noexcept { return setup_; }
  const Question& question() const noexcept { return question_; }
  /// What is asked of the columns.
  Goal<std::size(column_kinds)> goal() const noexcept {
    return Goal<std::size(column_kinds)>::of(question_, tables, scales(problem_));
  }
  /// Whether a stop time is asked for; and whether it has to be given wherever the stop lies.
  bool asks_for_stop() const noexcept { return aim_of(question_, tables, true, scalar::stop_time).has_value(); }
  bool needs_stop() const noexcept {
    return asks_for_stop() && aim_of(question_, tables, true, scalar::stop_time)->needed;
  }
  const Mat3<double>& inertia() const noexcept { return inertia_; }  ///< J, body axes, kg m^2
  const Mat3<double>& R_BP() const noexcept { return R_BP_; }        ///< principal axes to body axes

  /// Principal axes to inertial at t = 0.
  Quat<double> attitude() const noexcept { return setup_.attitude * from_matrix(R_BP_); }
  /// What the control opposes at t = 0, M or J omega, N m s.
  Vec3<double> opposed() const noexcept {
    const auto& p = problem_;
    return p.law == Law::total ? p.momentum : Vec3<double>(p.momentum - p.rotor_momentum);
  }
  bool has_rotor() const noexcept { return problem_.rotor_momentum.squaredNorm() > 0; }
  bool sphere() const noexcept { return problem_.inverse_inertia[0] == problem_.inverse_inertia[2]; }
  /// The control torques act along the principal axes.
  bool principal_control() const noexcept {
    const auto& c = problem_.control;
    return c(0, 1) == 0 && c(0, 2) == 0 && c(1, 2) == 0;
  }
  /// One control torque for all axes (none counts as equal).
  bool equal_control() const noexcept {
    return setup_.control[0] == setup_.control[1] && setup_.control[1] == setup_.control[2];
  }
  double greatest_control() const noexcept { return setup_.control.maxCoeff(); }
  double least_control() const noexcept { return setup_.control.minCoeff(); }

 private:
  void ask(const Question& question) {
    question_ = question;
    if (!question.asked.empty()) question_.wants_attitude = needs_column(question, tables, column::attitude);
  }

  Problem<double> problem_;
  Setup setup_;
  Question question_;
  Mat3<double> inertia_ = Mat3<double>::Identity(), R_BP_ = Mat3<double>::Identity();

 public:
  /// Solves the full equations in place of the library's Taylor series (cvode_motion.hpp); nullptr: Taylor.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;
};

/// Rotor momentum, or actuators off the principal axes: the orbit algorithm; otherwise the closed forms of Euler.
inline bool needs_orbit(const Scene& scene) noexcept { return scene.has_rotor() || !scene.principal_control(); }

/// Bounds of the rate at which the control brings down what it opposes near the goal, N m: a drag that acts on the other
/// momentum helps or hinders by drag |l|. The lower bound is 0 where the control may not get there.
struct FinalTorque {
  double least, greatest;
};

/// FinalTorque of a scene.
inline FinalTorque final_torque(const Scene& scene) noexcept {
  const auto& p = scene.problem();
  const double other = p.law == p.drag_law ? 0 : p.drag * p.rotor_momentum.norm();
  return {std::max(0.0, scene.least_control() - other), scene.greatest_control() + other};
}

/// The greatest torque of FinalTorque; 0 where no control acts.
inline double braking_torque(const Scene& scene) noexcept {
  return scene.greatest_control() > 0 ? final_torque(scene).greatest : 0.0;
}

/// mu = max(b, drag R) over the rotation rate times R (deceleration.md, section 1): relative change of M in one radian.
inline double small_parameter(const Scene& scene) noexcept {
  const auto& p = scene.problem();
  const double R = p.momentum.norm();
  const double rate = std::max(R * p.inverse_inertia[1], p.gyro_rate().norm());
  return std::max(scene.greatest_control(), p.drag * R) / (R * rate);
}

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/scene_definition.hpp"
#endif
