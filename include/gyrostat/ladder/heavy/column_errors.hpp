// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::heavy {

/// One number for each column of an answer.
template <Real Scalar>
struct ColumnErrors {
  Scalar angular_velocity = 0;
  Scalar down = 0;
  Scalar attitude = 0;

  /// NaN if any is.
  Scalar greatest() const noexcept {
    Scalar most = 0;
    for (const Scalar e : {angular_velocity, down, attitude})
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
    raise(size_.angular_velocity, first.angular_velocity.norm());
    raise(size_.down, first.down.norm());
    raise(difference_.angular_velocity, (first.angular_velocity - second.angular_velocity).norm());
    raise(difference_.down, (first.down - second.down).norm());
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
    return {over(errors.angular_velocity, size_.angular_velocity), over(errors.down, size_.down), errors.attitude};
  }

 private:
  static void raise(Scalar& most, Scalar value) noexcept {
    if (!(value <= most)) most = most == most ? value : most;
  }

  ColumnErrors<Scalar> difference_{}, size_{0, 0, 1};
};

}  // namespace gyrostat::heavy
