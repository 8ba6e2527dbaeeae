// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "gyrostat/core/real.hpp"

namespace gyrostat {

template <Real Scalar>
using Vec3 = Eigen::Matrix<Scalar, 3, 1>;

template <Real Scalar>
using Mat3 = Eigen::Matrix<Scalar, 3, 3>;

/// Quaternion w + x i + y j + z k (Hamilton's product). As an attitude it has unit norm and takes body components to
/// inertial ones, v_I = q v_B q*; q and -q are the same attitude.
template <Real Scalar>
struct Quat {
  Scalar w = 1;
  Scalar x = 0;
  Scalar y = 0;
  Scalar z = 0;

  friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

}  // namespace gyrostat
