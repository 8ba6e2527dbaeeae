// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/math/elliptic.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/models/deceleration/regime.hpp"

/// The path of the momentum M of a free body without rotor momentum (Euler, Poinsot), |M| left open, in both regimes alike: `near` is the
/// principal axis that it surrounds, `far` the opposite one, `mid` that of the middle moment. Only differences of the inverse moments enter,
/// so that nothing cancels when two moments approach each other. Rates and attitude at any time: models/free.
namespace gyrostat::deceleration {

/// Principal axes as a regime sees them.
template <Real Scalar>
struct PolhodeAxes {
  Scalar near_mid, mid_far, near_far;  ///< |1/J_i - 1/J_j| of these axes, 1/(kg m^2)
  int near, far;                       ///< indices of the principal axes; the middle one is 1
  Scalar a_near, a_far;                ///< 1/J of the axes, 1/(kg m^2)

  /// @param a ascending inverse moments; @param gaps (a2 - a1, a3 - a2, a3 - a1), see Problem::inverse_gaps;
  /// @param regime about_largest or about_smallest
  static PolhodeAxes of(const Vec3<Scalar>& a, const Vec3<Scalar>& gaps, Regime regime) noexcept {
    const int n = regime == Regime::about_largest ? 0 : 2, f = 2 - n;
    return {gaps[n / 2], gaps[1 - n / 2], gaps[2], n, f, a[n], a[f]};
  }
  static PolhodeAxes of(const Vec3<Scalar>& a, Regime regime) noexcept {
    return of(a, Vec3<Scalar>(a[1] - a[0], a[2] - a[1], a[2] - a[0]), regime);
  }

  /// Value of the tilt on the separatrix.
  Scalar separatrix_tilt() const noexcept { return near_mid / near_far; }
  /// The near axis is an axis of symmetry: k2 is 0 at any tilt.
  bool axisymmetric() const noexcept { return mid_far == 0; }
};

/// A polhode apart from the length of M. tilt = (2H/M^2 - a_near)/(a_far - a_near) is 0 on the near axis and grows to near_mid/near_far on
/// the separatrix; modulus.k2 = mid_far tilt/(near_mid (1 - tilt)).
template <Real Scalar>
struct Polhode {
  Regime regime;
  PolhodeAxes<Scalar> axes;
  math::Modulus<Scalar> modulus;
  Scalar tilt, along;  ///< with the sum 1, each from its own products
  int side;            ///< sign of M along the near axis

  /// 2H/M^2, 1/(kg m^2).
  Scalar energy_ratio() const noexcept { return axes.a_near * along + axes.a_far * tilt; }
  /// du/dt per unit |M|, where u is the argument of the Jacobi functions: n/M of docs/deceleration.md.
  Scalar rate_per_momentum() const noexcept { return std::sqrt(axes.near_mid * axes.near_far * along); }
};

/// Polhode through M, from the components (never from M^2 and H, which cancel); on the separatrix about the largest moment. M must not
/// vanish. The modulus is NaN on a sphere, and where M lies across an axis of symmetry.
/// @param a ascending inverse moments; @param gaps (a2 - a1, a3 - a2, a3 - a1), see Problem::inverse_gaps
template <Real Scalar>
Polhode<Scalar> polhode_through(const Vec3<Scalar>& a, const Vec3<Scalar>& gaps, const Vec3<Scalar>& M) noexcept {
  const Vec3<Scalar> m = M.cwiseProduct(M);
  const Regime regime = gaps[0] * m[0] >= gaps[1] * m[2] ? Regime::about_largest : Regime::about_smallest;
  const auto x = PolhodeAxes<Scalar>::of(a, gaps, regime);
  const Scalar near = m[x.near], mid = m[1], far = m[x.far];
  const Scalar across = x.near_mid * mid + x.near_far * far;  // tilt of M^2 near_far
  const Scalar along = x.near_far * near + x.mid_far * mid;   // 1 - tilt of the same
  const Scalar whole = x.near_mid * along, one = 1;
  const math::Modulus<Scalar> modulus{std::min(x.mid_far * across / whole, one),
                                      std::min(x.near_far * (x.near_mid * near - x.mid_far * far) / whole, one)};
  return {regime, x, modulus, across / (across + along), along / (across + along), M[x.near] < 0 ? -1 : 1};
}
template <Real Scalar>
Polhode<Scalar> polhode_through(const Vec3<Scalar>& a, const Vec3<Scalar>& M) noexcept {
  return polhode_through<Scalar>(a, Vec3<Scalar>(a[1] - a[0], a[2] - a[1], a[2] - a[0]), M);
}

/// The same polhode family at another modulus.
template <Real Scalar>
Polhode<Scalar> at_modulus(Polhode<Scalar> polhode, math::Modulus<Scalar> modulus) noexcept {
  const auto& x = polhode.axes;
  polhode.modulus = modulus;
  if (x.axisymmetric()) return polhode;
  const Scalar across = x.near_mid * modulus.k2, whole = x.mid_far + across;
  polhode.tilt = across / whole;
  polhode.along = x.mid_far / whole;
  return polhode;
}

/// M on the polhode at argument u; u grows with time in both regimes. Components in principal axes, N m s.
template <class Elliptic = math::Native, Real Scalar>
Vec3<Scalar> momentum_on(const Polhode<Scalar>& p, Scalar norm, Scalar u) noexcept {
  const auto j = Elliptic::jacobi(u, p.modulus);
  Vec3<Scalar> M;
  M[p.axes.near] = Scalar(p.side) * norm * std::sqrt(p.along) * j.dn;
  M[1] = norm * std::sqrt(p.tilt * p.axes.near_far / p.axes.near_mid) * j.sn;
  M[p.axes.far] = -Scalar(p.side) * norm * std::sqrt(p.tilt) * j.cn;
  return M;
}

/// Argument u of M on its polhode, in (-2K, 2K].
template <class Elliptic = math::Native, Real Scalar>
Scalar argument_of(const Polhode<Scalar>& p, const Vec3<Scalar>& M) noexcept {
  const Scalar sn = M[1] * std::sqrt(p.axes.near_mid / p.axes.near_far);
  const Scalar cn = -Scalar(p.side) * M[p.axes.far];
  return Elliptic::incomplete_F(std::atan2(sn, cn), p.modulus);
}

}  // namespace gyrostat::deceleration
