// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The symmetric part of a tensor that is symmetric within 8 eps of its largest entry. Errc::not_finite, not_symmetric.
template <Real Scalar>
Result<Mat3<Scalar>> symmetric_part(const Mat3<Scalar>& J) noexcept {
  if (!J.allFinite()) return Errc::not_finite;
  const Scalar slack = 8 * epsilon<Scalar> * J.cwiseAbs().maxCoeff();
  if ((J - J.transpose()).cwiseAbs().maxCoeff() > slack) return Errc::not_symmetric;
  return Mat3<Scalar>((J + J.transpose()) / 2);
}

/// J = R_BP diag(moments) R_BP^T.
template <Real Scalar>
struct PrincipalAxes {
  Vec3<Scalar> moments{1, 1, 1};
  Mat3<Scalar> R_BP = Mat3<Scalar>::Identity();  ///< principal axes to body axes, a proper rotation

  /// Of a tensor in body axes that is symmetric to rounding. The principal axes are the body's where the tensor is diagonal; else those of
  /// its eigenvectors that are nearest, axis by axis, whatever the order of the moments.
  static PrincipalAxes nearest(const Mat3<Scalar>& J) noexcept {
    PrincipalAxes made;
    made.moments = J.diagonal();
    if (J(0, 1) == 0 && J(0, 2) == 0 && J(1, 2) == 0) return made;
    const SymmetricEigen<Scalar> eigen = symmetric_eigen<Scalar>((J + J.transpose()) / 2);
    int order[3] = {0, 1, 2}, best[3] = {0, 1, 2};
    Scalar most = -1;
    for (int i = 0; i < 6; ++i) {
      const Scalar near =
          std::abs(eigen.axes(0, order[0])) + std::abs(eigen.axes(1, order[1])) + std::abs(eigen.axes(2, order[2]));
      if (near > most) most = near, std::copy(order, order + 3, best);
      std::next_permutation(order, order + 3);
    }
    for (int i = 0; i < 3; ++i) {
      made.moments[i] = eigen.values[best[i]];
      made.R_BP.col(i) = std::copysign(Scalar(1), eigen.axes(i, best[i])) * eigen.axes.col(best[i]);
    }
    const Vec3<Scalar> first = made.R_BP.col(0), second = made.R_BP.col(1);
    if (cross<Scalar>(first, second).dot(made.R_BP.col(2)) < 0) made.R_BP.col(1) *= -1;
    return made;
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
