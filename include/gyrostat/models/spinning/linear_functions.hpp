// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/math/exp_difference.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

/// The functions of time of which every quantity of the linear motion is a sum (docs/spinning.md, section 4.1), with
/// r = r0, nu = sqrt(kappa1 kappa2), imaginary where the spin is unstable, and divided differences [...] of x -> e^(t x):
///     S = [i nu, -i nu], V = [0, i nu, -i nu];   E_k = [0^k, i r], J_k = [0^k, i(r + nu), i(r - nu)],
///     K_k = [0^k, i r, i(r + nu), i(r - nu)], H_k = [0^k, -i r, i nu, -i nu].
/// Array index: k = 1, 2, 3.
template <Real Scalar>
struct LinearValues {
  Scalar S = 0, V = 0;         ///< sin(nu t)/nu, s; (1 - cos(nu t))/nu^2, s^2
  math::Complex<Scalar> spin;  ///< e^(i r0 t)
  math::Complex<Scalar> E[4];  ///< s^k
  math::Complex<Scalar> J[4];  ///< s^(k+1)
  math::Complex<Scalar> K[4];  ///< s^(k+2)
  math::Complex<Scalar> H[4];  ///< s^(k+2)
};

namespace detail {

/// Constants of the motion are made in this type, and their differences rounded once.
template <Real Scalar>
using Wide = std::conditional_t<(sizeof(Scalar) < sizeof(long double)), long double, Scalar>;

template <Real To, Real From>
Problem<To> problem_cast(const Problem<From>& p) noexcept {
  const auto& a = p.angles;
  return {p.inertia.template cast<To>(),
          static_cast<To>(p.mass),
          static_cast<To>(p.rotor_momentum),
          static_cast<To>(p.charge_momentum),
          p.torque.template cast<To>(),
          p.force.template cast<To>(),
          p.angular_velocity.template cast<To>(),
          {static_cast<To>(a.psi), static_cast<To>(a.phi), static_cast<To>(a.theta)},
          p.velocity.template cast<To>(),
          p.position.template cast<To>()};
}

/// a b - product, product being the rounded a b.
template <Real Scalar>
Scalar product_error(Scalar a, Scalar b, Scalar product) noexcept {
  if constexpr (sizeof(Scalar) <= sizeof(double)) {
    return std::fma(a, b, -product);
  } else {  // Dekker 1971: the library's fma is many times slower here
    constexpr int digits = std::numeric_limits<Scalar>::digits;
    constexpr Scalar splitter = Scalar((1ull << ((digits + 1) / 2)) + 1);
    const auto high_half = [](Scalar x) noexcept {
      const Scalar shifted = splitter * x;
      return shifted - (shifted - x);
    };
    const Scalar a1 = high_half(a), a2 = a - a1, b1 = high_half(b), b2 = b - b1;
    return ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
  }
}

/// A rate [1/s] with its rounding error, so that the phase rate * t is good to an eps of the turn, not of itself.
template <Real Scalar>
struct FineRate {
  Scalar high = 0, low = 0;

  FineRate() = default;
  explicit FineRate(Wide<Scalar> rate) noexcept
      : high(static_cast<Scalar>(rate)), low(static_cast<Scalar>(rate - static_cast<Wide<Scalar>>(high))) {}

  /// e^(i rate t).
  math::Complex<Scalar> turn(Scalar t) const noexcept {
    const Scalar phase = high * t;
    const Scalar rest = product_error(high, t, phase) + low * t;
    const auto u = math::unit(phase);
    return {u.re - rest * u.im, u.im + rest * u.re};
  }
  /// e^(rate t).
  Scalar growth(Scalar t) const noexcept {
    const Scalar phase = high * t;
    const Scalar rest = product_error(high, t, phase) + low * t;
    const Scalar e = std::exp(phase);
    return e + e * rest;
  }
};

}  // namespace detail

/// Evaluates LinearValues, also where nu, r0 or r0 +- nu vanish. The error of each is a few eps of the greatest that it
/// takes up to t for any phases: t^n/n! times e^(|nu| t) where nu is imaginary.
template <Real Scalar>
class LinearFunctions {
  using Differences = math::ExpDifferences<Scalar, 3, 3>;
  using Set = typename Differences::Set;
  static constexpr Set pair = 0b011, single = 0b100, all = 0b111;

 public:
  LinearFunctions() = default;

  explicit LinearFunctions(const Problem<Scalar>& problem) noexcept {
    using Wide = detail::Wide<Scalar>;
    const auto wide = detail::problem_cast<Wide>(problem);
    const Wide nu2 = wide.nutation_squared(), r = wide.spin();
    const Wide nu = std::sqrt(std::abs(nu2));
    unstable_ = nu2 < 0;
    nu_ = detail::FineRate<Scalar>(nu);
    half_nu_ = detail::FineRate<Scalar>(nu / 2);
    r0_ = detail::FineRate<Scalar>(r);
    const math::Complex<Wide> i_nu = unstable_ ? math::Complex<Wide>{-nu, 0} : math::Complex<Wide>{0, nu};
    const math::Complex<Wide> i_r{0, r};
    typename Differences::Entries inertial = 0, body = 0;
    for (int k = 1; k <= 3; ++k) {
      for (const Set s : {pair, single, all}) inertial |= Differences::entry(k, s);
      body |= Differences::entry(k, all);
    }
    inertial_ = Differences(std::array{i_r + i_nu, i_r - i_nu, i_r}, inertial);
    body_ = Differences(std::array{i_nu, -i_nu, -i_r}, body);
  }

  /// Without `axial` the H are not set.
  LinearValues<Scalar> at(Scalar t, bool axial) const noexcept {
    using math::Complex;
    using math::conjugate;
    LinearValues<Scalar> value;
    Complex<Scalar> up, down;  // e^(i nu t), e^(-i nu t)
    if (unstable_) {
      const Scalar grown = half_nu_.growth(t), shrunk = half_nu_.growth(-t);
      const Scalar x = half_nu_.high * t;
      const Scalar half = nu_.high * std::abs(t) < 1 ? std::sinh(x) / half_nu_.high : (grown - shrunk) / nu_.high;
      value.S = half * (grown + shrunk) / 2;
      value.V = half * half / 2;
      up = {shrunk * shrunk, 0};
      down = {grown * grown, 0};
    } else {
      const Complex<Scalar> quarter = half_nu_.turn(t);
      const Scalar half = nu_.high == 0 ? t : quarter.im / half_nu_.high;
      value.S = half * quarter.re;
      value.V = half * half / 2;
      up = {1 - 2 * quarter.im * quarter.im, 2 * quarter.im * quarter.re};
      down = conjugate(up);
    }
    const Complex<Scalar> spin = r0_.turn(t);
    value.spin = spin;
    typename Differences::Table f;
    inertial_.evaluate(t, {spin * up, spin * down, spin}, f);
    for (int k = 1; k <= 3; ++k) {
      value.E[k] = f(k, single);
      value.J[k] = f(k, pair);
      value.K[k] = f(k, all);
    }
    if (axial) {
      body_.evaluate(t, {up, down, conjugate(spin)}, f);
      for (int k = 1; k <= 3; ++k) value.H[k] = f(k, all);
    }
    return value;
  }

 private:
  Differences inertial_, body_;
  detail::FineRate<Scalar> nu_, half_nu_, r0_;
  bool unstable_ = false;
};

}  // namespace gyrostat::spinning
