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
/// 1/sqrt a, a from 1e-300; error 2 eps.
GYROSTAT_INLINE Many inverse_sqrt(const Many& a) noexcept { return inverse_square_root<double>(a.x); }
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

/// The angle in (0, pi) whose cotangent is over/under, as a part of pi; under > 0, over may be infinite.
GYROSTAT_INLINE Many angle_of_cotangent(const Many& over, const Many& under) noexcept {
  // (atan t - t)/t^3 by t^2, a polynomial through the zeros of Chebyshev's on 0 <= t <= sqrt 2 - 1: error of atan below 6e-18 t
  constexpr double rest[] = {-0.33333333333333331,  0.19999999999995521,  -0.14285714284666542,  0.11111111015256361,
                             -0.090909045781239026, 0.076921831908260865, -0.066645114473819475, 0.0585814891280221,
                             -0.050854497379402598, 0.039231658295587189, -0.01917688711906226};
  constexpr double bound = 0.41421356237309503;
  const Many size = abs(over), reach = bound * size, most = bound * under;
  const Choice narrow = reach > under, wide = size < most;
  const Many above = choose(narrow, under, choose(wide, -size, under - size)),
             below = choose(narrow, size, choose(wide, under, under + size));
  const Many t = above / below, t2 = t * t, part = fused(t * t2, polynomial(rest, t2), t) * (1 / pi<double>);
  const Many angle = choose(narrow, part, choose(wide, 0.5 + part, 0.25 + part));
  return choose(over < 0., 1 - angle, angle);
}

/// Integrals of the first kind, K of the modulus k and K' of k', and of each one that is incomplete, by the cotangent of its amplitude, not negative:
/// F as a part of 4 K, and F' of k' as it is. By Landen's transformation, with the means that K is made of (Bulirsch 1965); each goes on until it is
/// within rounding, so that no number depends on those beside it. k2 and kp2 from 1e-16 to 1.
struct ManyIntegrals {
  Many K, Kp, F_part, Fp;
};
GYROSTAT_INLINE ManyIntegrals first_kind(const Many& k2, const Many& kp2, const Many& cotangent,
                                         const Many& cotangent_of_p) noexcept {
  Many mean[2] = {1, 1}, other[2] = {sqrt(kp2), sqrt(k2)}, doubled[2] = {1, 1};
  Many y[2] = {max(cotangent, 0.), max(cotangent_of_p, 0.)};  // without -0
  Many turned[2] = {0, 0};                                    // whole multiples of pi in the amplitude
  Choice going[2] = {k2 < 2., k2 < 2.};
  for (int trip = 0; trip < 9; ++trip) {
    Many product[2];
    unsigned some = 0;
    for (int n = 0; n < 2; ++n) {
      product[n] = mean[n] * other[n];
      const Many sum = mean[n] + other[n], apart = abs(mean[n] - other[n]);
      turned[n] = choose(going[n], 2 * turned[n] + choose(y[n] < 0., 1., 0.), turned[n]);
      y[n] = choose(going[n], y[n] - product[n] / y[n], y[n]);
      doubled[n] = choose(going[n], doubled[n] + doubled[n], doubled[n]);
      mean[n] = choose(going[n], sum, mean[n]);
      going[n] = going[n] & (apart > 2e-8 * sum);
      some |= going[n].bits();
    }
    if (some == 0) break;
    for (int n = 0; n < 2; ++n) other[n] = choose(going[n], 2 * sqrt(product[n]), other[n]);
  }
  for (int n = 0; n < 2; ++n) turned[n] += angle_of_cotangent(y[n], mean[n]);
  const Many per_mean[2] = {pi<double> / mean[0], pi<double> / mean[1]}, part = 0.5 / doubled[0];
  return {0.5 * (doubled[0] * per_mean[0]), 0.5 * (doubled[1] * per_mean[1]), part * turned[0],
          turned[1] * per_mean[1]};
}

}  // namespace gyrostat::math
