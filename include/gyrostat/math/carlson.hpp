// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

namespace detail {

/// Cap on the duplication steps. Each divides the spread of the arguments by 4, and the first one alone undoes any
/// spread that the exponent range allows, so 8 (double) to 20 (quadruple) are made.
inline constexpr int carlson_steps = 40;

/// The same where p is far above the others: it falls by 4 a step, which at most the whole range of exponents makes many.
template <Real Scalar>
inline constexpr int carlson_RJ_steps =
    carlson_steps + std::numeric_limits<Scalar>::max_exponent - std::numeric_limits<Scalar>::min_exponent;

/// Spread at which the series of degree 7 beyond it is below rounding: (eps/4)^(1/8), Carlson 1995 with degree 7.
template <Real Scalar>
inline Scalar carlson_reach() noexcept {
  using std::sqrt;
  return sqrt(sqrt(sqrt(epsilon<Scalar> / 4)));
}

/// Spread at which what the series of R_F leaves out, a fortieth of its twelfth power, is a twentieth of a rounding: (2 eps)^(1/12).
template <Real Scalar>
inline Scalar carlson_RF_reach() noexcept {
  return Scalar(std::pow(2 * static_cast<double>(epsilon<Scalar>), 1.0 / 12));
}

/// 1 - E2/10 + E3/14 + E2^2/24 - 3 E2 E3/44 ... (DLMF 19.36.1) up to the eleventh power of what the arguments differ by: the term of E2^m E3^n has the factor
/// (-1)^m (1/2)_(m+n)/(m! n! (4 m + 6 n + 1)) (DLMF 19.19.7).
template <Real Scalar>
constexpr Scalar series_RF(Scalar e2, Scalar e3) noexcept {
  const auto ratio = [](int a, int b) { return Scalar(a) / Scalar(b); };
  const Scalar alone =
      ratio(-1, 10) + e2 * (ratio(1, 24) + e2 * (ratio(-5, 208) + e2 * (ratio(35, 2176) + e2 * ratio(-3, 256))));
  const Scalar once =
      ratio(1, 14) + e2 * (ratio(-3, 44) + e2 * (ratio(1, 16) + e2 * (ratio(-35, 608) + e2 * ratio(315, 5888))));
  const Scalar twice = ratio(3, 104) + e2 * (ratio(-15, 272) + e2 * ratio(5, 64));
  const Scalar thrice = ratio(5, 304) + e2 * ratio(-35, 736);
  return 1 + (e2 * alone + e3 * (once + e3 * (twice + e3 * thrice)));
}

/// 1 - 3 E2/14 + E3/6 + ... (DLMF 19.36.2).
template <Real Scalar>
constexpr Scalar series_RD(Scalar e2, Scalar e3, Scalar e4, Scalar e5) noexcept {
  return 1 + (e2 * (-3 / Scalar(14) + e2 * (9 / Scalar(88) - e2 / 16) - e3 * (9 / Scalar(52)) + e4 * (3 / Scalar(20)) +
                    e2 * e3 * (45 / Scalar(272))) +
              e3 / 6 - e4 * (3 / Scalar(22)) + e5 * (3 / Scalar(26)) + e3 * e3 * (3 / Scalar(40)) -
              (e3 * e4 + e2 * e5) * (9 / Scalar(68)));
}

}  // namespace detail

/// Carlson's R_F(x, y, z) = (1/2) int_0^inf dt / sqrt((t+x)(t+y)(t+z)); x, y, z >= 0, at most one zero
/// (two or three zeros: infinity). By duplication (Carlson 1995), relative error 3 eps. Negative or NaN: NaN.
template <Real Scalar>
inline Scalar carlson_RF(Scalar x, Scalar y, Scalar z) noexcept {
  using std::abs, std::sqrt;
  if (!(x >= 0 && y >= 0 && z >= 0)) return nan<Scalar>;
  if ((x == 0) + (y == 0) + (z == 0) > 1) return infinity<Scalar>;
  Scalar mean = (x + y + z) / 3;
  Scalar a = mean - x;
  Scalar b = mean - y;
  const Scalar reach = detail::carlson_RF_reach<Scalar>();
  for (int step = 0; step < detail::carlson_steps; ++step) {
    if (!(std::max(std::max(abs(a), abs(b)), abs(a + b)) > reach * mean)) break;
    const Scalar rx = sqrt(x);
    const Scalar ry = sqrt(y);
    const Scalar rz = sqrt(z);
    const Scalar lambda = rx * (ry + rz) + ry * rz;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    mean = (x + y + z) / 3;
    a = mean - x;
    b = mean - y;
  }
  const Scalar X = a / mean;
  const Scalar Y = b / mean;
  const Scalar Z = -X - Y;
  return detail::series_RF<Scalar>(X * Y - Z * Z, X * Y * Z) / sqrt(mean);
}

/// Carlson's R_C(x, y) = R_F(x, y, y) for x >= 0, y > 0 (y = 0: infinity). Negative y (a principal value) or NaN: NaN.
template <Real Scalar>
inline Scalar carlson_RC(Scalar x, Scalar y) noexcept {
  return carlson_RF(x, y, y);
}

/// Carlson's R_D(x, y, z) = (3/2) int_0^inf dt / (sqrt((t+x)(t+y)) (t+z)^(3/2)); x, y >= 0 not both zero, z > 0
/// (otherwise infinity). By duplication, a sum of positive terms; relative error 4 eps. Negative or NaN: NaN.
template <Real Scalar>
inline Scalar carlson_RD(Scalar x, Scalar y, Scalar z) noexcept {
  if (!(x >= 0 && y >= 0 && z >= 0)) return nan<Scalar>;
  if (z == 0 || (x == 0 && y == 0)) return infinity<Scalar>;
  Scalar mean = (x + y + 3 * z) / 5;
  Scalar a = mean - x;
  Scalar b = mean - y;
  Scalar sum = 0;
  Scalar power = 1;
  const Scalar reach = detail::carlson_reach<Scalar>();
  for (int step = 0; step < detail::carlson_steps; ++step) {
    if (!(std::max(std::max(std::abs(a), std::abs(b)), std::abs(a + b)) > reach * mean)) break;
    const Scalar rx = std::sqrt(x);
    const Scalar ry = std::sqrt(y);
    const Scalar rz = std::sqrt(z);
    const Scalar lambda = rx * (ry + rz) + ry * rz;
    sum += power / (rz * (z + lambda));
    power /= 4;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    mean = (x + y + 3 * z) / 5;
    a = mean - x;
    b = mean - y;
  }
  const Scalar X = a / mean;
  const Scalar Y = b / mean;
  const Scalar Z = -(X + Y) / 3;
  const Scalar XY = X * Y;
  const Scalar Z2 = Z * Z;
  const Scalar series = detail::series_RD<Scalar>(XY - 6 * Z2, (3 * XY - 8 * Z2) * Z, 3 * (XY - Z2) * Z2, XY * Z2 * Z);
  return 3 * sum + power * series / (mean * std::sqrt(mean));
}

/// Carlson's R_J(x, y, z, p) = (3/2) int_0^inf dt / (sqrt((t+x)(t+y)(t+z)) (t+p)); x, y, z >= 0, at most one zero,
/// p > 0 (otherwise infinity). By duplication (Carlson 1995); relative error 10 eps. p < 0 (a principal value), another
/// negative or NaN: NaN.
template <Real Scalar>
inline Scalar carlson_RJ(Scalar x, Scalar y, Scalar z, Scalar p) noexcept {
  if (!(x >= 0 && y >= 0 && z >= 0 && p >= 0)) return nan<Scalar>;
  if (p == 0 || (x == 0) + (y == 0) + (z == 0) > 1) return infinity<Scalar>;
  Scalar mean = (x + y + z + 2 * p) / 5;
  Scalar a = mean - x;
  Scalar b = mean - y;
  Scalar c = mean - z;
  Scalar sum = 0;
  Scalar power = 1;
  const Scalar reach = detail::carlson_reach<Scalar>();
  for (int step = 0; step < detail::carlson_RJ_steps<Scalar>; ++step) {
    const Scalar spread = std::max(std::max(std::abs(a), std::abs(b)), std::max(std::abs(c), std::abs(a + b + c) / 2));
    if (!(spread > reach * mean)) break;
    const Scalar rx = std::sqrt(x);
    const Scalar ry = std::sqrt(y);
    const Scalar rz = std::sqrt(z);
    const Scalar rp = std::sqrt(p);
    const Scalar lambda = rx * (ry + rz) + ry * rz;
    const Scalar d = (rp + rx) * (rp + ry) * (rp + rz);
    // 1 + (p-x)(p-y)(p-z)/d^2 of this step as a quotient of sums of positive terms, without overflow
    const Scalar inner = 2 * (rp / (rp + rx)) * ((p + lambda) / ((rp + ry) * (rp + rz)));
    sum += power / d * carlson_RC<Scalar>(1, inner);
    power /= 4;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    p = (p + lambda) / 4;
    mean = (x + y + z + 2 * p) / 5;
    a = mean - x;
    b = mean - y;
    c = mean - z;
  }
  const Scalar X = a / mean;
  const Scalar Y = b / mean;
  const Scalar Z = c / mean;
  const Scalar P = -(X + Y + Z) / 2;
  const Scalar P2 = P * P;
  const Scalar XYZ = X * Y * Z;
  const Scalar e2 = X * Y + X * Z + Y * Z - 3 * P2;
  const Scalar e3 = XYZ + 2 * e2 * P + 4 * P2 * P;
  const Scalar e4 = (2 * XYZ + e2 * P + 3 * P2 * P) * P;
  return 6 * sum + power * detail::series_RD<Scalar>(e2, e3, e4, XYZ * P2) / (mean * std::sqrt(mean));
}

}  // namespace gyrostat::math
