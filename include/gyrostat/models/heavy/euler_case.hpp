// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/motion_error.hpp"
#include "gyrostat/models/heavy/aligned_attitude.hpp"
#include "gyrostat/models/heavy/exact_error.hpp"
#include "gyrostat/models/heavy/problem.hpp"

namespace gyrostat::heavy {

/// The motion without torque (Euler, Poinsot): the free motion about O (docs/heavy.md, section 7; docs/free.md). Moments in any order and
/// equal ones too.
template <Real Scalar>
class EulerCase {
 public:
  EulerCase() = default;

  /// No torque acts: no weight off O, and no gradient but on a sphere.
  static bool holds(const Problem<Scalar>& problem) noexcept {
    const Vec3<Scalar>& I = problem.inertia();
    return (problem.moment().array() == 0).all() && (problem.gradient() == 0 || I.maxCoeff() == I.minCoeff());
  }

  /// Errors: not_applicable; not_finite; zero_vector; those of free::Motion::make. The start is aligned().
  static Result<EulerCase> make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept;

  State<Scalar> at(Scalar t) const noexcept {
    const auto now = motion_.at(t);
    return {now.angular_velocity, rotate<Scalar>(conjugate(now.attitude), {0, 0, -1}), now.attitude};
  }

  /// Bound of the error of at() up to time |t|, infinite where the data do not fix the phase. Found anew at each call, from neighbours
  /// (free::MotionError): 0.1 ms.
  ExactError<Scalar> error(Scalar t) const noexcept;

  math::Modulus<Scalar> modulus() const noexcept { return motion_.modulus(); }
  /// Of the angular velocity in the body, s; infinite on the separatrix and in a permanent rotation.
  Scalar period() const noexcept { return motion_.kind() == free::Kind::steady ? infinity<Scalar> : motion_.period(); }

 private:
  using Motion = free::Motion<Scalar>;

  free::Assembly<Scalar> given_;
  Motion motion_;
};

template <Real Scalar>
Result<EulerCase<Scalar>> EulerCase<Scalar>::make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
  if (!holds(problem)) return Errc::not_applicable;
  const auto from = aligned(start);
  if (!from) return from.error();
  EulerCase made;
  made.given_.body =
      free::Problem<Scalar>::from_moments(problem.inertia(), {0, 0, 0}, from->angular_velocity, from->attitude);
  const auto motion = Motion::template make<DoubleDouble>(made.given_.body.template cast<DoubleDouble>());
  if (!motion) return motion.error();
  made.motion_ = *motion;
  return made;
}

template <Real Scalar>
ExactError<Scalar> EulerCase<Scalar>::error(Scalar t) const noexcept {
  const auto known = free::MotionError<Scalar>::template of<DoubleDouble>(motion_, given_, free::Data::rounded, t);
  const auto bound = known.at(t);
  const Scalar angle = bound.attitude + 8 * epsilon<Scalar>;  // of the alignment
  return {angle, angle, bound.angular_velocity * known.fastest()};
}

#ifdef GYROSTAT_COMPILED
extern template class EulerCase<double>;
#endif

}  // namespace gyrostat::heavy
