// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/body/principal_axes.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The inertia of a rigid body about a point of it, kg m^2: what exists is physical. Principal moments A >= B >= C > 0
/// with A <= B + C, and the rotation that takes principal components to those in the caller's body axes.
template <Real Scalar>
class Inertia {
 public:
  /// The unit sphere.
  Inertia() = default;

  /// Moments about the three body axes, in any order; body axes are principal. Errc::not_finite, not_positive, or
  /// triangle_inequality where one exceeds the sum of the two others by more than 8 eps (equality is a lamina).
  static Result<Inertia> from_moments(Scalar about_1, Scalar about_2, Scalar about_3) noexcept {
    return from_tensor(Vec3<Scalar>(about_1, about_2, about_3).asDiagonal());
  }

  /// A tensor in body axes, symmetric within 8 eps of its largest entry; its symmetric part is kept. Errors as for
  /// moments, and Errc::not_symmetric.
  static Result<Inertia> from_tensor(const Mat3<Scalar>& J_B) noexcept {
    const Result<Mat3<Scalar>> symmetric = symmetric_part<Scalar>(J_B);
    if (!symmetric) return symmetric.error();
    Inertia inertia;
    inertia.tensor_ = *symmetric;
    if (inertia.has_exact_moments()) inertia.take(symmetric_eigen<Scalar>(-inertia.tensor_));
    else inertia.take(symmetric_eigen<Wider<Scalar>>(-matrix_cast<Wider<Scalar>>(inertia.tensor_)));
    if (const Errc wrong = error_of(inertia.principal_); wrong != Errc::ok) return wrong;
    return inertia;
  }

  /// What from_tensor has against a tensor.
  static Errc check_tensor(const Mat3<Scalar>& J_B) noexcept {
    const Result<Mat3<Scalar>> symmetric = symmetric_part<Scalar>(J_B);
    return symmetric ? error_of(-symmetric_eigen<Scalar>(-*symmetric).values) : symmetric.error();
  }

  /// (A, B, C), descending, kg m^2.
  const Vec3<Scalar>& principal() const noexcept { return principal_; }

  /// (1/A, 1/B, 1/C), ascending, 1/(kg m^2).
  Vec3<Scalar> inverse_principal() const noexcept { return principal_.cwiseInverse(); }

  /// (1/B - 1/A, 1/C - 1/B, 1/C - 1/A), 1/(kg m^2), from the differences of the moments: right to rounding of their own also where two are
  /// nearly equal, if the tensor is exact.
  Vec3<Scalar> inverse_gaps() const noexcept {
    const Scalar A = principal_[0], B = principal_[1], C = principal_[2];
    return {gaps_[0] / A / B, gaps_[1] / B / C, gaps_[2] / A / C};
  }

  /// The body axes are principal: the moments are those given, to the last bit.
  bool has_exact_moments() const noexcept { return tensor_(0, 1) == 0 && tensor_(0, 2) == 0 && tensor_(1, 2) == 0; }

  /// R_BP: v_B = R_BP v_P, columns are the principal axes 1, 2, 3 in body axes. A proper rotation; for moments and
  /// diagonal tensors a signed permutation, exact, and the identity where they already descend.
  const Mat3<Scalar>& R_BP() const noexcept { return axes_; }

  /// Principal components of a vector in body axes, by axes known to twice the digits: a rounded R_BP leaks large components into small
  /// ones, as into the momentum of a slim body across its axis.
  Vec3<Wider<Scalar>> in_principal_axes(const Vec3<Wider<Scalar>>& v_B) const noexcept {
    using Wide = Wider<Scalar>;
    const Mat3<Wide> R_PB = (matrix_cast<Wide>(axes_) + matrix_cast<Wide>(axes_low_)).transpose();
    return R_PB * v_B;
  }

  /// J in body axes.
  const Mat3<Scalar>& tensor() const noexcept { return tensor_; }

 private:
  static Errc error_of(const Vec3<Scalar>& moments) noexcept {
    if (!(moments[2] > 0)) return Errc::not_positive;
    if (!(moments[0] - moments[1] <= moments[2] + 8 * epsilon<Scalar> * moments[0])) return Errc::triangle_inequality;
    return Errc::ok;
  }

  /// Of the negative tensor.
  template <Real Wide>
  void take(const SymmetricEigen<Wide>& e) noexcept {
    principal_ = -vector_cast<Scalar>(e.values);
    axes_ = matrix_cast<Scalar>(e.axes);
    axes_low_ = matrix_cast<Scalar, Wide>(e.axes - matrix_cast<Wide>(axes_));
    gaps_ = {static_cast<Scalar>(e.values[1] - e.values[0]), static_cast<Scalar>(e.values[2] - e.values[1]),
             static_cast<Scalar>(e.values[2] - e.values[0])};
  }

  Vec3<Scalar> principal_ = Vec3<Scalar>::Ones();
  Vec3<Scalar> gaps_ = Vec3<Scalar>::Zero();
  Mat3<Scalar> axes_ = Mat3<Scalar>::Identity(), axes_low_ = Mat3<Scalar>::Zero();
  Mat3<Scalar> tensor_ = Mat3<Scalar>::Identity();
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
