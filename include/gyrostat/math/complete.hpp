// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/associate.hpp"
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
  using std::log;
  const Scalar log_q = -log(q);
  const Scalar K = square * log_q / 2;
  const Scalar legendre = 2 / (square * square * log_q);  // pi/(2 K K')
  const Scalar F = w + legendre;
  return {K, F, 1 - F, legendre - v};
}

/// K and E of one modulus without a branch; limits and illegal moduli by selection.
GYROSTAT_FLATTEN Complete<double> complete_of(Modulus<double> m) noexcept {
  const Associate at = Associate::of(m.kp2);
  const double K = at.B + at.D;
  const double E = at.B + m.kp2 * at.D;
  const double wrong = m.legal() ? 0.0 : nan<double>;
  const double endless = m.kp2 > 0 ? 0.0 : infinity<double>;
  return {K + endless + wrong, E + wrong};
}

}  // namespace detail

/// K, F, W, V of a modulus. F, W, V each to a few eps relative at both ends: W and V like k2/2 at k2 -> 0, F and V like
/// 1/K at kp2 -> 0. Limits: k2 = 0 gives pi/2, 1, 0, 0; kp2 = 0 gives infinity, 0, 1, 0. Outside [0, 1] or NaN: NaN.
/// For float and double polynomials and one logarithm (10 to 15 ns), for long double the nome.
template <Real Scalar>
inline Means<Scalar> means(Modulus<Scalar> m) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    if (!m.legal()) return {nan<double>, nan<double>, nan<double>, nan<double>};
    if (m.kp2 == 0) return {infinity<double>, 0, 1, 0};
    const auto at = detail::Associate::of(m.kp2);
    const double K = at.B + at.D;
    return {K, (at.B + m.kp2 * at.D) / K, m.k2 * at.D / K, m.k2 * at.B / K};
  } else if constexpr (std::same_as<Scalar, float>) {
    const auto mean = means(Modulus<double>{m.k2, m.kp2});
    return {float(mean.K), float(mean.F), float(mean.W), float(mean.V)};
  } else {
    return detail::means_by_nome(m);
  }
}

/// K and E. Limits: k2 = 0 gives pi/2, pi/2; kp2 = 0 gives infinity, 1. Outside [0, 1] or NaN: NaN. Cost as means().
template <Real Scalar>
inline Complete<Scalar> complete(Modulus<Scalar> m) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    return detail::complete_of(m);
  } else if constexpr (std::same_as<Scalar, float>) {
    const auto integral = complete(Modulus<double>{m.k2, m.kp2});
    return {float(integral.K), float(integral.E)};
  } else {
    const auto mean = detail::means_by_nome(m);
    if (m.kp2 == 0) return {mean.K, mean.F + 1};
    return {mean.K, mean.K * mean.F};
  }
}

namespace detail {

GYROSTAT_FLATTEN void complete_loop(const double* __restrict k2, const double* __restrict kp2, double* __restrict K,
                                    double* __restrict E, std::size_t n) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    const Complete<double> integral = complete_of({k2[i], kp2[i]});
    K[i] = integral.K;
    E[i] = integral.E;
  }
}

}  // namespace detail

/// K and E of n moduli in arrays, the same numbers as one by one: a loop without branch or call, which compilers turn
/// into vector instructions (-O3; about 1.3 ns a modulus with AVX-512). The compiled library (GYROSTAT_COMPILED) holds
/// it for several instruction sets and picks one at run time. The outputs must not overlap the inputs.
#if defined(GYROSTAT_COMPILED)
void complete(const double* k2, const double* kp2, double* K, double* E, std::size_t n) noexcept;
#else
inline void complete(const double* k2, const double* kp2, double* K, double* E, std::size_t n) noexcept {
  detail::complete_loop(k2, kp2, K, E, n);
}
#endif

}  // namespace gyrostat::math
