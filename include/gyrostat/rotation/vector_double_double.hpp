// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <type_traits>

#include "gyrostat/core/double_double.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"

/// What Eigen asks of a scalar, so that Vec3<DoubleDouble> and its kin work.
template <>
struct Eigen::NumTraits<gyrostat::DoubleDouble> : Eigen::GenericNumTraits<gyrostat::DoubleDouble> {
  using Real = gyrostat::DoubleDouble;
  using NonInteger = gyrostat::DoubleDouble;
  using Nested = gyrostat::DoubleDouble;
  using Literal = gyrostat::DoubleDouble;
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 0,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 10
  };
  static Real epsilon() { return gyrostat::epsilon<Real>; }
  static Real dummy_precision() { return 64 * gyrostat::epsilon<Real>; }
  static Real highest() { return std::numeric_limits<Real>::max(); }
  static Real lowest() { return std::numeric_limits<Real>::lowest(); }
  static int digits10() { return std::numeric_limits<Real>::digits10; }
};

namespace gyrostat::inline GYROSTAT_LEVEL {

/// A scalar of more digits for what is to be right to those of Scalar where it cancels: that of double; others have none.
template <Real Scalar>
using Wider = std::conditional_t<std::same_as<Scalar, double>, DoubleDouble, Scalar>;

template <Real To, Real From>
Vec3<To> vector_cast(const Vec3<From>& v) noexcept {
  return {static_cast<To>(v[0]), static_cast<To>(v[1]), static_cast<To>(v[2])};
}

template <Real To, Real From>
Mat3<To> matrix_cast(const Mat3<From>& m) noexcept {
  Mat3<To> cast;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) cast(i, j) = static_cast<To>(m(i, j));
  return cast;
}

#ifdef GYROSTAT_COMPILED
extern template SymmetricEigen<DoubleDouble> symmetric_eigen<DoubleDouble>(const Mat3<DoubleDouble>&) noexcept;
#endif

}  // namespace gyrostat::inline GYROSTAT_LEVEL
