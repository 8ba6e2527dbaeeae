// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "gyrostat/math/complete_coefficients.hpp"

#if defined(__GNUC__)
#define GYROSTAT_FLATTEN [[gnu::always_inline]] inline
#else
#define GYROSTAT_FLATTEN inline
#endif

namespace gyrostat::math::detail {

/// x, x^2, x^4, x^8, x^16: the powers that Estrin's scheme needs up to degree 31.
struct Powers {
  double value[5];

  GYROSTAT_FLATTEN static Powers of(double x) noexcept {
    const double x2 = x * x;
    const double x4 = x2 * x2;
    const double x8 = x4 * x4;
    return {{x, x2, x4, x8, x8 * x8}};
  }
};

/// sum of c[first + i] x^i for i < count, by halves (Estrin): short chains, so that a processor overlaps them.
template <std::size_t first, std::size_t count, std::size_t size>
GYROSTAT_FLATTEN double polynomial(const double (&c)[size], const Powers& x) noexcept {
  if constexpr (count == 1) {
    return c[first];
  } else {
    constexpr std::size_t half = std::bit_ceil(count) / 2;
    return polynomial<first, half>(c, x) +
           x.value[std::bit_width(half) - 1] * polynomial<first + half, count - half>(c, x);
  }
}

template <std::size_t size>
GYROSTAT_FLATTEN double polynomial(const double (&c)[size], const Powers& x) noexcept {
  return polynomial<0, size>(c, x);
}

/// ln x for 0 < x < 2^960, subnormals too; absolute error an eps of max(1, |ln x|). No branch, call or division: it
/// vectorises.
/// A finite number for 0; garbage for a negative or infinite x and for NaN.
GYROSTAT_FLATTEN double logarithm_of_positive(double x) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(x * 0x1p54);  // normal for every x > 0
  // x = 2^e m with sqrt(1/2) <= m < sqrt 2
  constexpr std::uint64_t one = 0x3ff0000000000000;
  constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcd;
  const std::uint64_t exponent = (bits + (one - root_half)) >> 52;  // e + 54 + 1023
  const double m = std::bit_cast<double>(bits - (exponent << 52) + one);
  constexpr double shift = 0x1p52 + 1023 + 54;
  const double e = std::bit_cast<double>(exponent | 0x4330000000000000) - shift;
  const double r = m - 1;
  const Powers powers = Powers::of(r);
  const double r2 = powers.value[1];
  constexpr double ln2_high = 0x1.62e42feep-1;  // e ln2_high is exact
  constexpr double ln2_low = 0x1.a39ef35793c76p-33;
  const double rest = r2 * (r * polynomial(logarithm, powers) - 0.5) + e * ln2_low;
  return e * ln2_high + (r + rest);
}

/// The associate complete integrals B = int cos^2/delta, D = int sin^2/delta over [0, pi/2], delta = sqrt(1 - k2 sin^2):
/// K = B + D, E = B + kp2 D, K - E = k2 D, E - kp2 K = k2 B, all sums of positive terms.
struct Associate {
  double B, D;

  /// 0 < kp2 <= 1, relative error 2 eps; at kp2 = 0 some finite D and B = 1. No branch: it vectorises.
  GYROSTAT_FLATTEN static Associate of(double kp2) noexcept {
    const double l = logarithm_of_positive(kp2);
    const Powers x = Powers::of(kp2);
    return {polynomial(B_regular, x) - l * polynomial(B_logarithmic, x),
            polynomial(D_regular, x) - l * polynomial(D_logarithmic, x)};
  }
};

}  // namespace gyrostat::math::detail
