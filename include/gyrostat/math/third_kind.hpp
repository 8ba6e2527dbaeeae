// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/carlson.hpp"
#include "gyrostat/math/jacobi.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::math {

/// An argument u = 2 K turns + rest, |rest| <= K, and Jacobi's functions of the rest: cn >= 0, and all three have
/// relative accuracy also where they are small.
template <Real Scalar>
struct JacobiTurn {
  Scalar turns, rest;
  Scalar sn, cn, dn;

  static JacobiTurn of(const JacobiAt<Scalar>& functions, Scalar u) noexcept {
    const Scalar half = 2 * functions.quarter_period();
    const Scalar n = half < infinity<Scalar> ? std::nearbyint(u / half) : Scalar(0);
    const Scalar r = n == 0 ? u : std::fma(-n, half, u);
    const auto j = functions(r);
    return {n, r, j.sn, std::max(j.cn, Scalar(0)), j.dn};
  }

  /// The same of u - K: sn(u - K) = -cn/dn, cn(u - K) = k' sn/dn, dn(u - K) = k'/dn.
  JacobiTurn minus_quarter(Modulus<Scalar> m, Scalar K) const noexcept {
    const Scalar kp = std::sqrt(m.kp2), sign = rest < 0 ? -1 : 1;
    return {rest < 0 ? turns - 1 : turns, rest - sign * K, -sign * cn / dn, kp * std::abs(sn) / dn, kp / dn};
  }
  /// The same of u + K.
  JacobiTurn plus_quarter(Modulus<Scalar> m, Scalar K) const noexcept {
    JacobiTurn shifted = minus_quarter(m, K);
    shifted.turns += 1;
    return shifted;
  }
};

/// The argument u in [-K, K] with these sn, cn >= 0, dn, each known to a relative error of eps.
template <Real Scalar>
inline Scalar jacobi_argument(Scalar sn, Scalar cn, Scalar dn) noexcept {
  return sn == 0 ? sn : sn * carlson_RF<Scalar>(cn * cn, dn * dn, 1);
}

/// int_0^u sn^2/(1 - n sn^2) du, what an integral of the third kind has beyond u: Pi(n; am u) = u + n times this. 0 <=
/// n <= 1, given with its complement 1 - n > 0, so that nothing is lost at n -> 1 nor, with Jacobi's functions as data,
/// at k -> 1 (DLMF 19.25.14).
template <Real Scalar>
class ThirdKind {
 public:
  ThirdKind() = default;
  ThirdKind(Modulus<Scalar> m, Scalar complement) noexcept
      : complement_(complement), complete_(carlson_RJ<Scalar>(0, m.kp2, 1, complement) / 3) {}

  Scalar complete() const noexcept { return complete_; }  ///< at u = K
  Scalar operator()(const JacobiTurn<Scalar>& u) const noexcept {
    const Scalar s2 = u.sn * u.sn, c2 = u.cn * u.cn;
    const Scalar part = u.sn * s2 / 3 * carlson_RJ<Scalar>(c2, u.dn * u.dn, 1, c2 + complement_ * s2);
    return u.turns == 0 ? part : 2 * u.turns * complete_ + part;
  }

 private:
  Scalar complement_ = 1, complete_ = 0;
};

}  // namespace gyrostat::math
