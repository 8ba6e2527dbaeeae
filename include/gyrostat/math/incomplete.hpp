// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/carlson.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::math {

namespace detail {

/// phi = n pi + r with |r| <= pi/2, and what the Carlson forms need of r. An angle is only known to an eps of itself, so
/// pi in one word serves; r = +-pi/2 to rounding is taken as it stands.
template <Real Scalar>
struct Amplitude {
  Scalar n, s, c2, delta2, c;  // turns of pi, sin r, cos^2 r, 1 - k2 sin^2 r without the difference, cos r

  static Amplitude of(Scalar phi, Modulus<Scalar> m) noexcept {
    const Scalar n = std::nearbyint(phi / pi<Scalar>);
    const Scalar r = n == 0 ? phi : std::fma(-n, pi<Scalar>, phi);
    const Scalar s = std::sin(r);
    const Scalar c = std::cos(r);
    return {n, s, c * c, c * c + m.kp2 * (s * s), c};
  }
};

}  // namespace detail

/// F(phi, k) = int_0^phi dt / sqrt(1 - k2 sin^2 t), any phi [rad]: F(phi + n pi) = F(phi) + 2 n K. At kp2 = 0 infinite
/// beyond |phi| = pi/2. NaN for NaN, an infinite phi or an illegal modulus. (DLMF 19.25.5)
template <Real Scalar>
inline Scalar incomplete_F(Scalar phi, Modulus<Scalar> m) noexcept {
  if (!m.legal()) return nan<Scalar>;
  const auto at = detail::Amplitude<Scalar>::of(phi, m);
  const Scalar part = at.s * carlson_RF<Scalar>(at.c2, at.delta2, 1);
  return at.n == 0 ? part : 2 * at.n * complete(m).K + part;
}

/// E(phi, k) = int_0^phi sqrt(1 - k2 sin^2 t) dt, any phi [rad]: E(phi + n pi) = E(phi) + 2 n E. A sum of positive
/// terms (DLMF 19.25.10), so nothing is lost at k2 -> 1. NaN for NaN, an infinite phi or an illegal modulus.
template <Real Scalar>
inline Scalar incomplete_E(Scalar phi, Modulus<Scalar> m) noexcept {
  if (!m.legal()) return nan<Scalar>;
  const auto at = detail::Amplitude<Scalar>::of(phi, m);
  Scalar part = at.s;
  if (m.kp2 > 0) {
    const Scalar s2 = at.s * at.s;
    part =
        at.s *
        (m.kp2 * (carlson_RF<Scalar>(at.c2, at.delta2, 1) + m.k2 * s2 / 3 * carlson_RD<Scalar>(at.c2, 1, at.delta2)) +
         m.k2 * at.c / std::sqrt(at.delta2));
  }
  return at.n == 0 ? part : 2 * at.n * complete(m).E + part;
}

/// Pi(n; phi, k) = int_0^phi dt / ((1 - n sin^2 t) sqrt(1 - k2 sin^2 t)), any phi [rad] where the integrand has no pole:
/// any n while n sin^2 t < 1 on the way. Negative n by DLMF 19.7.9, a sum of positive terms. At a pole infinite, beyond
/// one (a principal value) NaN; NaN for NaN, an infinite phi or n, or an illegal modulus.
template <Real Scalar>
inline Scalar incomplete_Pi(Scalar phi, Scalar n, Modulus<Scalar> m) noexcept {
  if (!m.legal() || !(phi - phi == 0) || !(n - n == 0)) return nan<Scalar>;
  const auto at = detail::Amplitude<Scalar>::of(phi, m);
  // Pi at sin r = s, cos^2 r = c2 with 0 <= characteristic, given with its complement 1 - characteristic
  const auto positive = [&](Scalar characteristic, Scalar rest, Scalar s, Scalar c2, Scalar delta2) {
    const Scalar s2 = s * s;
    return s * (carlson_RF<Scalar>(c2, delta2, 1) +
                characteristic * s2 / 3 * carlson_RJ<Scalar>(c2, delta2, 1, c2 + rest * s2));
  };
  const auto part = [&](Scalar s, Scalar c, Scalar c2, Scalar delta2) {
    if (!(n < 0)) return positive(n, 1 - n, s, c2, delta2);
    const Scalar rest = m.kp2 / (1 - n);        // 1 - N
    const Scalar image = (m.k2 - n) / (1 - n);  // N, between k2 and 1
    const Scalar step = -n * rest;              // N - k2
    const Scalar s2 = s * s;
    const Scalar first = m.k2 * s * carlson_RF<Scalar>(c2, delta2, 1);
    const Scalar second = step * positive(image, rest, s, c2, delta2);
    const Scalar third = -n * image * s * c * carlson_RC<Scalar>(delta2, (1 - n * s2) * (c2 + rest * s2));
    return (first + second + third) / (m.k2 - n);
  };
  const Scalar inside = part(at.s, at.c, at.c2, at.delta2);
  if (at.n == 0) return inside;
  if (n > 1) return nan<Scalar>;
  if (m.kp2 == 0) return at.n > 0 ? infinity<Scalar> : -infinity<Scalar>;
  return 2 * at.n * part(1, 0, 0, m.kp2) + inside;
}

}  // namespace gyrostat::math
