// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::heavy {

/// The shortest turn that takes one unit vector to another; half a turn about any axis across where they are opposite.
/// Exact to rounding in what it takes `from` to.
template <Real Scalar>
Quat<Scalar> shortest_turn(const Vec3<Scalar>& from, const Vec3<Scalar>& to) noexcept {
  const Vec3<Scalar> axis = cross<Scalar>(from, to);
  const Scalar cosine = from.dot(to);
  if (cosine > Scalar(-0.9)) return normalised(Quat<Scalar>{1 + cosine, axis[0], axis[1], axis[2]});
  // almost opposite: half a turn, and then the little that is left
  int least = 0;
  from.cwiseAbs().minCoeff(&least);
  const Scalar length = axis.norm();
  Vec3<Scalar> about =
      length > 16 * epsilon<Scalar> ? Vec3<Scalar>(axis / length) : cross<Scalar>(from, Vec3<Scalar>::Unit(least));
  about = (about - from.dot(about) * from).normalized();
  const Vec3<Scalar> opposite = -from, rest = cross<Scalar>(opposite, to);
  return normalised(normalised(Quat<Scalar>{1 - cosine, rest[0], rest[1], rest[2]}) *
                    Quat<Scalar>{0, about[0], about[1], about[2]});
}

/// A start with unit down and unit attitude, the attitude turned the shortest way to where it agrees with down. Errors:
/// not_finite; zero_vector.
template <Real Scalar>
Result<State<Scalar>> aligned(const State<Scalar>& start) noexcept {
  const Scalar turn = norm(start.attitude), length = magnitude(start.down);
  if (!start.angular_velocity.allFinite() || !start.down.allFinite() || !std::isfinite(turn)) return Errc::not_finite;
  if (!(length > 0) || !(turn > 0)) return Errc::zero_vector;
  State<Scalar> made;
  made.angular_velocity = start.angular_velocity;
  made.down = start.down / length;
  const Quat<Scalar> given = normalised(start.attitude);
  const Vec3<Scalar> seen = rotate<Scalar>(conjugate(given), Vec3<Scalar>(0, 0, -1));
  made.attitude = normalised(given * shortest_turn<Scalar>(made.down, seen));
  return made;
}

}  // namespace gyrostat::heavy
