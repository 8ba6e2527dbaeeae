// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/associate.hpp"

namespace gyrostat::math::detail {

/// Elementary functions on the short ranges that the Jacobi functions need: polynomials without call or branch for
/// double, the standard library for the others.

template <Real Scalar>
struct SineCosine {
  Scalar s, c;
};

/// sin z and cos z, |z| <= pi/4 (a little more does no harm): Taylor sums, relative error 1 eps.
template <Real Scalar>
GYROSTAT_FLATTEN SineCosine<Scalar> sine_cosine(Scalar z) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    constexpr double sine[] = {-1. / 6,        1. / 120,         -1. / 5040,           1. / 362880,
                               -1. / 39916800, 1. / 6227020800., -1. / 1307674368000., 1. / 355687428096000.};
    constexpr double cosine[] = {1. / 24,        -1. / 720,          1. / 40320,          -1. / 3628800,
                                 1. / 479001600, -1. / 87178291200., 1. / 20922789888000.};
    const Powers x = Powers::of(z * z);
    return {z + z * (x.value[0] * polynomial(sine, x)), 1 - (0.5 * x.value[0] - x.value[1] * polynomial(cosine, x))};
  } else {
    return {std::sin(z), std::cos(z)};
  }
}

/// sinh y and cosh y, |y| <= 300 for double: relative error 2 eps, also of sinh at 0.
template <Real Scalar>
GYROSTAT_FLATTEN SineCosine<Scalar> sinh_cosh(Scalar y) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    // exp y - 1 = 2^k (exp r - 1) + (2^k - 1), |r| <= ln 2 / 2
    constexpr double shift = 0x1.8p52;
    const double a = std::abs(y);
    const double shifted = a * 0x1.71547652b82fep0 + shift;
    const double k = shifted - shift;
    const double r = (a - k * 0x1.62e42feep-1) - k * 0x1.a39ef35793c76p-33;
    constexpr double rest[] = {1. / 6,         1. / 24,         1. / 120,        1. / 720,
                               1. / 5040,      1. / 40320,      1. / 362880.,    1. / 3628800.,
                               1. / 39916800., 1. / 479001600., 1. / 6227020800.};
    const Powers x = Powers::of(r);
    const double p = r + x.value[1] * (0.5 + r * polynomial(rest, x));
    const double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
    const double t = scale * p + (scale - 1);
    const double inverse = 1 / (t + 1);
    return {std::copysign(0.5 * (t + t * inverse), y), 0.5 * ((t + 1) + inverse)};
  } else {
    return {std::sinh(y), std::cosh(y)};
  }
}

/// The angle of the point (x, y), x >= 0 [rad], relative error 2 eps.
template <Real Scalar>
GYROSTAT_FLATTEN Scalar angle(Scalar y, Scalar x) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    const double a = std::abs(y);
    const bool low = a <= 0.41421356237309503 * x;  // tan(pi/8)
    const bool high = a > 2.414213562373095 * x;    // tan(3 pi/8)
    const double above = low ? a : high ? -x : a - x;
    const double below = low ? x : high ? a : a + x;
    const double base = low ? 0.0 : high ? pi<double> / 2 : pi<double> / 4;
    const double t = above / below;
    const Powers powers = Powers::of(t * t);
    return std::copysign(base + (t + t * (powers.value[0] * polynomial(arctangent, powers))), y);
  } else {
    return std::atan2(y, x);
  }
}

/// ln x of a normal x > 0.
template <Real Scalar>
GYROSTAT_FLATTEN Scalar logarithm_of(Scalar x) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    return logarithm_of_positive(x);
  } else {
    return std::log(x);
  }
}

}  // namespace gyrostat::math::detail
