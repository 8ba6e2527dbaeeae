// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

namespace gyrostat::heavy {

/// The rates at which a top can precess at a constant inclination u = g3, right-handed about DOWN, rad/s: the roots of
///     A u w^2 - C r w + V' = 0,   V' = -W + N (C - A) u   (docs/heavy.md, section 7).
/// No cancellation in either. slow -> V'/(C r) and fast -> C r/(A u) as r grows; a horizontal axis (u = 0 to rounding)
/// has no fast one: infinite.
template <Real Scalar>
struct RegularPrecession {
  bool exists;        ///< real roots: (C r)^2 >= 4 A u V'
  Scalar slow, fast;  ///< |slow| <= |fast|; NaN where they do not exist
};

/// @param u down along the axis of symmetry, in [-1, 1]   @param spin r, rad/s
template <Real Scalar>
RegularPrecession<Scalar> regular_precession(const SymmetricTop<Scalar>& top, Scalar u, Scalar spin) noexcept {
  Scalar a = top.across * u, b = top.along * spin;
  Scalar c = -top.weight + top.gradient * (top.along - top.across) * u;
  const Scalar size = std::max({std::abs(a), std::abs(b), std::abs(c)});
  if (size > 0 && size < infinity<Scalar>)
    for (Scalar* each : {&a, &b, &c}) *each = std::scalbn(*each, -std::ilogb(size));
  const Scalar discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return {false, nan<Scalar>, nan<Scalar>};
  const Scalar q = (b + std::copysign(std::sqrt(discriminant), b)) / 2;
  if (q == 0 && c != 0) return {false, nan<Scalar>, nan<Scalar>};  // a level axis without spin
  // q = 0 where nothing drives nor spins
  const Scalar slow = q == 0 ? Scalar(0) : c / q;
  const bool level = std::abs(u) <= 8 * epsilon<Scalar>;
  const Scalar fast = level ? (q == 0 ? Scalar(0) : infinity<Scalar>) : q / a;
  const bool ordered = std::abs(slow) <= std::abs(fast);
  return {true, ordered ? slow : fast, ordered ? fast : slow};
}

/// The start that precesses so: w = precession d + (r - precession u) e3, in the top's frame.
/// @param down unit, in that frame
template <Real Scalar>
Vec3<Scalar> precessing_velocity(const Vec3<Scalar>& down, Scalar spin, Scalar precession) noexcept {
  return {precession * down[0], precession * down[1], spin};
}

}  // namespace gyrostat::heavy
