// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <type_traits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/math/many.hpp"

/// Turns counted over a long time, and the numbers of a grid that they turn.
namespace gyrostat::free::detail {

/// A number in two words, for turns counted over a long time.
template <Real Scalar>
struct Turns {
  Scalar high = 0, low = 0;

  template <Real Setup>
  static Turns split(const Setup& x) noexcept {
    const Scalar high = static_cast<Scalar>(x);
    return {high, static_cast<Scalar>(x - Setup(high))};
  }
};

/// A number of turns less the nearest whole one, in two words.
template <Real Scalar>
struct Fraction {
  Scalar whole, high, low;

  /// of rate t + start
  static Fraction of(const Turns<Scalar>& rate, Scalar t, const Turns<Scalar>& start) noexcept {
    using std::fma, std::nearbyint;
    const Scalar p = t * rate.high, rest = fma(t, rate.high, -p) + t * rate.low;
    const Scalar sum = p + start.high, back = sum - p;
    const Scalar low = ((p - (sum - back)) + (start.high - back)) + (rest + start.low);
    const Scalar n = nearbyint(sum), part = sum - n, more = nearbyint(part + low);
    const Scalar left = part - more, high = left + low;
    return {n + more, high, low - (high - left)};
  }
};

/// One number with the interface of Wide, for machines without registers of four and a fused product: there many at once take longer.
template <Real Scalar>
struct OnePoint {
  Scalar x;

  GYROSTAT_INLINE friend OnePoint operator+(OnePoint a, OnePoint b) noexcept { return {a.x + b.x}; }
  GYROSTAT_INLINE friend OnePoint operator-(OnePoint a, OnePoint b) noexcept { return {a.x - b.x}; }
  GYROSTAT_INLINE friend OnePoint operator*(OnePoint a, OnePoint b) noexcept { return {a.x * b.x}; }
  GYROSTAT_INLINE friend OnePoint operator/(OnePoint a, OnePoint b) noexcept { return {a.x / b.x}; }
  GYROSTAT_INLINE friend OnePoint multiply_add(OnePoint a, OnePoint b, OnePoint c) noexcept {
    return {a.x * b.x + c.x};
  }
  GYROSTAT_INLINE friend void store(Scalar* to, OnePoint a) noexcept { *to = a.x; }
};

/// As many points of a grid as are worked on at once.
template <Real Scalar>
struct GridPoints {
  static constexpr bool many = math::many_pays && std::is_same_v<Scalar, double>;
  using Type = std::conditional_t<many, Wide<Scalar>, OnePoint<Scalar>>;
  static constexpr int size = many ? wide_size<Scalar> : 1;

  GYROSTAT_INLINE static Type all(Scalar a) noexcept {
    if constexpr (many) return wide(a);
    else return {a};
  }
  GYROSTAT_INLINE static Type from(const Scalar* row) noexcept {
    if constexpr (many) return load_wide(row);
    else return {*row};
  }
  GYROSTAT_INLINE static Type root(const Type& a) noexcept {
    if constexpr (many) return square_root<Scalar>(a);
    else return {std::sqrt(a.x)};
  }
  /// a where the sign is below zero, else b.
  GYROSTAT_INLINE static Type choose(const Type& sign, const Type& a, const Type& b) noexcept {
    if constexpr (many) return gyrostat::choose<Scalar>(less<Scalar>(sign, wide(Scalar(0))), a, b);
    else return sign.x < 0 ? a : b;
  }
};

/// The powers of a turn by which rows of unit numbers are wound up: eight at once, and every further eight from those before.
template <Real Scalar>
struct Winding {
  math::Complex<Scalar> power[8], leap{1, 0};

  /// @param turns of one step, of which the whole ones do not count
  explicit Winding(const Fraction<Scalar>& turns) noexcept {
    const auto turn = math::unit(2 * pi<Scalar> * (turns.high + turns.low));
    for (auto& p : power) p = leap, leap = leap * turn;
  }
  /// z turn^k for k < n, and up to seven more.
  void wind(const math::Complex<Scalar>& z, Scalar* re, Scalar* im, int n) const noexcept {
    using Grid = GridPoints<Scalar>;
    for (int k = 0; k < 8; ++k) {
      const auto first = z * power[k];
      re[k] = first.re, im[k] = first.im;
    }
    const auto by_re = Grid::all(leap.re), by_im = Grid::all(leap.im);
    for (int k = 8; k < n; k += Grid::size) {
      const auto last_re = Grid::from(re + k - 8), last_im = Grid::from(im + k - 8);
      store(re + k, last_re * by_re - last_im * by_im);
      store(im + k, multiply_add(last_re, by_im, last_im * by_re));
    }
  }
};

/// The same of a real exponential.
template <Real Scalar>
struct Growth {
  Scalar power[8], leap = 1;

  explicit Growth(Scalar exponent) noexcept {
    const Scalar by = std::exp(exponent);
    for (auto& p : power) p = leap, leap *= by;
  }

  void grow(Scalar x, Scalar* to, int n) const noexcept {
    using Grid = GridPoints<Scalar>;
    for (int k = 0; k < 8; ++k) to[k] = x * power[k];
    const auto by = Grid::all(leap);
    for (int k = 8; k < n; k += Grid::size) store(to + k, Grid::from(to + k - 8) * by);
  }
};

}  // namespace gyrostat::free::detail
