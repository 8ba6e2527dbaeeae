// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// Arithmetic of power series a_0 + a_1 t + ..., one coefficient at a time: each function gives coefficient k of the
/// result from coefficients 0..k of its arguments (and 0..k-1 of the result where it is named). These are the
/// recurrences of the Taylor models. Arrays must hold the coefficients named; nothing is checked.

/// a_from b_(k-from) + ... + a_to b_(k-to), in four sums side by side: one alone would wait for each addition. The newest coefficients are
/// best taken last, beside it.
template <Real Scalar>
constexpr Scalar sum_of_products(const Scalar* a, const Scalar* b, int from, int to, int k) noexcept {
  Scalar sum[4] = {0, 0, 0, 0};
  int j = from;
  for (; j + 3 <= to; j += 4)
    for (int i = 0; i < 4; ++i) sum[i] += a[j + i] * b[k - j - i];
  for (; j <= to; ++j) sum[0] += a[j] * b[k - j];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// (a b)_k = sum_j a_j b_(k-j).
template <Real Scalar>
constexpr Scalar product(const Scalar* a, const Scalar* b, int k) noexcept {
  if (k == 0) return a[0] * b[0];
  return sum_of_products(a, b, 1, k - 1, k) + (a[0] * b[k] + a[k] * b[0]);
}

/// (a^2)_k, in half the multiplications.
template <Real Scalar>
constexpr Scalar square(const Scalar* a, int k) noexcept {
  if (k == 0) return a[0] * a[0];
  const Scalar sum = 2 * (sum_of_products(a, a, 1, (k + 1) / 2 - 1, k) + a[0] * a[k]);
  return k % 2 == 0 ? sum + a[k / 2] * a[k / 2] : sum;
}

/// c_k of c = a/b; inverse = 1/b_0, b_0 != 0. Reads a_k alone of a.
template <Real Scalar>
constexpr Scalar quotient(Scalar a_k, const Scalar* b, const Scalar* c, int k, Scalar inverse) noexcept {
  if (k == 0) return a_k * inverse;
  return (a_k - sum_of_products(b, c, 2, k, k) - b[1] * c[k - 1]) * inverse;
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
  Scalar sum = 2 * sum_of_products(r, r, 1, (k + 1) / 2 - 1, k);
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
