// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>
#include <utility>

#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// S = axes diag(values) axes^T.
template <Real Scalar>
struct SymmetricEigen {
  Vec3<Scalar> values;  ///< ascending
  Mat3<Scalar> axes;    ///< columns: unit eigenvectors, a proper rotation
};

/// Eigenvalues and eigenvectors of a symmetric tensor, read from its lower triangle. A diagonal tensor gives its
/// entries and a signed permutation, both exact. The first two axes have their largest component positive; the third
/// completes the rotation. NaN where an entry is not finite.
template <Real Scalar>
SymmetricEigen<Scalar> symmetric_eigen(const Mat3<Scalar>& S) noexcept {
  SymmetricEigen<Scalar> result;
  if (!S.allFinite()) {
    result.values.setConstant(nan<Scalar>);
    result.axes.setConstant(nan<Scalar>);
    return result;
  }
  if (S(1, 0) == 0 && S(2, 0) == 0 && S(2, 1) == 0) {
    int order[3] = {0, 1, 2};
    const auto sort = [&](int i, int j) {
      if (S(order[j], order[j]) < S(order[i], order[i])) std::swap(order[i], order[j]);
    };
    sort(0, 1);
    sort(1, 2);
    sort(0, 1);
    result.axes.setZero();
    for (int i = 0; i < 3; ++i) {
      result.values[i] = S(order[i], order[i]);
      result.axes(order[i], i) = 1;
    }
  } else {
    const Eigen::SelfAdjointEigenSolver<Mat3<Scalar>> solver(S);
    result.values = solver.eigenvalues();
    result.axes = solver.eigenvectors();
    for (int i = 0; i < 2; ++i) {
      int largest = 0;
      result.axes.col(i).cwiseAbs().maxCoeff(&largest);
      if (result.axes(largest, i) < 0) result.axes.col(i) *= -1;
    }
  }
  const Vec3<Scalar> first = result.axes.col(0);
  const Vec3<Scalar> second = result.axes.col(1);
  if (cross<Scalar>(first, second).dot(result.axes.col(2)) < 0) result.axes.col(2) *= -1;
  return result;
}

#ifdef GYROSTAT_COMPILED
extern template SymmetricEigen<float> symmetric_eigen<float>(const Mat3<float>&) noexcept;
extern template SymmetricEigen<double> symmetric_eigen<double>(const Mat3<double>&) noexcept;
extern template SymmetricEigen<long double> symmetric_eigen<long double>(const Mat3<long double>&) noexcept;
#endif

}  // namespace gyrostat::inline GYROSTAT_LEVEL
