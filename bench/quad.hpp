// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "gyrostat/rotation/vector_double_double.hpp"

/// A number of 113 bits, in software: what a truth by Taylor series needs, and no more.
struct Quad {
  __float128 v = 0;

  constexpr Quad() = default;
  template <class T>
    requires std::integral<T> || std::floating_point<T>
  constexpr Quad(T x) noexcept : v(x) {}
  constexpr Quad(const gyrostat::DoubleDouble& x) noexcept : v(__float128(x.high) + x.low) {}
  static constexpr Quad of(__float128 x) noexcept {
    Quad q;
    q.v = x;
    return q;
  }
  template <class T>
    requires std::integral<T> || std::floating_point<T>
  constexpr explicit operator T() const noexcept {
    return static_cast<T>(v);
  }

  friend constexpr Quad operator-(const Quad& a) noexcept { return of(-a.v); }
  friend constexpr Quad operator+(const Quad& a, const Quad& b) noexcept { return of(a.v + b.v); }
  friend constexpr Quad operator-(const Quad& a, const Quad& b) noexcept { return of(a.v - b.v); }
  friend constexpr Quad operator*(const Quad& a, const Quad& b) noexcept { return of(a.v * b.v); }
  friend constexpr Quad operator/(const Quad& a, const Quad& b) noexcept { return of(a.v / b.v); }
  constexpr Quad& operator+=(const Quad& b) noexcept { return *this = *this + b; }
  constexpr Quad& operator-=(const Quad& b) noexcept { return *this = *this - b; }
  constexpr Quad& operator*=(const Quad& b) noexcept { return *this = *this * b; }
  constexpr Quad& operator/=(const Quad& b) noexcept { return *this = *this / b; }
  friend constexpr bool operator==(const Quad& a, const Quad& b) noexcept { return a.v == b.v; }
  friend constexpr bool operator<(const Quad& a, const Quad& b) noexcept { return a.v < b.v; }
  friend constexpr bool operator>(const Quad& a, const Quad& b) noexcept { return a.v > b.v; }
  friend constexpr bool operator<=(const Quad& a, const Quad& b) noexcept { return a.v <= b.v; }
  friend constexpr bool operator>=(const Quad& a, const Quad& b) noexcept { return a.v >= b.v; }
};

template <>
inline constexpr bool gyrostat::is_real_class<Quad> = true;

constexpr Quad abs(const Quad& x) noexcept { return x.v < 0 ? -x : x; }

/// Two steps of Newton's method from the root in double, whose exponents it keeps to.
inline Quad sqrt(const Quad& x) noexcept {
  const double rough = std::sqrt(static_cast<double>(x.v));
  if (!(rough > 0) || std::isinf(rough)) return rough;
  Quad root = rough;
  for (int step = 0; step < 2; ++step) root = (root + x / root) / 2;
  return root;
}

inline Quad hypot(const Quad& x, const Quad& y) noexcept { return sqrt(x * x + y * y); }

template <>
struct std::numeric_limits<Quad> : std::numeric_limits<double> {
  static constexpr int digits = 113;
  static constexpr int digits10 = 33;
  static constexpr int max_digits10 = 36;
  static constexpr Quad epsilon() noexcept { return 0x1p-112; }
  static constexpr Quad min() noexcept { return 0x1p-900; }
  static constexpr Quad max() noexcept { return 0x1p1000; }
  static constexpr Quad lowest() noexcept { return -0x1p1000; }
  static constexpr Quad infinity() noexcept { return std::numeric_limits<double>::infinity(); }
  static constexpr Quad quiet_NaN() noexcept { return std::numeric_limits<double>::quiet_NaN(); }
};

template <>
struct Eigen::NumTraits<Quad> : Eigen::GenericNumTraits<Quad> {
  using Real = Quad;
  using NonInteger = Quad;
  using Nested = Quad;
  using Literal = Quad;
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 0,
    ReadCost = 2,
    AddCost = 30,
    MulCost = 30
  };
};
