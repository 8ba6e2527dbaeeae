// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The symmetric part of a tensor that is symmetric within 8 eps of its largest entry. Errc::not_finite, not_symmetric.
template <Real Scalar>
Result<Mat3<Scalar>> symmetric_part(const Mat3<Scalar>& J) noexcept {
  if (!J.allFinite()) return Errc::not_finite;
  const Scalar slack = 8 * epsilon<Scalar> * J.cwiseAbs().maxCoeff();
  if ((J - J.transpose()).cwiseAbs().maxCoeff() > slack) return Errc::not_symmetric;
  return Mat3<Scalar>((J + J.transpose()) / 2);
}

/// J = R_BP diag(moments) R_BP^T, all to rounding of its own where the tensor is taken to be exact: with the digits of a double alone axes of
/// nearly equal moments are off by as much as a rounding of the greatest element turns them, and so are the differences of the moments.
template <Real Scalar>
struct PrincipalAxes {
  Vec3<Scalar> moments{1, 1, 1};
  Mat3<Scalar> R_BP = Mat3<Scalar>::Identity();  ///< principal axes to body axes, a proper rotation
  Vec3<Scalar> gaps{0, 0, 0};  ///< the first moment less the second, second less third, first less third

  /// Of a tensor in body axes that is symmetric to rounding. The principal axes are the body's where the tensor is diagonal; else those of
  /// its eigenvectors that are nearest, axis by axis, whatever the order of the moments.
  static PrincipalAxes nearest(const Mat3<Scalar>& J) noexcept { return nearest_of(matrix_cast<Wider<Scalar>>(J)); }

  /// The same of one with more digits.
  static PrincipalAxes nearest_of(const Mat3<Wider<Scalar>>& J) noexcept {
    using std::abs;
    using Wide = Wider<Scalar>;
    PrincipalAxes made;
    if (J(0, 1) == 0 && J(0, 2) == 0 && J(1, 2) == 0) {
      made.take(J.diagonal());
      return made;
    }
    const SymmetricEigen<Wide> eigen = symmetric_eigen<Wide>((J + J.transpose()) / 2);
    const Mat3<Scalar> axes = matrix_cast<Scalar>(eigen.axes);
    int order[3] = {0, 1, 2}, best[3] = {0, 1, 2};
    Scalar most = -1;
    for (int i = 0; i < 6; ++i) {
      const Scalar near = abs(axes(0, order[0])) + abs(axes(1, order[1])) + abs(axes(2, order[2]));
      if (near > most) most = near, std::copy(order, order + 3, best);
      std::next_permutation(order, order + 3);
    }
    for (int i = 0; i < 3; ++i) made.R_BP.col(i) = Scalar(axes(i, best[i]) < 0 ? -1 : 1) * axes.col(best[i]);
    made.take({eigen.values[best[0]], eigen.values[best[1]], eigen.values[best[2]]});
    const Vec3<Scalar> first = made.R_BP.col(0), second = made.R_BP.col(1);
    if (cross<Scalar>(first, second).dot(made.R_BP.col(2)) < 0) made.R_BP.col(1) *= -1;
    return made;
  }

 private:
  void take(const Vec3<Wider<Scalar>>& J) noexcept {
    moments = vector_cast<Scalar>(J);
    gaps = {static_cast<Scalar>(J[0] - J[1]), static_cast<Scalar>(J[1] - J[2]), static_cast<Scalar>(J[0] - J[2])};
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
