// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// What a double holds to the last bit.
template <class T>
concept OneWord = std::same_as<T, double> || std::same_as<T, float> || (std::integral<T> && sizeof(T) <= 4);

/// A number of about 106 bits as the unevaluated sum of two doubles, |low| no more than half a unit in the last place of high (Dekker
/// 1971). With the exponents of double. Sums, products, quotients and roots have a relative error of a few epsilon = 2^-104, the
/// elementary functions below of some tens. Needs rounding to nearest and no reordering by the compiler (-ffast-math).
struct DoubleDouble {
  double high = 0, low = 0;

  constexpr DoubleDouble() = default;
  template <class T>
    requires std::integral<T>
  constexpr DoubleDouble(T x) noexcept {
    if constexpr (sizeof(T) <= 4) {
      high = static_cast<double>(x);
    } else {
      constexpr T half = T(1) << 32;
      *this = quick_sum(static_cast<double>(x / half) * 4294967296.0, static_cast<double>(x % half));
    }
  }
  template <class T>
    requires std::floating_point<T>
  constexpr DoubleDouble(T x) noexcept : high(static_cast<double>(x)) {
    if constexpr (sizeof(T) > sizeof(double))
      if (x - x == 0) low = static_cast<double>(x - static_cast<T>(high));
  }
  constexpr DoubleDouble(double h, double l) noexcept : high(h), low(l) {}

  template <class T>
    requires std::floating_point<T>
  constexpr explicit operator T() const noexcept {
    return static_cast<T>(high) + static_cast<T>(low);
  }
  /// Truncated.
  template <class T>
    requires(std::integral<T> && sizeof(T) <= 4)
  constexpr explicit operator T() const noexcept {
    const T whole = static_cast<T>(high);
    if (static_cast<double>(whole) != high) return whole;
    return static_cast<T>(whole - (high > 0 && low < 0 ? 1 : 0) + (high < 0 && low > 0 ? 1 : 0));
  }

  /// a + b, |a| >= |b| or a = 0, with its rounding error (Dekker 1971).
  static constexpr DoubleDouble quick_sum(double a, double b) noexcept {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  /// a + b with its rounding error (Knuth 1969).
  static constexpr DoubleDouble sum(double a, double b) noexcept {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  static DoubleDouble product(double a, double b) noexcept {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }

  // by value: both words travel in registers
  friend constexpr DoubleDouble operator+(DoubleDouble a) noexcept { return a; }
  friend constexpr DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.high, -a.low}; }
  friend constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
    const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low);
    if (!(s.high - s.high == 0)) return {s.high, 0};  // infinite or NaN
    const DoubleDouble u = quick_sum(s.high, s.low + t.high);
    return quick_sum(u.high, u.low + t.low);
  }
  friend constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + (-b); }
  friend DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
    const DoubleDouble p = product(a.high, b.high);
    if (!(p.high - p.high == 0)) return {p.high, 0};
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  /// What the first quotient leaves is exact but for the low word of b (Joldes, Muller and Popescu 2017).
  friend DoubleDouble operator/(DoubleDouble a, DoubleDouble b) noexcept {
    const double first = a.high / b.high;
    if (!(first - first == 0) || b.high - b.high != 0) return {first, 0};
    const double rest = std::fma(-first, b.high, a.high) + std::fma(-first, b.low, a.low);
    return quick_sum(first, rest / b.high);
  }
  DoubleDouble& operator+=(DoubleDouble b) noexcept { return *this = *this + b; }
  DoubleDouble& operator-=(DoubleDouble b) noexcept { return *this = *this - b; }
  DoubleDouble& operator*=(DoubleDouble b) noexcept { return *this = *this * b; }
  DoubleDouble& operator/=(DoubleDouble b) noexcept { return *this = *this / b; }

  // one of the two in one word
  friend constexpr DoubleDouble operator+(DoubleDouble a, OneWord auto b) noexcept {
    const DoubleDouble s = sum(a.high, double(b));
    if (!(s.high - s.high == 0)) return {s.high, 0};
    return quick_sum(s.high, s.low + a.low);
  }
  friend constexpr DoubleDouble operator+(OneWord auto a, DoubleDouble b) noexcept { return b + a; }
  friend constexpr DoubleDouble operator-(DoubleDouble a, OneWord auto b) noexcept { return a + -double(b); }
  friend constexpr DoubleDouble operator-(OneWord auto a, DoubleDouble b) noexcept { return -b + a; }
  friend DoubleDouble operator*(DoubleDouble a, OneWord auto b) noexcept {
    const DoubleDouble p = product(a.high, double(b));
    if (!(p.high - p.high == 0)) return {p.high, 0};
    return quick_sum(p.high, p.low + a.low * double(b));
  }
  friend DoubleDouble operator*(OneWord auto a, DoubleDouble b) noexcept { return b * a; }
  friend DoubleDouble operator/(DoubleDouble a, OneWord auto b) noexcept {
    const double first = a.high / double(b);
    if (!(first - first == 0) || double(b) - double(b) != 0) return {first, 0};
    const double rest = std::fma(-first, double(b), a.high) + a.low;
    return quick_sum(first, rest / double(b));
  }

  friend constexpr bool operator==(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return a.high == b.high && a.low == b.low;
  }
  friend constexpr bool operator<(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }
  friend constexpr bool operator>(const DoubleDouble& a, const DoubleDouble& b) noexcept { return b < a; }
  friend constexpr bool operator<=(const DoubleDouble& a, const DoubleDouble& b) noexcept { return a < b || a == b; }
  friend constexpr bool operator>=(const DoubleDouble& a, const DoubleDouble& b) noexcept { return b <= a; }
};

template <>
inline constexpr bool is_real_class<DoubleDouble> = true;

template <>
inline constexpr DoubleDouble pi<DoubleDouble> = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

/// Whether the high word, and so the number, is NaN.
inline bool isnan(const DoubleDouble& x) noexcept { return std::isnan(x.high); }
/// Whether it is infinite, of either sign.
inline bool isinf(const DoubleDouble& x) noexcept { return std::isinf(x.high); }
/// Whether it is neither NaN nor infinite.
inline bool isfinite(const DoubleDouble& x) noexcept { return std::isfinite(x.high); }
/// Whether it has a minus sign, -0 too.
inline bool signbit(const DoubleDouble& x) noexcept { return std::signbit(x.high); }
/// |x|, exact; NaN of NaN.
inline DoubleDouble abs(const DoubleDouble& x) noexcept { return std::signbit(x.high) ? -x : x; }
/// abs() by its other name.
inline DoubleDouble fabs(const DoubleDouble& x) noexcept { return abs(x); }
/// x with the sign of `sign`, exact.
inline DoubleDouble copysign(const DoubleDouble& x, const DoubleDouble& sign) noexcept {
  return std::signbit(x.high) == std::signbit(sign.high) ? x : -x;
}

/// The nearest whole number; halves to the even one, or to a neighbour where the low word decides.
inline DoubleDouble nearbyint(const DoubleDouble& x) noexcept {
  const double n = std::nearbyint(x.high);
  if (n == x.high) return DoubleDouble::quick_sum(n, std::nearbyint(x.low));
  const double over = x.high - n;  // exact
  if (std::abs(over) == 0.5 && x.low != 0 && (over > 0) == (x.low > 0)) return n + (over > 0 ? 1 : -1);
  return n;
}

/// The greatest whole number that is not above x, exact.
inline DoubleDouble floor(const DoubleDouble& x) noexcept {
  const double n = std::floor(x.high);
  return n == x.high ? DoubleDouble::quick_sum(n, std::floor(x.low)) : DoubleDouble(n);
}

/// x 2^n, exact but for underflow.
inline DoubleDouble ldexp(const DoubleDouble& x, int n) noexcept {
  return {std::ldexp(x.high, n), std::ldexp(x.low, n)};
}

/// a b + c, rounded as a product and a sum are.
inline DoubleDouble fma(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c) noexcept {
  return a * b + c;
}

/// NaN for x < 0. A step of Newton's method from the root of the high word.
inline DoubleDouble sqrt(const DoubleDouble& x) noexcept {
  const double root = std::sqrt(x.high);
  if (!(x.high > 0) || std::isinf(x.high)) return root;
  return DoubleDouble::quick_sum(root, (std::fma(-root, root, x.high) + x.low) / (2 * root));
}

/// sqrt(x^2 + y^2), whose squares do not overflow. Infinite where the larger is.
inline DoubleDouble hypot(const DoubleDouble& x, const DoubleDouble& y) noexcept {
  const DoubleDouble a = abs(x) < abs(y) ? abs(y) : abs(x), b = abs(x) < abs(y) ? abs(x) : abs(y);
  if (a.high == 0 || std::isinf(a.high)) return a;
  const DoubleDouble ratio = b / a;
  return a * sqrt(1 + ratio * ratio);
}
/// sqrt(x^2 + y^2 + z^2), likewise.
inline DoubleDouble hypot(const DoubleDouble& x, const DoubleDouble& y, const DoubleDouble& z) noexcept {
  return hypot(hypot(x, y), z);
}

/// By the power series of exp(r/256) - 1 and eight squarings.
inline DoubleDouble exp(const DoubleDouble& x) noexcept {
  if (!(std::abs(x.high) < 709)) return std::exp(x.high);
  constexpr DoubleDouble ln2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  // 1/k
  constexpr DoubleDouble inverse[] = {{0x1.0000000000000p+0, 0x0.0p+0},
                                      {0x1.0000000000000p-1, 0x0.0p+0},
                                      {0x1.5555555555555p-2, 0x1.5555555555555p-56},
                                      {0x1.0000000000000p-2, 0x0.0p+0},
                                      {0x1.999999999999ap-3, -0x1.999999999999ap-57},
                                      {0x1.5555555555555p-3, 0x1.5555555555555p-57},
                                      {0x1.2492492492492p-3, 0x1.2492492492492p-57},
                                      {0x1.0000000000000p-3, 0x0.0p+0},
                                      {0x1.c71c71c71c71cp-4, 0x1.c71c71c71c71cp-58},
                                      {0x1.999999999999ap-4, -0x1.999999999999ap-58},
                                      {0x1.745d1745d1746p-4, -0x1.745d1745d1746p-59},
                                      {0x1.5555555555555p-4, 0x1.5555555555555p-58}};
  const double n = std::nearbyint(x.high / ln2.high);
  const DoubleDouble r = ldexp(x - n * ln2, -8);
  DoubleDouble rest = 0;
  for (int k = 12; k >= 1; --k) rest = r * inverse[k - 1] * (1 + rest);
  for (int i = 0; i < 8; ++i) rest = rest * (2 + rest);
  return ldexp(1 + rest, static_cast<int>(n));
}

/// One step of Newton's method on exp from the logarithm of the high word.
inline DoubleDouble log(const DoubleDouble& x) noexcept {
  const double first = std::log(x.high);
  if (!std::isfinite(first)) return first;
  const DoubleDouble off = x * exp(-DoubleDouble(first)) - 1;
  return first + (off - off * off / 2);
}

namespace detail {

/// sin x and cos x by the power series, |x| <= pi/4 or little more.
struct SineCosineSeries {
  DoubleDouble s, c;
  explicit SineCosineSeries(const DoubleDouble& x) noexcept : s(0), c(0) {
    const DoubleDouble square = x * x;
    for (int k = 14; k >= 1; --k) {
      s = square / ((2 * k) * (2 * k + 1)) * (1 - s);
      c = square / ((2 * k - 1) * (2 * k)) * (1 - c);
    }
    s = x - x * s;
    c = 1 - c;
  }
};

/// Both at once.
struct SineCosine {
  DoubleDouble s = nan<double>, c = nan<double>;
};

/// x less the nearest multiple of pi/2 (three words of pi/2), and the multiple modulo 4. |x| < 2^50.
struct QuarterTurn {
  DoubleDouble rest;
  int quarter;
  explicit QuarterTurn(const DoubleDouble& x) noexcept {
    const double n = std::nearbyint(x.high * 0x1.45f306dc9c883p-1);
    rest = ((x - DoubleDouble::product(n, 0x1.921fb54442d18p+0)) - DoubleDouble::product(n, 0x1.1a62633145c07p-54)) -
           n * -0x1.f1976b7ed8fbcp-110;
    quarter = static_cast<int>(n - 4 * std::floor(n / 4));
  }
};

inline SineCosine sine_cosine(const DoubleDouble& x) noexcept {
  if (!(std::abs(x.high) < 0x1p50)) return {};
  const QuarterTurn turn(x);
  const SineCosineSeries at(turn.rest);
  const bool odd = turn.quarter % 2, back = turn.quarter >= 2, left = turn.quarter == 1 || turn.quarter == 2;
  const DoubleDouble s = odd ? at.c : at.s, c = odd ? at.s : at.c;
  return {back ? -s : s, left ? -c : c};
}

}  // namespace detail

/// NaN for |x| >= 2^50.
inline DoubleDouble sin(const DoubleDouble& x) noexcept { return detail::sine_cosine(x).s; }
/// As sin(): x in rad, NaN from |x| = 2^50 on.
inline DoubleDouble cos(const DoubleDouble& x) noexcept { return detail::sine_cosine(x).c; }

/// One step of Newton's method from the angle of the high words.
inline DoubleDouble atan2(const DoubleDouble& y, const DoubleDouble& x) noexcept {
  const double first = std::atan2(y.high, x.high);
  const DoubleDouble size = hypot(x, y);
  if (!(size.high > 0) || !std::isfinite(size.high)) return first;
  const auto at = detail::sine_cosine(first);
  return first + (y * at.c - x * at.s) / size;
}
/// In [-pi/2, pi/2], rad; NaN for |x| > 1.
inline DoubleDouble asin(const DoubleDouble& x) noexcept { return atan2(x, sqrt((1 - x) * (1 + x))); }

}  // namespace gyrostat::inline GYROSTAT_LEVEL

template <>
struct std::numeric_limits<gyrostat::DoubleDouble> : std::numeric_limits<double> {
  static constexpr int digits = 105;
  static constexpr int digits10 = 31;
  static constexpr int max_digits10 = 33;
  static constexpr gyrostat::DoubleDouble epsilon() noexcept { return 0x1p-104; }
  static constexpr gyrostat::DoubleDouble min() noexcept { return 0x1p-916; }  // where the low word is normal too
  static constexpr gyrostat::DoubleDouble max() noexcept { return {0x1.fffffffffffffp+1023, 0x1.fffffffffffffp+969}; }
  static constexpr gyrostat::DoubleDouble lowest() noexcept { return -max(); }
  static constexpr gyrostat::DoubleDouble infinity() noexcept { return std::numeric_limits<double>::infinity(); }
  static constexpr gyrostat::DoubleDouble quiet_NaN() noexcept { return std::numeric_limits<double>::quiet_NaN(); }
};
