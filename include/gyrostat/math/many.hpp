// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"

/// Arithmetic and functions of as many doubles as a register holds, written as for one (core/wide.hpp). Nothing branches: what is decided
/// is chosen number by number.
namespace gyrostat::math {

/// Whether the processor that is compiled for has registers and a fused product for Many: else the same takes longer than one by one.
#if defined(__GNUC__) && defined(__AVX2__) && defined(__FMA__)
inline constexpr bool many_pays = true;
#else
inline constexpr bool many_pays = false;
#endif

/// A yes or no for each of the numbers.
struct Choice {
  WideChoices<double> yes;

  GYROSTAT_INLINE unsigned bits() const noexcept { return gyrostat::bits<double>(yes); }  ///< 2^i for a yes of number i
  GYROSTAT_INLINE friend Choice operator&(const Choice& a, const Choice& b) noexcept { return {a.yes & b.yes}; }
  GYROSTAT_INLINE friend Choice operator|(const Choice& a, const Choice& b) noexcept { return {a.yes | b.yes}; }
};

struct Many {
  static constexpr int size = wide_size<double>;
  Wide<double> x;

  Many() = default;
  GYROSTAT_INLINE Many(const Wide<double>& a) noexcept : x(a) {}
  GYROSTAT_INLINE Many(double a) noexcept : x(wide(a)) {}
  GYROSTAT_INLINE static Many from(const double* memory) noexcept { return load_wide(memory); }
  GYROSTAT_INLINE void to(double* memory) const noexcept { store(memory, x); }
  GYROSTAT_INLINE double operator[](int i) const noexcept { return x[i]; }

  GYROSTAT_INLINE friend Many operator+(const Many& a, const Many& b) noexcept { return a.x + b.x; }
  GYROSTAT_INLINE friend Many operator-(const Many& a, const Many& b) noexcept { return a.x - b.x; }
  GYROSTAT_INLINE friend Many operator*(const Many& a, const Many& b) noexcept { return a.x * b.x; }
  GYROSTAT_INLINE friend Many operator/(const Many& a, const Many& b) noexcept { return a.x / b.x; }
  GYROSTAT_INLINE friend Many operator-(const Many& a) noexcept { return wide(-0.0) - a.x; }
  GYROSTAT_INLINE Many& operator+=(const Many& a) noexcept { return *this = *this + a; }
  GYROSTAT_INLINE Many& operator-=(const Many& a) noexcept { return *this = *this - a; }
  GYROSTAT_INLINE Many& operator*=(const Many& a) noexcept { return *this = *this * a; }
  GYROSTAT_INLINE friend Choice operator<(const Many& a, const Many& b) noexcept { return {less<double>(a.x, b.x)}; }
  GYROSTAT_INLINE friend Choice operator>(const Many& a, const Many& b) noexcept { return b < a; }
};

inline constexpr unsigned all_numbers = (1u << Many::size) - 1;  ///< bits of a Choice that says yes to every number

GYROSTAT_INLINE Many choose(const Choice& c, const Many& a, const Many& b) noexcept {
  return gyrostat::choose<double>(c.yes, a.x, b.x);
}
/// a b + c, rounded once where the machine has the instruction.
GYROSTAT_INLINE Many fused(const Many& a, const Many& b, const Many& c) noexcept { return multiply_add(a.x, b.x, c.x); }
/// a b - product, exact where the product is that of a and b rounded.
GYROSTAT_INLINE Many rounding_of(const Many& product, const Many& a, const Many& b) noexcept {
#if defined(__FMA__)
  return fused(a, b, -product);
#else
  double rest[Many::size];
  for (int i = 0; i < Many::size; ++i) rest[i] = std::fma(a[i], b[i], -product[i]);
  return Many::from(rest);
#endif
}
GYROSTAT_INLINE Many sqrt(const Many& a) noexcept { return square_root<double>(a.x); }
GYROSTAT_INLINE Many max(const Many& a, const Many& b) noexcept { return greater_of<double>(a.x, b.x); }
GYROSTAT_INLINE Many min(const Many& a, const Many& b) noexcept { return choose(a < b, a, b); }
GYROSTAT_INLINE Many abs(const Many& a) noexcept { return max(a, -a); }
/// The nearest whole number, |a| < 2^51.
GYROSTAT_INLINE Many nearest(const Many& a) noexcept { return (a + 0x1.8p52) - 0x1.8p52; }

/// a_0 + a_1 x + a_2 x^2 ...
template <int N>
GYROSTAT_INLINE Many polynomial(const double (&a)[N], const Many& x) noexcept {
  Many sum = a[N - 1];
  for (int i = N - 2; i >= 0; --i) sum = fused(sum, x, a[i]);
  return sum;
}

struct ManyCircle {
  Many c, s;
};

/// cos and sin of 2 pi x, |x| < 2^49; errors of 2 eps.
GYROSTAT_INLINE ManyCircle circle(const Many& x) noexcept {
  constexpr double sine[] = {-1. / 6,        1. / 120,         -1. / 5040,           1. / 362880,
                             -1. / 39916800, 1. / 6227020800., -1. / 1307674368000., 1. / 355687428096000.};
  constexpr double cosine[] = {1. / 24,        -1. / 720,          1. / 40320,          -1. / 3628800,
                               1. / 479001600, -1. / 87178291200., 1. / 20922789888000.};
  const Many quarters = nearest(4 * x), z = 2 * pi<double> * fused(quarters, -0.25, x), z2 = z * z;
  const Many s = fused(z * z2, polynomial(sine, z2), z), c = 1 - (0.5 * z2 - z2 * z2 * polynomial(cosine, z2));
  // quarters modulo 4, -2 to 2
  const Many n = quarters - 4 * nearest(0.25 * quarters), size = abs(n);
  const Choice odd = (size > 0.5) & (size < 1.5), turned = size > 1.5;
  const Many first = choose(odd, s, c), second = choose(odd, c, s);
  return {choose(turned | (n > 0.5), -first, first), choose(turned | (n < -0.5), -second, second)};
}

/// exp x, -700 < x < 700; relative error 2 eps.
GYROSTAT_INLINE Many exp(const Many& x) noexcept {
  constexpr double rest[] = {0.5,           1. / 6,         1. / 24,         1. / 120,
                             1. / 720,      1. / 5040,      1. / 40320,      1. / 362880.,
                             1. / 3628800., 1. / 39916800., 1. / 479001600., 1. / 6227020800.};
  const Many k = nearest(x * 0x1.71547652b82fep0);
  const Many r = fused(k, -0x1.a39ef35793c76p-33, fused(k, -0x1.62e42feep-1, x));
  const Many part = 1 + (r + r * r * polynomial(rest, r));
#if defined(__GNUC__) && defined(__AVX512F__)
  return Wide<double>{_mm512_maskz_scalef_pd(0xff, part.x.v, k.x.v)};
#else
  double numbers[Many::size];
  (k + 0x1.8p52).to(numbers);
  for (double& n : numbers) n = std::bit_cast<double>((std::bit_cast<std::uint64_t>(n) + 1023) << 52);
  return part * Many::from(numbers);
#endif
}

/// K and K' by arithmetic-geometric means, kp2 from 1e-4 to 1, k2 from 1e-20.
struct ManyPeriods {
  Many K, Kp;
};
GYROSTAT_INLINE ManyPeriods quarter_periods(const Many& k2, const Many& kp2) noexcept {
  Many a[2] = {1, 1}, b[2] = {sqrt(kp2), sqrt(k2)};
  const auto advance = [&](int n) GYROSTAT_INLINE_LAMBDA {
    const Many mean = 0.5 * (a[n] + b[n]);
    b[n] = sqrt(a[n] * b[n]);
    a[n] = mean;
  };
  for (int trip = 0; trip < 5; ++trip) advance(0), advance(1);
  for (int trip = 0; trip < 2; ++trip) advance(1);
  return {pi<double> / (a[0] + b[0]), pi<double> / (a[1] + b[1])};
}

/// Carlson's R_F(x, y, 1) of N pairs at once, x and y from 1e-18 to 1e6: by duplication, each until it is within reach of the series, so that none
/// hangs on those beside it.
template <int N>
GYROSTAT_INLINE void carlson_RF(Many (&x)[N], Many (&y)[N], Many (&result)[N]) noexcept {
  constexpr double reach = 0.052;  // (2 eps)^(1/12), carlson_RF_reach
  Many z[N], mean[N], a[N], b[N];
  for (int n = 0; n < N; ++n) z[n] = 1;
  for (int trip = 0; trip < 14; ++trip) {
    Choice far[N];
    unsigned some = 0;
    for (int n = 0; n < N; ++n) {
      mean[n] = (x[n] + y[n] + z[n]) * (1. / 3);
      a[n] = mean[n] - x[n], b[n] = mean[n] - y[n];
      far[n] = max(max(abs(a[n]), abs(b[n])), abs(a[n] + b[n])) > reach * mean[n];
      some |= far[n].bits();
    }
    if (some == 0) break;
    for (int n = 0; n < N; ++n) {
      const Many rx = sqrt(x[n]), ry = sqrt(y[n]), rz = sqrt(z[n]), lambda = fused(rx, ry + rz, ry * rz);
      x[n] = choose(far[n], 0.25 * (x[n] + lambda), x[n]);
      y[n] = choose(far[n], 0.25 * (y[n] + lambda), y[n]);
      z[n] = choose(far[n], 0.25 * (z[n] + lambda), z[n]);
    }
  }
  for (int n = 0; n < N; ++n) {
    const Many inverse = 1 / mean[n], X = a[n] * inverse, Y = b[n] * inverse, Z = -(X + Y);
    // detail::series_RF
    const Many e2 = X * Y - Z * Z, e3 = X * Y * Z;
    const double alone[] = {-1. / 10, 1. / 24, -5. / 208, 35. / 2176, -3. / 256};
    const double once[] = {1. / 14, -3. / 44, 1. / 16, -35. / 608, 315. / 5888};
    const double twice[] = {3. / 104, -15. / 272, 5. / 64}, thrice[] = {5. / 304, -35. / 736};
    const Many rest = polynomial(once, e2) + e3 * (polynomial(twice, e2) + e3 * polynomial(thrice, e2));
    result[n] = (1 + (e2 * polynomial(alone, e2) + e3 * rest)) / sqrt(mean[n]);
  }
}

}  // namespace gyrostat::math
