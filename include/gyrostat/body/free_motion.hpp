// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/modulus.hpp"

/// The free motion of a rigid body (Euler, Poinsot), as the path of its momentum M in the body sees it, in both regimes alike: `near`
/// is the principal axis that the path surrounds, `far` the opposite one, `mid` that of the middle moment. Only differences of the
/// inverse moments enter, so that nothing cancels when two moments approach each other.
namespace gyrostat {

/// Whether M surrounds the axis of the largest moment, else that of the smallest; on the separatrix the former. largest_mid,
/// mid_smallest: differences of the inverse moments, >= 0; the squares of M along these axes, in the same unit.
template <Real Scalar>
bool surrounds_largest(Scalar largest_mid, Scalar mid_smallest, Scalar along_largest, Scalar along_smallest) noexcept {
  return largest_mid * along_largest >= mid_smallest * along_smallest;
}

/// |1/I_i - 1/I_j| of the principal axes as M sees them, in any unit.
template <Real Scalar>
struct PolhodeGaps {
  Scalar near_mid, mid_far, near_far;

  /// Value of the tilt on the separatrix.
  Scalar separatrix_tilt() const noexcept { return near_mid / near_far; }
  /// The near axis is an axis of symmetry: k2 is 0 at any tilt.
  bool axisymmetric() const noexcept { return mid_far == 0; }
};

/// A path of M apart from its length. tilt = (2H/M^2 - 1/I_near)/(1/I_far - 1/I_near) is 0 on the near axis and grows to
/// near_mid/near_far on the separatrix; modulus.k2 = mid_far tilt/(near_mid (1 - tilt)).
template <Real Scalar>
struct PolhodeShape {
  Scalar tilt;   ///< M_mid^2 + M_far^2 over M^2 where the near axis is one of symmetry
  Scalar along;  ///< 1 - tilt, from its own products
  math::Modulus<Scalar> modulus;
  Scalar sensitivity;  ///< of kp2 to M, relative changes; infinite on the separatrix

  /// From the squares of the components of M (never from M^2 and H, which cancel), not all zero. NaN on a sphere, and where M lies across
  /// an axis of symmetry.
  static PolhodeShape of(const PolhodeGaps<Scalar>& gaps, Scalar near, Scalar mid, Scalar far) noexcept {
    const Scalar across = gaps.near_mid * mid + gaps.near_far * far;  // tilt of M^2 near_far
    const Scalar along = gaps.near_far * near + gaps.mid_far * mid;   // 1 - tilt of the same
    const Scalar whole = gaps.near_mid * along;
    const Scalar inside = gaps.near_mid * near, outside = gaps.mid_far * far;
    return {across / (across + along),
            along / (across + along),
            {std::min(gaps.mid_far * across / whole, Scalar(1)),
             std::min(gaps.near_far * (inside - outside) / whole, Scalar(1))},
            inside > outside ? (inside + outside) / (inside - outside) : infinity<Scalar>};
  }
};

/// du/dt per unit |M|, where u is the argument of Jacobi's functions; along: PolhodeShape::along.
template <Real Scalar>
Scalar rate_per_momentum(const PolhodeGaps<Scalar>& gaps, Scalar along) noexcept {
  return std::sqrt(gaps.near_mid * gaps.near_far * along);
}

}  // namespace gyrostat
