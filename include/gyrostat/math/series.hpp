// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// Arithmetic of power series a_0 + a_1 t + ..., one coefficient at a time: each function gives coefficient k of the
/// result from coefficients 0..k of its arguments (and 0..k-1 of the result where it is named). These are the
/// recurrences of the Taylor models. Arrays must hold the coefficients named; nothing is checked.

/// (a b)_k = sum_j a_j b_(k-j).
template <Real Scalar>
constexpr Scalar product(const Scalar* a, const Scalar* b, int k) noexcept {
  Scalar sum = a[0] * b[k];
  for (int j = 1; j <= k; ++j) sum += a[j] * b[k - j];
  return sum;
}

/// (a^2)_k, in half the multiplications.
template <Real Scalar>
constexpr Scalar square(const Scalar* a, int k) noexcept {
  Scalar sum = 0;
  for (int j = 0; 2 * j < k; ++j) sum += a[j] * a[k - j];
  sum += sum;
  return k % 2 == 0 ? sum + a[k / 2] * a[k / 2] : sum;
}

/// c_k of c = a/b; inverse = 1/b_0, b_0 != 0. Reads a_k alone of a.
template <Real Scalar>
constexpr Scalar quotient(Scalar a_k, const Scalar* b, const Scalar* c, int k, Scalar inverse) noexcept {
  Scalar sum = a_k;
  for (int j = 1; j <= k; ++j) sum -= b[j] * c[k - j];
  return sum * inverse;
}

/// p_k, k >= 1, of p = s^alpha, with p_0 = s_0^alpha set by the caller; inverse = 1/s_0, s_0 > 0 (J. C. P. Miller's
/// formula, from s p' = alpha s' p).
template <Real Scalar>
constexpr Scalar power(const Scalar* s, const Scalar* p, Scalar alpha, int k, Scalar inverse) noexcept {
  Scalar sum = 0;
  for (int j = 1; j <= k; ++j) sum += (alpha * Scalar(j) - Scalar(k - j)) * s[j] * p[k - j];
  return sum * inverse / Scalar(k);
}

/// r_k, k >= 1, of r = sqrt(s), with r_0 = sqrt(s_0) set by the caller; inverse = 1/(2 r_0). Reads s_k alone of s.
template <Real Scalar>
constexpr Scalar square_root(Scalar s_k, const Scalar* r, int k, Scalar inverse) noexcept {
  Scalar sum = 0;
  for (int j = 1; 2 * j < k; ++j) sum += r[j] * r[k - j];
  sum += sum;
  if (k % 2 == 0) sum += r[k / 2] * r[k / 2];
  return (s_k - sum) * inverse;
}

/// The value at t of the polynomial with coefficients a_0 .. a_order (Horner).
template <Real Scalar>
constexpr Scalar evaluate(const Scalar* a, int order, Scalar t) noexcept {
  Scalar sum = a[order];
  for (int j = order - 1; j >= 0; --j) sum = sum * t + a[j];
  return sum;
}

}  // namespace gyrostat::math
