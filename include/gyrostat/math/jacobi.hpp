// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/elementary.hpp"
#include "gyrostat/math/modulus.hpp"
#include "gyrostat/math/nome.hpp"

namespace gyrostat::math {

/// Jacobi's elliptic functions and the amplitude am: sn = sin am, cn = cos am, dn = d am/du.
template <Real Scalar>
struct Jacobi {
  Scalar sn, cn, dn, am;
};

/// Jacobi's functions at one modulus, for many arguments: the nome and the theta constants are formed once.
/// k2 <= 1/2: theta series of the nome q at a real argument. k2 > 1/2: Jacobi's imaginary transformation, theta series
/// of the complementary nome at an imaginary argument. Both q <= exp(-pi), so three terms give double precision, four
/// the 64-bit significand; there is no other loop. (DLMF 20.2, 22.2; shifts by a quarter period DLMF 22.4.)
template <Real Scalar>
class JacobiAt {
 public:
  explicit JacobiAt(Modulus<Scalar> m) noexcept : k2_(m.k2), kp2_(m.kp2) {
    const Modulus<Work> wide{k2_, kp2_};
    circular_ = k2_ <= kp2_;
    q_ = wide.legal() ? nome(circular_ ? wide : wide.complement()) : nan<Work>;
    const auto [two, three, four, curvature] = ThetaConstants<Work>::of(q_);
    const Work inverse = 1 / (two * three * four);
    const Work square = three * three;
    inverse_ = (two * four * inverse) * (two * four * inverse);
    if (circular_) {
      constexpr Work half = pi<Work> / 2;
      const Work more = half * (three - 1) * (three + 1);
      quarter_ = half + more;
      quarter_low_ = (half - quarter_) + more + half_pi_low;
      per_quarter_ = inverse_ / half;
      even_ = {square * four * inverse, three * (four * four) * inverse, two * (four * four) * inverse};
      odd_ = even_;
    } else {
      const Work kp = std::sqrt(kp2_);
      tiny_ = q_ < epsilon<Work> * epsilon<Work> / 64;
      quarter_ = q_ > 0 ? square * (detail::logarithm_of(q_) / -2) : std::isnan(q_) ? q_ : infinity<Work>;
      per_quarter_ = 1 / quarter_;
      even_ = {square * two * inverse, three * (two * two) * inverse, four * (two * two) * inverse};
      odd_ = {even_.sn, kp * (square * three) * inverse, kp * (square * four) * inverse};
    }
  }

  Modulus<Scalar> modulus() const noexcept { return {Scalar(k2_), Scalar(kp2_)}; }

  /// The quarter period K; infinity at kp2 = 0.
  Scalar quarter_period() const noexcept { return Scalar(quarter_); }

  /// sn, cn, dn, am at u. Error a few eps in each where |u| <= K, relative also at the zero of sn; beyond it that of an
  /// argument wrong by an eps of itself. u infinite or NaN: NaN (sn = +-1, cn = dn = 0 at kp2 = 0).
  Jacobi<Scalar> operator()(Scalar u) const noexcept {
    const Reduced at = reduce(u);
    const bool odd = at.quadrant & 1;
    Jacobi<Work> f = circular_ ? real_argument(at.r, odd) : imaginary_argument(at.r, odd);
    f.am = at.n * (pi<Work> / 2) + (odd ? detail::angle(-f.cn, f.sn) : detail::angle(f.sn, f.cn));
    const Work sign = at.quadrant & 2 ? -1 : 1;
    return {Scalar(sign * f.sn), Scalar(sign * f.cn), Scalar(f.dn), Scalar(f.am)};
  }

  /// Jacobi's zeta E(am u) - (E/K) u, of period 2K. Relative accuracy also as k2 -> 0, where it vanishes like
  /// (k2/4) sin 2u, and near u = 0 and u = K.
  Scalar zeta(Scalar u) const noexcept {
    const Reduced at = reduce(u);
    const bool odd = at.quadrant & 1;
    const Work y = at.r * inverse_;
    if (circular_) {
      const auto z = detail::sine_cosine(y);
      const auto t = Thetas<Work>::of(q_, 1 - 2 * (z.s * z.s));
      return Scalar(8 * (z.s * z.c) * inverse_ * (odd ? -t.slope_three / t.three : t.slope_four / t.four));
    }
    const Work linear = at.r * per_quarter_;
    if (tiny_) return Scalar((odd ? 4 * q_ * std::sinh(2 * at.r) : std::tanh(at.r)) - linear);
    const auto z = detail::sinh_cosh(y);
    const auto t = Thetas<Work>::of(q_, 1 + 2 * (z.s * z.s));
    const Work rise = odd ? 8 * (z.s * z.c) * t.slope_three / t.three : z.s * t.slope_two / (z.c * t.two);
    return Scalar((rise - linear) * inverse_);
  }

 private:
  using Work = std::conditional_t<std::same_as<Scalar, float>, double, Scalar>;

  /// pi/2 beyond its rounding, so that a large argument loses nothing at small k2.
  static constexpr Work half_pi_low = std::same_as<Work, double> ? Work(6.123233995736766036e-17L) : Work(0);

  struct Reduced {
    Work n, r;     // u = n K + r, |r| <= K/2
    int quadrant;  // n modulo 4
  };

  Reduced reduce(Work u) const noexcept {
    const Work x = u * per_quarter_;
    if (!(std::abs(x) > Work(0.5))) return {0, u, 0};  // at kp2 = 0 however great u is
    const Work n = std::nearbyint(x);
    const int quadrant = std::abs(n) < Work(0x1p62) ? static_cast<int>(static_cast<std::int64_t>(n) & 3) : 0;
    const Work r = std::fma(-n, quarter_, u) - n * quarter_low_;
    // so far out an eps of u is more than a quarter period, and any point of one is as good
    if (std::abs(n) > Work(0.125) / epsilon<Work>) return {n, std::clamp(r, -quarter_ / 2, quarter_ / 2), quadrant};
    return {n, r, quadrant};
  }

  Jacobi<Work> real_argument(Work r, bool odd) const noexcept {
    const auto z = detail::sine_cosine(r * inverse_);
    const auto t = Thetas<Work>::of(q_, 1 - 2 * (z.s * z.s));
    const Work along_s = t.one * z.s;
    const Work along_c = t.two * z.c;
    const Work below = 1 / (odd ? t.three : t.four);
    return {even_.sn * (odd ? along_c : along_s) * below, even_.cn * (odd ? -along_s : along_c) * below,
            even_.dn * (odd ? t.four : t.three) * below, 0};
  }

  Jacobi<Work> imaginary_argument(Work r, bool odd) const noexcept {
    if (tiny_) {  // the theta functions differ from 1 by less than rounding
      const Work kp = std::sqrt(kp2_);
      const Work c = std::cosh(r);
      return odd ? Jacobi<Work>{1, -kp * std::sinh(r), kp * c, 0} : Jacobi<Work>{std::tanh(r), 1 / c, 1 / c, 0};
    }
    const auto z = detail::sinh_cosh(r * inverse_);
    const auto t = Thetas<Work>::of(q_, 1 + 2 * (z.s * z.s));
    const Work along_s = t.one * z.s;
    const Work along_c = t.two * z.c;
    const Work below = 1 / (odd ? t.three : along_c);
    const Factors& by = odd ? odd_ : even_;
    return {by.sn * (odd ? t.four : along_s) * below, by.cn * (odd ? -along_s : t.four) * below,
            by.dn * (odd ? along_c : t.three) * below, 0};
  }

  struct Factors {
    Work sn, cn, dn;
  };

  Work k2_, kp2_, q_;
  Work inverse_;                // 1/theta_3^2(0)
  Work quarter_, per_quarter_;  // K and 1/K
  Work quarter_low_ = 0;        // what the rounding of K left
  Factors even_, odd_;          // ratios of theta constants before sn, cn, dn at u = n K + r, n even and odd
  bool circular_ = false;
  bool tiny_ = false;
};

/// sn, cn, dn, am at one argument and modulus; see JacobiAt.
template <Real Scalar>
inline Jacobi<Scalar> jacobi(Scalar u, Modulus<Scalar> m) noexcept {
  return JacobiAt<Scalar>(m)(u);
}

/// Jacobi's zeta at one argument and modulus; see JacobiAt.
template <Real Scalar>
inline Scalar zeta(Scalar u, Modulus<Scalar> m) noexcept {
  return JacobiAt<Scalar>(m).zeta(u);
}

}  // namespace gyrostat::math
