// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

/// One number for each column of an answer.
template <Real Scalar>
struct ColumnErrors {
  Scalar attitude = 0;
  Scalar angular_velocity = 0;
  Scalar angular_momentum = 0;
  Scalar rotor_rate = 0;
  Scalar rotor_angle = 0;
  Scalar lyapunov = 0;

  /// NaN if any is.
  Scalar greatest() const noexcept {
    Scalar most = 0;
    for (const Scalar e : {attitude, angular_velocity, angular_momentum, rotor_rate, rotor_angle, lyapunov})
      if (!(e <= most)) most = most == most ? e : most;
    return most;
  }
};

/// The angle of the rotation between two attitudes, rad; the signs of the quaternions do not matter.
template <Real Scalar>
Scalar angle_between(const Quat<Scalar>& p, const Quat<Scalar>& q) noexcept {
  const Quat<Scalar> d = conjugate(p) * q;
  return 2 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w));
}

/// The distance of two motions, gathered time by time: greatest difference of each column, and its greatest norm in the first
/// motion.
template <Real Scalar>
class Comparison {
 public:
  explicit Comparison(const Gyrostat<Scalar>& gyrostat) noexcept : gyrostat_(gyrostat) {}

  void add(const State<Scalar>& first, const State<Scalar>& second) noexcept {
    const Vec3<Scalar> Omega = gyrostat_.angular_velocity(first.momentum, first.axial_momentum);
    const Vec3<Scalar> Omega_2 = gyrostat_.angular_velocity(second.momentum, second.axial_momentum);
    const Scalar rate = gyrostat_.rotor_rate(first.axial_momentum, Omega);
    const Scalar V = gyrostat_.lyapunov(first.momentum, first.axial_momentum);
    raise(size_.angular_velocity, Omega.norm());
    raise(size_.angular_momentum, first.momentum.norm());
    raise(size_.rotor_rate, std::abs(rate));
    raise(size_.rotor_angle, std::abs(first.rotor_angle));
    raise(size_.lyapunov, V);
    raise(difference_.attitude, angle_between(first.attitude, second.attitude));
    raise(difference_.angular_velocity, (Omega - Omega_2).norm());
    raise(difference_.angular_momentum, (first.momentum - second.momentum).norm());
    raise(difference_.rotor_rate, std::abs(rate - gyrostat_.rotor_rate(second.axial_momentum, Omega_2)));
    raise(difference_.rotor_angle, std::abs(first.rotor_angle - second.rotor_angle));
    raise(difference_.lyapunov, std::abs(V - gyrostat_.lyapunov(second.momentum, second.axial_momentum)));
  }

  /// In units of the columns.
  const ColumnErrors<Scalar>& difference() const noexcept { return difference_; }
  /// Greatest norms in the first motion; attitude: 1.
  const ColumnErrors<Scalar>& size() const noexcept { return size_; }

  /// `errors` (in units of the columns) over the sizes, 0/0 = 0.
  ColumnErrors<Scalar> relative(const ColumnErrors<Scalar>& errors) const noexcept {
    const auto over = [](Scalar error, Scalar size) noexcept { return error == 0 ? Scalar(0) : error / size; };
    return {errors.attitude,
            over(errors.angular_velocity, size_.angular_velocity),
            over(errors.angular_momentum, size_.angular_momentum),
            over(errors.rotor_rate, size_.rotor_rate),
            over(errors.rotor_angle, size_.rotor_angle),
            over(errors.lyapunov, size_.lyapunov)};
  }

 private:
  static void raise(Scalar& most, Scalar value) noexcept {
    if (!(value <= most)) most = most == most ? value : most;
  }

  Gyrostat<Scalar> gyrostat_;
  ColumnErrors<Scalar> difference_{}, size_{1};
};

}  // namespace gyrostat::rotor
