// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// A complex number as two numbers: sums and products are the plain formulas, without the recovery of infinities that
/// std::complex owes its callers and pays for with a call.
template <Real Scalar>
struct Complex {
  Scalar re = 0;
  Scalar im = 0;

  friend constexpr bool operator==(const Complex&, const Complex&) = default;
  friend constexpr Complex operator+(Complex a, Complex b) noexcept { return {a.re + b.re, a.im + b.im}; }
  friend constexpr Complex operator-(Complex a, Complex b) noexcept { return {a.re - b.re, a.im - b.im}; }
  friend constexpr Complex operator-(Complex a) noexcept { return {-a.re, -a.im}; }
  friend constexpr Complex operator*(Complex a, Complex b) noexcept {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend constexpr Complex operator*(Scalar a, Complex b) noexcept { return {a * b.re, a * b.im}; }
  friend constexpr Complex operator/(Complex a, Scalar b) noexcept { return {a.re / b, a.im / b}; }
};

template <Real Scalar>
constexpr Complex<Scalar> conjugate(Complex<Scalar> a) noexcept {
  return {a.re, -a.im};
}

/// i a.
template <Real Scalar>
constexpr Complex<Scalar> turned(Complex<Scalar> a) noexcept {
  return {-a.im, a.re};
}

/// |a|, without overflow of the squares.
template <Real Scalar>
Scalar magnitude(Complex<Scalar> a) noexcept {
  using std::hypot;
  return hypot(a.re, a.im);
}

/// |a| or up to 8 % more, without a root.
template <Real Scalar>
constexpr Scalar magnitude_at_most(Complex<Scalar> a) noexcept {
  const Scalar x = a.re < 0 ? -a.re : a.re, y = a.im < 0 ? -a.im : a.im;
  constexpr Scalar chord = Scalar(0.4142135623730951L);  // above sqrt(2) - 1
  return x > y ? x + chord * y : y + chord * x;
}

/// 1/a, without overflow of the squares.
template <Real Scalar>
Complex<Scalar> inverse(Complex<Scalar> a) noexcept {
  const Scalar size = magnitude(a);
  return conjugate(a / size) / size;
}

/// e^a; of length one to rounding where a.re = 0.
template <Real Scalar>
Complex<Scalar> exponential(Complex<Scalar> a) noexcept {
  using std::cos, std::exp, std::sin;
  const Scalar size = a.re == 0 ? Scalar(1) : exp(a.re);
  return {size * cos(a.im), size * sin(a.im)};
}

/// e^(i angle).
template <Real Scalar>
Complex<Scalar> unit(Scalar angle) noexcept {
  using std::cos, std::sin;
  return {cos(angle), sin(angle)};
}

template <Real To, Real From>
constexpr Complex<To> complex_cast(Complex<From> a) noexcept {
  return {static_cast<To>(a.re), static_cast<To>(a.im)};
}

}  // namespace gyrostat::math
