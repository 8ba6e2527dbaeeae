// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/free/frame.hpp"

namespace gyrostat::free {

/// Two entire functions of u,
///     two components:  zeta = (theta_4(z + i delta y | q^2), theta_1(z + i delta y | q^2))
///     one component:   zeta = (A theta_1(z + i delta y | q), B theta_3(z + i delta y | q)),
/// z = pi u/(2 K), y = pi eta/(2 K), q = exp(-pi K'/K) (theta functions as in DLMF 20.2), up to a common factor; as short sums in E, with
/// nomes of exp(-pi) at most:
///     trigonometric   E = exp(i z)      K <= 2 K' (two components), K <= K' (one)
///     hyperbolic      E = exp(h u)      else, after Jacobi's imaginary transformation; h = pi/(4 K') (two), pi/(2 K') (one); |u| <= K
/// On a separatrix, K infinite, two exponentials are left.
template <Real Scalar>
struct ThetaPair {
  static constexpr int most = 16;  ///< powers of E, enough for epsilon = 2^-104
  using C = math::Complex<Scalar>;

  bool hyperbolic = false, single = false;
  int powers = 0;                     ///< the highest power of E
  Scalar x[most] = {}, y[most] = {};  ///< coefficients; see at()
  Scalar h = 1;                       ///< E = exp(i h u) or exp(h u)
  Scalar K = 0, Kp = 0;

  /// zeta_1, zeta_2 from E^m and E^-m. Trigonometric: these are cos mz +- i sin mz.
  struct Value {
    C one, two;
  };

  ThetaPair() = default;
  explicit ThetaPair(const SpinorFrame<Scalar>& frame) noexcept : single(frame.form == PathForm::single) {
    K = math::complete(frame.modulus).K;
    Kp = frame.eta + frame.eta_rest;
    hyperbolic = single ? frame.modulus.k2 > frame.modulus.kp2 : frame.form == PathForm::separatrix;
    if (!hyperbolic) trigonometric_sums(frame);
    else hyperbolic_sums(frame);
    if (single) scale(frame);
  }

  /// At E = exp(i angle), |angle| <= pi, or E = exp(exponent) (1 + rest).
  Value at(Scalar exponent, Scalar rest = 0) const noexcept {
    using std::cos, std::exp, std::sin;
    if (!hyperbolic) return trigonometric(cos(exponent), sin(exponent));
    const Scalar E = exp(exponent), up = E + E * rest;
    return hyperbolic_at(up, 1 / up);
  }

  /// What zeta_1 and zeta_2 are summed of, all terms by their sizes: more than these where terms that grow and fall nearly cancel.
  std::array<Scalar, 2> terms(Scalar exponent, const Value& value) const noexcept {
    using std::abs, std::exp, std::sqrt;
    std::array<Scalar, 2> sizes{sqrt(value.one.re * value.one.re + value.one.im * value.one.im),
                                sqrt(value.two.re * value.two.re + value.two.im * value.two.im)};
    if (!hyperbolic) return sizes;
    const Scalar up = exp(exponent), down = 1 / up;
    Scalar rise = 1, fall = 1, sums[2] = {0, single ? abs(x[0]) : Scalar(0)};
    for (int m = 1; m <= powers; ++m) {
      rise *= up, fall *= down;
      const Scalar size = abs(x[m]) + abs(y[m]), turned = single || m % 4 == 1 ? rise : fall;
      if (single) sums[m % 2 == 0] += size * (rise + fall);
      else if (m & 1) sums[0] += size * turned, sums[1] += size * (rise + fall - turned);
    }
    return {std::max(sizes[0], sums[0]), std::max(sizes[1], sums[1])};
  }

  /// Even powers of E = c + i s belong to one function, odd ones to the other.
  Value trigonometric(Scalar c, Scalar s) const noexcept {
    C sum[2] = {{x[0], Scalar(0)}, {Scalar(0), Scalar(0)}}, power{1, 0};
    const C E{c, s};
    for (int m = 1; m <= powers; ++m) {
      power = power * E;
      C& to = sum[m & 1];
      to.re += x[m] * power.re;
      to.im += y[m] * power.im;
    }
    const C odd{sum[1].im, -sum[1].re};
    return single ? Value{odd, sum[0]} : Value{sum[0], odd};
  }

  Value hyperbolic_at(Scalar up, Scalar down) const noexcept {
    Scalar rise = 1, fall = 1;
    if (!single) {  // x + i y goes with E^m for m = 1, 5, 9 and E^-m for m = 3, 7
      C one{0, 0}, two{0, 0};
      const Scalar up2 = up * up, down2 = down * down;
      rise = up, fall = down;
      for (int m = 1; m <= powers; m += 4) {
        one.re += x[m] * rise + x[m + 2] * (fall * down2), one.im += y[m] * rise + y[m + 2] * (fall * down2);
        two.re -= x[m] * fall + x[m + 2] * (rise * up2), two.im += y[m] * fall + y[m + 2] * (rise * up2);
        rise *= up2 * up2;
        fall *= down2 * down2;
      }
      return {one, two};
    }
    C odd{0, 0}, even{x[0], Scalar(0)};
    for (int m = 1; m <= powers; ++m) {
      rise *= up, fall *= down;
      if (m & 1) odd.re += x[m] * (rise - fall), odd.im += y[m] * (rise + fall);
      else even.re += x[m] * (rise + fall), even.im += y[m] * (rise - fall);
    }
    return {odd, even};
  }

  /// d zeta/du in trigonometric form, of z by its cosine and sine.
  Value slope(Scalar c, Scalar s) const noexcept {
    C power{1, 0}, sum[2] = {{0, 0}, {0, 0}};
    const C E{c, s};
    for (int m = 1; m <= powers; ++m) {
      power = power * E;
      C& to = sum[m & 1];
      const Scalar n = h * Scalar(m);
      to.re -= n * x[m] * power.im;
      to.im += n * y[m] * power.re;
    }
    const C odd{sum[1].im, -sum[1].re};
    return single ? Value{odd, sum[0]} : Value{sum[0], odd};
  }

  /// The same in other numbers, with the terms that these can show.
  template <Real To>
  ThetaPair<To> cast() const noexcept {
    ThetaPair<To> pair;
    pair.hyperbolic = hyperbolic;
    pair.single = single;
    for (int m = 1; m <= powers; ++m)
      if (weight_[m] > negligible<To>) pair.powers = m;
    for (int m = 0; m < most; ++m) pair.x[m] = static_cast<To>(x[m]), pair.y[m] = static_cast<To>(y[m]);
    pair.h = static_cast<To>(h);
    pair.K = static_cast<To>(K);
    pair.Kp = static_cast<To>(Kp);
    return pair;
  }

  /// d arg zeta_j/du at u = 0 for both.
  struct Turning {
    Scalar one, two;
  };
  Turning turning() const noexcept {
    const Value value = at(0);
    C slope[2] = {{0, 0}, {0, 0}};  // of even and odd powers
    for (int m = 1; m <= powers; ++m) {
      C& to = slope[m & 1];
      const Scalar n = Scalar(m);
      if (!hyperbolic) {
        to.im += n * y[m];  // d/dz of y sin mz; that of x cos mz vanishes
      } else if (!single) {
        to.re += n * (m % 4 == 1 ? x[m] : -x[m]);
        to.im += n * (m % 4 == 1 ? y[m] : -y[m]);
      } else if (m & 1) {
        to.re += 2 * n * x[m];
      } else {
        to.im += 2 * n * y[m];
      }
    }
    const auto turn = [this](C s, C v) { return h * (s.im * v.re - s.re * v.im) / (v.re * v.re + v.im * v.im); };
    if (!single && hyperbolic)  // zeta_2(u) = -conj zeta_1(-u)
      return {turn(slope[1], value.one), turn({slope[1].re, -slope[1].im}, value.two)};
    const C odd = hyperbolic ? slope[1] : C{slope[1].im, -slope[1].re};
    return single ? Turning{turn(odd, value.one), turn(slope[0], value.two)}
                  : Turning{turn(slope[0], value.one), turn(odd, value.two)};
  }

 private:
  void put(int m, Scalar size, Scalar a, Scalar b) noexcept {
    weight_[m] = static_cast<double>(size);
    if (!(weight_[m] > negligible<Scalar>)) return;
    x[m] = a;
    y[m] = b;
    powers = std::max(powers, m);
  }

  /// c_m E^m + c_-m E^-m = (c_m + c_-m) cos mz + i (c_m - c_-m) sin mz with real c, for odd m up to the factor -i. Exponents in
  /// multiples of eta and K' - eta, none of which cancel.
  void trigonometric_sums(const SpinorFrame<Scalar>& f) noexcept {
    using std::exp;
    h = pi<Scalar> / (2 * K);
    const Scalar unit = single ? h / 2 : h;
    x[0] = 1;
    for (int m = 1; m < most; ++m) {
      const int n = m / 2, s = n % 2 ? -1 : 1;
      const auto size = [&](int k) {  // of c_k
        const int d = k * f.delta;
        const int rest = single && m % 2 ? k * k - 1 : k * k;
        const int turn = single ? (m % 2 ? (d + 1) * (d + 1) : d * d + 2 * d) : d * d + d;
        const Scalar exponent = -unit * (Scalar(rest) * f.eta_rest + Scalar(turn) * f.eta);
        return exponent > Scalar(-100) ? exp(exponent) : Scalar(0);
      };
      const Scalar up = size(m), down = size(-m), largest = std::max(up, down);
      if (largest == 0) continue;
      const Scalar sign = Scalar(s);
      if (m % 2) put(m, largest, sign * (up - down), sign * (up + down));  // of (-1)^n, and its opposite at -m
      else if (single) put(m, largest, up + down, up - down);
      else put(m, largest, sign * (up + down), sign * (up - down));
    }
  }

  void hyperbolic_sums(const SpinorFrame<Scalar>& f) noexcept {
    using std::cos, std::exp, std::sin;
    h = pi<Scalar> / (single ? 2 * Kp : 4 * Kp);
    const Scalar angle = h * f.eta * Scalar(f.delta), log_Q = -2 * h * K;  // |u| <= K: E >= Q^(1/2)
    if (single) x[0] = 1;
    for (int m = 1; m < most; m += single ? 1 : 2) {
      const int quarters = m % 2 ? m * m - 1 : m * m, n = m / 2;
      const Scalar size = quarters == 0 ? Scalar(1) : exp(log_Q * Scalar(quarters) / 4);
      const Scalar edge = quarters == 0 ? Scalar(1) : exp(log_Q * Scalar(quarters - 2 * m + 2 * (m % 2)) / 4);
      if (edge < Scalar(1e-40)) continue;
      if (single) {
        const Scalar turned = Scalar(m) * angle, signed_size = m % 2 && n % 2 ? -size : size;
        put(m, edge, signed_size * cos(turned), signed_size * sin(turned));
      } else {
        const Scalar turned = Scalar(n % 2 ? -m : m) * angle;
        put(m, edge, size * cos(turned), size * sin(turned));
      }
    }
  }

  /// A and B.
  void scale(const SpinorFrame<Scalar>& f) noexcept {
    using std::sqrt;
    const Value v = at(0);
    const Scalar A = sqrt(f.size[0] / (v.one.re * v.one.re + v.one.im * v.one.im));
    const Scalar B = sqrt(f.size[1] / (v.two.re * v.two.re + v.two.im * v.two.im));
    for (int m = 0; m <= powers; ++m) {
      x[m] *= m % 2 ? A : B;
      y[m] *= m % 2 ? A : B;
    }
  }

  template <Real S>
  static constexpr double negligible = static_cast<double>(epsilon<S>) / 512;

  double weight_[most] = {};  // of the powers, relative to the largest term
};

}  // namespace gyrostat::free
