// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <type_traits>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"

namespace gyrostat::math {

template <Real Scalar>
struct WideSineCosine {
  Wide<Scalar> sine, cosine;
};

/// Sines and cosines of numbers side by side: for double without call or branch, error 1 eps, |x| up to 1e6. NaN and infinity give NaN.
template <Real Scalar>
GYROSTAT_INLINE WideSineCosine<Scalar> sine_cosine(const Wide<Scalar>& x) noexcept {
  if constexpr (std::is_same_v<Scalar, double>) {
    using Pack = Wide<double>;
    // quarters of a turn; rounding to the nearest whole by a number whose last bit is 1
    const Pack shift = wide(0x1.8p52), one = wide(1.), zero = wide(0.);
    const auto whole = [&](const Pack& y) GYROSTAT_INLINE_LAMBDA { return (y + shift) - shift; };
    const Pack quarters = whole(x * wide(0x1.45f306dc9c883p-1));  // 2/pi
    // pi/2 in parts of 33 bits, whose products with a whole are exact
    Pack z = x - quarters * wide(0x1.921fb544p0);
    z = z - quarters * wide(0x1.0b4611a6p-34);
    z = multiply_add(zero - quarters, wide(0x1.3198a2e037073p-69), z);
    const Pack square = z * z;
    // as math::detail::sine_cosine
    constexpr double sine[] = {1. / 355687428096000., -1. / 1307674368000., 1. / 6227020800., -1. / 39916800,
                               1. / 362880,           -1. / 5040,           1. / 120,         -1. / 6};
    constexpr double cosine[] = {1. / 20922789888000., -1. / 87178291200., 1. / 479001600, -1. / 3628800,
                                 1. / 40320,           -1. / 720,          1. / 24};
    Pack s = wide(sine[0]), c = wide(cosine[0]);
    for (int i = 1; i < 8; ++i) s = multiply_add(s, square, wide(sine[i]));
    for (int i = 1; i < 7; ++i) c = multiply_add(c, square, wide(cosine[i]));
    s = multiply_add(z * square, s, z);
    c = one - (wide(0.5) * square - square * square * c);
    // a quarter to and fro, then halves: both are -1, 0 or 1, and the sums exact
    const Pack half = whole(quarters * wide(0.5)), odd = quarters - (half + half);
    const Pack turns = whole(half * wide(0.5)), back = half - (turns + turns);
    const Pack even = one - odd * odd, sign = one - (back * back + back * back);
    return {sign * (even * s + odd * c), sign * (even * c - odd * s)};
  } else {
    WideSineCosine<Scalar> made{x, x};
    for (int i = 0; i < wide_size<Scalar>; ++i) {
      made.sine.v[i] = std::sin(x[i]);
      made.cosine.v[i] = std::cos(x[i]);
    }
    return made;
  }
}

}  // namespace gyrostat::math
