// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat::heavy {

struct Track;

/// The periodic motion that starts with the given rate about axis 3 and d = (+sqrt(1 - cos^2), 0, cos), all in principal axes.
struct Periodic {
  double spin;             ///< r at t = 0, rad/s
  double cos_inclination;  ///< d3 at t = 0, in (-1, 1)
};

/// What a motion starts from: a state, or a periodic motion whose start is to be found.
struct Start {
  State<double> state;  ///< body axes
  std::optional<Periodic> periodic{};
  bool oriented = false;  ///< down is taken from the attitude; so it is where the attitude is wanted
};

/// A state in other axes: v_new = R v for the body vectors.
template <Real Scalar>
State<Scalar> in_axes(const Mat3<Scalar>& R, const State<Scalar>& state) noexcept {
  return {R * state.angular_velocity, R * state.down, state.attitude * conjugate(from_matrix(R))};
}

/// The problem in principal axes, and the way back to the caller's body axes.
struct Body {
  Problem<double> problem;
  Mat3<double> R_BP = Mat3<double>::Identity();                   ///< principal axes to body axes
  Mat3<DoubleDouble> wide_R_BP = Mat3<DoubleDouble>::Identity();  ///< the same with more digits
  Mat3<double> inertia = Mat3<double>::Zero();  ///< as it was given, in body axes, where R_BP is not the identity

  /// In the principal axes nearest to the caller's. Errors: not_symmetric (beyond 8 eps of the largest entry), and those of
  /// Problem::make.
  GYROSTAT_COMPILED_ONCE static Result<Body> make(const Mat3<double>& inertia, double mass,
                                                  const Vec3<double>& centre_of_mass, double gravity,
                                                  double gradient) noexcept;
};

/// A valid scene, in principal axes.
class Scene {
 public:
  Scene() = default;

  /// Errors: not_finite; zero_vector (an attitude without length); out_of_domain (a down that is not of unit length within 1e-8, an
  /// inclination outside (-1, 1)); and what check_times finds.
  GYROSTAT_COMPILED_ONCE static Result<Scene> make(const Body& body, const Start& start, const Question& question);

  /// The same motion, asked otherwise; `question` must be one that make would take.
  Scene asked(const Question& question) const {
    Scene other = *this;
    other.question_ = question;
    other.question_.wants_attitude = question_.wants_attitude;
    return other;
  }

  const Problem<double>& problem() const noexcept { return body_.problem; }
  const Mat3<double>& R_BP() const noexcept { return body_.R_BP; }  ///< principal axes to body axes
  const Mat3<double>& given_inertia() const noexcept { return body_.inertia; }
  /// Principal axes; the attitude takes them to inertial ones.
  const State<double>& start() const noexcept { return start_; }
  /// The body comes from a tensor that is not diagonal; a start through it, or its down from an attitude. Conversions round.
  bool converts_body() const noexcept { return body_.R_BP != Mat3<double>::Identity(); }
  bool converts_start() const noexcept { return converts_body() || (given_.oriented && !given_.periodic); }
  /// Down was taken from the attitude.
  bool oriented() const noexcept { return given_.oriented; }
  /// As the caller gave it, but for the norm of the attitude.
  const State<double>& given() const noexcept { return given_.state; }
  const std::optional<Periodic>& periodic() const noexcept { return given_.periodic; }
  const Question& question() const noexcept { return question_; }
  /// What is asked of the columns.
  Goal<std::size(column_kinds)> goal() const noexcept {
    const double spin = given_.periodic ? given_.periodic->spin : start_.angular_velocity.norm();
    return Goal<std::size(column_kinds)>::of(question_, tables, scales(problem(), spin));
  }

  /// Solves the full equations in place of the library's Taylor series (cvode_motion.hpp); nullptr: Taylor.
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;

 private:
  Body body_;
  Start given_;
  State<double> start_;
  Question question_;
};

}  // namespace gyrostat::heavy

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/scene_definition.hpp"
#endif
