// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
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
  explicit JacobiAt(Modulus<Scalar> m) noexcept : modulus_(m) {
    if (!m.legal()) {
      q_ = scale_ = quarter_ = nan<Scalar>;
      theta_ = {nan<Scalar>, nan<Scalar>, nan<Scalar>, nan<Scalar>};
      return;
    }
    circular_ = m.k2 <= m.kp2;
    q_ = nome(circular_ ? m : m.complement());
    theta_ = ThetaConstants<Scalar>::of(q_);
    scale_ = theta_.three * theta_.three;
    quarter_ = scale_ * (circular_ ? pi<Scalar> / 2 : -std::log(q_) / 2);
    tiny_ = q_ < epsilon<Scalar> * epsilon<Scalar> / 64;
  }

  Modulus<Scalar> modulus() const noexcept { return modulus_; }

  /// The quarter period K; infinity at kp2 = 0.
  Scalar quarter_period() const noexcept { return quarter_; }

  /// sn, cn, dn, am at u. Error a few eps in each where |u| <= K, relative also at the zero of sn; beyond it that of an
  /// argument wrong by a few eps of itself. u infinite or NaN: NaN (sn = +-1, cn = dn = 0 at kp2 = 0).
  Jacobi<Scalar> operator()(Scalar u) const noexcept {
    const auto [n, r] = reduce(u);
    const bool odd = n - 2 * std::floor(n / 2) == 1;
    const bool back = n - 4 * std::floor(n / 4) >= 2;
    Jacobi<Scalar> f = circular_ ? real_argument(r, odd) : imaginary_argument(r, odd);
    const Scalar from_quarter = odd ? std::atan2(-f.cn, f.sn) : std::atan2(f.sn, f.cn);
    f.am = n * (pi<Scalar> / 2) + from_quarter;
    if (back) {
      f.sn = -f.sn;
      f.cn = -f.cn;
    }
    return f;
  }

  /// Jacobi's zeta E(am u) - (E/K) u, of period 2K. Relative accuracy also as k2 -> 0, where it vanishes like
  /// (k2/4) sin 2u, and near u = 0 and u = K.
  Scalar zeta(Scalar u) const noexcept {
    const auto [n, r] = reduce(u);
    const bool odd = n - 2 * std::floor(n / 2) == 1;
    const Scalar y = r / scale_;
    if (circular_) {
      const auto t = Thetas<Scalar>::of(q_, std::cos(2 * y));
      return 4 * std::sin(2 * y) / scale_ * (odd ? -t.slope_three / t.three : t.slope_four / t.four);
    }
    const Scalar linear = r / quarter_;  // y over its value at K
    if (tiny_) {
      const Scalar rise = odd ? 4 * q_ * std::sinh(2 * r) : std::tanh(r);
      return rise - linear;
    }
    const auto t = Thetas<Scalar>::of(q_, std::cosh(2 * y));
    const Scalar rise = odd ? 4 * std::sinh(2 * y) * t.slope_three / t.three : std::tanh(y) * t.slope_two / t.two;
    return (rise - linear) / scale_;
  }

 private:
  struct Reduced {
    Scalar n, r;  // u = n K + r, |r| <= K/2
  };

  Reduced reduce(Scalar u) const noexcept {
    const Scalar n = std::nearbyint(u / quarter_);
    return n == 0 ? Reduced{n, u} : Reduced{n, std::fma(-n, quarter_, u)};
  }

  Jacobi<Scalar> real_argument(Scalar r, bool odd) const noexcept {
    const Scalar z = r / scale_;
    const Scalar s = std::sin(z);
    const Scalar c = std::cos(z);
    const auto t = Thetas<Scalar>::of(q_, 1 - 2 * s * s);
    const Scalar below = odd ? t.three : t.four;
    const Scalar common = 1 / (theta_.two * theta_.three * below);
    const Scalar along_sn = theta_.three * theta_.three * common;
    const Scalar along_cn = theta_.three * theta_.four * common;
    const Scalar dn = theta_.four * theta_.two * common * (odd ? t.four : t.three);
    return odd ? Jacobi<Scalar>{along_sn * t.two * c, -along_cn * t.one * s, dn, 0}
               : Jacobi<Scalar>{along_sn * t.one * s, along_cn * t.two * c, dn, 0};
  }

  Jacobi<Scalar> imaginary_argument(Scalar r, bool odd) const noexcept {
    if (tiny_) {  // the theta functions differ from 1 by less than rounding
      const Scalar kp = std::sqrt(modulus_.kp2);
      const Scalar ch = std::cosh(r);
      return odd ? Jacobi<Scalar>{1, -kp * std::sinh(r), kp * ch, 0} : Jacobi<Scalar>{std::tanh(r), 1 / ch, 1 / ch, 0};
    }
    const Scalar y = r / scale_;
    const Scalar sh = std::sinh(y);
    const Scalar ch = std::cosh(y);
    const auto t = Thetas<Scalar>::of(q_, 1 + 2 * sh * sh);
    if (odd) {
      const Scalar kp = std::sqrt(modulus_.kp2);
      const Scalar common = theta_.three / (theta_.four * theta_.two * t.three);
      return {common * theta_.two * t.four, -kp * common * theta_.three * t.one * sh,
              kp * common * theta_.four * t.two * ch, 0};
    }
    const Scalar common = 1 / (theta_.four * theta_.three * t.two * ch);
    return {common * theta_.three * theta_.three * t.one * sh, common * theta_.two * theta_.three * t.four,
            common * theta_.two * theta_.four * t.three, 0};
  }

  Modulus<Scalar> modulus_;
  Scalar q_, scale_, quarter_;
  ThetaConstants<Scalar> theta_;
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
