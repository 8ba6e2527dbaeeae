// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::spinning {

/// One number for each column of an answer.
template <Real Scalar>
struct ColumnErrors {
  Scalar angular_velocity = 0;
  Scalar angles = 0;
  Scalar attitude = 0;
  Scalar momentum = 0;
  Scalar velocity = 0;
  Scalar position = 0;

  /// NaN if any is.
  Scalar greatest() const noexcept {
    Scalar most = 0;
    for (const Scalar e : {angular_velocity, angles, attitude, momentum, velocity, position})
      if (!(e <= most)) most = most == most ? e : most;
    return most;
  }
};

/// The distance of two motions, gathered time by time: greatest difference of each column, and its greatest norm in the first
/// motion.
template <Real Scalar>
class Comparison {
 public:
  void add(const State<Scalar>& first, const State<Scalar>& second) noexcept {
    const auto vector = [](Scalar& size, Scalar& difference, const Vec3<Scalar>& a, const Vec3<Scalar>& b) noexcept {
      raise(size, a.norm());
      raise(difference, (a - b).norm());
    };
    const auto angles = [](const Angles<Scalar>& a) noexcept { return Vec3<Scalar>(a.psi, a.phi, a.theta); };
    vector(size_.angular_velocity, difference_.angular_velocity, first.angular_velocity, second.angular_velocity);
    vector(size_.angles, difference_.angles, angles(first.angles), angles(second.angles));
    vector(size_.momentum, difference_.momentum, first.momentum_I, second.momentum_I);
    vector(size_.velocity, difference_.velocity, first.velocity, second.velocity);
    vector(size_.position, difference_.position, first.position, second.position);
    const Quat<Scalar> d = conjugate(first.attitude) * second.attitude;
    raise(difference_.attitude, 2 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w)));
  }

  /// In units of the columns.
  const ColumnErrors<Scalar>& difference() const noexcept { return difference_; }
  /// Greatest norms in the first motion; attitude: 1.
  const ColumnErrors<Scalar>& size() const noexcept { return size_; }

  /// `errors` (in units of the columns) over the sizes, 0/0 = 0.
  ColumnErrors<Scalar> relative(const ColumnErrors<Scalar>& errors) const noexcept {
    const auto over = [](Scalar error, Scalar size) noexcept { return error == 0 ? Scalar(0) : error / size; };
    return {over(errors.angular_velocity, size_.angular_velocity),
            over(errors.angles, size_.angles),
            errors.attitude,
            over(errors.momentum, size_.momentum),
            over(errors.velocity, size_.velocity),
            over(errors.position, size_.position)};
  }

 private:
  static void raise(Scalar& most, Scalar value) noexcept {
    if (!(value <= most)) most = most == most ? value : most;
  }

  ColumnErrors<Scalar> difference_{}, size_{0, 0, 1};
};

}  // namespace gyrostat::spinning
