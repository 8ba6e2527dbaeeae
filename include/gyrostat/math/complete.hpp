// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/math/nome.hpp"

namespace gyrostat::math {

/// Complete elliptic integrals of the first and second kind.
template <Real Scalar>
struct Complete {
  Scalar K, E;
};

/// K and the orbit means of the Jacobi functions:
/// F = E/K = <dn^2>, W = 1 - F = k2 <sn^2>, V = k2 - W = k2 <cn^2>.
template <Real Scalar>
struct Means {
  Scalar K, F, W, V;
};

namespace detail {

/// K, F, W, V by theta constants of the nome of the smaller of k2 and kp2; the larger half by Legendre's relation
/// F = W' + pi/(2 K K'), a sum of positive terms. No loop; any scalar.
template <Real Scalar>
inline Means<Scalar> means_by_nome(Modulus<Scalar> m) noexcept {
  if (!m.legal()) return {nan<Scalar>, nan<Scalar>, nan<Scalar>, nan<Scalar>};
  const bool small = m.k2 <= m.kp2;
  const Modulus<Scalar> n = small ? m : m.complement();
  const Scalar q = nome(n);
  const auto theta = ThetaConstants<Scalar>::of(q);
  const Scalar square = theta.three * theta.three;
  const Scalar quarter = pi<Scalar> / 2 * square;                             // K of n
  const Scalar w = 8 * q * theta.curvature / (theta.four * square * square);  // W of n
  const Scalar v = n.k2 - w;                                                  // V of n
  if (small) return {quarter, 1 - w, w, v};
  const Scalar log_q = -std::log(q);
  const Scalar K = square * log_q / 2;
  const Scalar legendre = 2 / (square * square * log_q);  // pi/(2 K K')
  const Scalar F = w + legendre;
  return {K, F, 1 - F, legendre - v};
}

}  // namespace detail

/// K, F, W, V of a modulus (deceleration means). F, W, V each to a few eps relative at both ends: W and V like k2/2
/// at k2 -> 0, F and V like 1/K at kp2 -> 0. Limits: k2 = 0 gives pi/2, 1, 0, 0; kp2 = 0 gives infinity, 0, 1, 0.
/// Outside [0, 1] or NaN: NaN.
template <Real Scalar>
inline Means<Scalar> means(Modulus<Scalar> m) noexcept {
  return detail::means_by_nome(m);
}

/// K and E. Limits: k2 = 0 gives pi/2, pi/2; kp2 = 0 gives infinity, 1. Outside [0, 1] or NaN: NaN.
template <Real Scalar>
inline Complete<Scalar> complete(Modulus<Scalar> m) noexcept {
  const auto mean = detail::means_by_nome(m);
  if (m.kp2 == 0) return {mean.K, mean.F + 1};
  return {mean.K, mean.K * mean.F};
}

}  // namespace gyrostat::math
