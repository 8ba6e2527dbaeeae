// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Angles of three turns, each about an axis of the body as the turn before left it: R_IB = R_i(a1) R_j(a2) R_k(a3).
namespace gyrostat::inline GYROSTAT_LEVEL {

/// The axes i, j, k of the turns, counted from 0; neighbours differ.
using EulerAxes = std::array<int, 3>;

/// The unit quaternion of the angles, rad.
template <Real Scalar>
Quat<Scalar> quaternion_from_euler(const EulerAxes& axes, const Vec3<Scalar>& angles) noexcept {
  Quat<Scalar> q{};
  for (int i = 0; i < 3; ++i) {
    const Vec3<Scalar> turn = std::sin(angles[i] / 2) * Vec3<Scalar>::Unit(axes[std::size_t(i)]);
    q = q * Quat<Scalar>{std::cos(angles[i] / 2), turn[0], turn[1], turn[2]};
  }
  return q;
}

/// Angles, rad, and how far they are from where the first and the last turn are about one axis.
template <Real Scalar>
struct EulerAngles {
  Vec3<Scalar> angles{0, 0, 0};
  /// Angle, rad, by which the second one would have to change for that; then only the sum or the difference of the others has a meaning.
  Scalar from_lock = 0;

  /// The greatest length that an error of the attitude, rad, may have in the three angles; infinite where it reaches the lock. The axes of
  /// first and last turn part by from_lock, and what turns across both takes 1/sqrt(1 - cos) of it.
  Scalar error(Scalar of_attitude) const noexcept {
    const Scalar left = from_lock - of_attitude;
    return left > Scalar(1e-8L) ? of_attitude / (std::sqrt(Scalar(2)) * std::sin(left / 2)) : infinity<Scalar>;
  }
};

/// The angles of a quaternion of any length: the first and the last in [-pi, pi], the second in [0, pi] where i = k and in [-pi/2, pi/2] where all
/// axes differ. At the lock the angles still tell the attitude. The product of three turns with i = k has the components cos(a2/2) (cos, sin) of
/// (a1 + a3)/2 along 1, i, and sin(a2/2) (cos, sin) of (a1 - a3)/2 along j, i x j; three different axes come to that by R_k(a) = R_j(90 degrees)
/// R_i(-a or a) R_j(-90 degrees).
template <Real Scalar>
EulerAngles<Scalar> euler_angles(const EulerAxes& axes, const Quat<Scalar>& q) noexcept {
  const auto [i, j, k] = axes;
  const bool proper = i == k;
  const int across = 3 - i - j;
  const Scalar sense = (j - i + 3) % 3 == 1 ? 1 : -1;  // of i x j along the axis that is left
  Quat<Scalar> p = q;
  if (!proper) {
    const Vec3<Scalar> quarter = Vec3<Scalar>::Unit(j);
    p = q * Quat<Scalar>{1, quarter[0], quarter[1], quarter[2]};
  }
  const Vec3<Scalar> v(p.x, p.y, p.z);
  const Scalar even = std::hypot(p.w, v[i]), odd = std::hypot(v[j], v[across]);
  const Scalar sum = std::atan2(v[i], p.w), difference = std::atan2(sense * v[across], v[j]);
  const Scalar second = 2 * std::atan2(odd, even);
  const auto wrapped = [](Scalar angle) noexcept { return std::remainder(angle, 2 * pi<Scalar>); };
  EulerAngles<Scalar> made;
  made.angles[0] = wrapped(sum + difference);
  made.angles[1] = proper ? second : second - pi<Scalar> / 2;
  made.angles[2] = wrapped(proper ? sum - difference : -sense * (sum - difference));
  made.from_lock = 2 * std::atan2(std::min(odd, even), std::max(odd, even));
  return made;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
