// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A brake where what it opposes is zero (docs/general.md, section 1.6): the torque -limit_j U_j/|U| has no direction there, and can be any
/// -limit_j n_j with |n| <= 1, so that it takes up what lies inside of an ellipsoid.
namespace gyrostat::general {

/// How much of a brake a torque takes: sqrt(sum (torque_j/limit_j)^2), at most 1 where the brake can hold the body against it; infinite where
/// there is a torque about an axis without brake. limit, torque: N m, body axes.
template <Real Scalar>
Scalar share_of_brake(const Vec3<Scalar>& limit, const Vec3<Scalar>& torque) noexcept {
  Vec3<Scalar> share(0, 0, 0);
  for (int i = 0; i < 3; ++i)
    if (torque[i] != 0) share[i] = limit[i] > 0 ? torque[i] / limit[i] : infinity<Scalar>;
  return magnitude(share);
}

/// How much more than the whole brake counts as held, as the share is known to so much.
template <Real Scalar>
inline constexpr Scalar share_slack = 8 * epsilon<Scalar>;

/// How U leaves zero under a torque that the brake cannot hold: along `direction`, n, at `rate`, N m, with
/// limit_j n_j + rate n_j = torque_j.
template <Real Scalar>
struct Departure {
  Vec3<Scalar> direction{0, 0, 0};
  Scalar rate = 0;
};

/// Of a torque whose share_of_brake() is over 1; else with rate 0.
template <Real Scalar>
Departure<Scalar> departure(const Vec3<Scalar>& limit, const Vec3<Scalar>& torque) noexcept {
  Departure<Scalar> made;
  Scalar low = 0, high = magnitude(torque);
  if (!(share_of_brake(limit, torque) > 1)) return made;
  for (int trip = 0; trip < 2 * std::numeric_limits<Scalar>::digits && low < high; ++trip) {
    const Scalar rate = low + (high - low) / 2;
    const Vec3<Scalar> with = limit.array() + rate;
    if (rate == low && trip > 0) break;
    (share_of_brake<Scalar>(with, torque) > 1 ? low : high) = rate;
  }
  made.rate = high;
  const Vec3<Scalar> n = torque.array() / (limit.array() + high);
  made.direction = n / magnitude(n);
  return made;
}

/// The torque of a brake on a body at rest under another torque, N m: it takes that up, or as much as it can where the body leaves.
template <Real Scalar>
Vec3<Scalar> torque_at_rest(const Vec3<Scalar>& limit, const Vec3<Scalar>& torque) noexcept {
  if (share_of_brake(limit, torque) <= 1 + share_slack<Scalar>) return -torque;
  return -limit.cwiseProduct(departure(limit, torque).direction);
}

}  // namespace gyrostat::general
