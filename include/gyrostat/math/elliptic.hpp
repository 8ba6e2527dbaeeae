// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complete.hpp"
#include "gyrostat/math/incomplete.hpp"
#include "gyrostat/math/jacobi.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::math {

/// A supplier of elliptic integrals and functions: static members, none of which throws. Models take one as a template
/// argument. Native serves every scalar, Gsl (gsl.hpp) double only.
template <class Backend, class Scalar>
concept EllipticBackend = Real<Scalar> && requires(Scalar x, Modulus<Scalar> m) {
  { Backend::complete(m) } noexcept -> std::same_as<Complete<Scalar>>;
  { Backend::means(m) } noexcept -> std::same_as<Means<Scalar>>;
  { Backend::jacobi(x, m) } noexcept -> std::same_as<Jacobi<Scalar>>;
  { Backend::zeta(x, m) } noexcept -> std::same_as<Scalar>;
  { Backend::incomplete_F(x, m) } noexcept -> std::same_as<Scalar>;
  { Backend::incomplete_E(x, m) } noexcept -> std::same_as<Scalar>;
  { Backend::incomplete_Pi(x, x, m) } noexcept -> std::same_as<Scalar>;
};

/// The library's own functions: any scalar, no dependency, bounded loops.
struct Native {
  template <Real Scalar>
  static Complete<Scalar> complete(Modulus<Scalar> m) noexcept {
    return math::complete(m);
  }

  template <Real Scalar>
  static Means<Scalar> means(Modulus<Scalar> m) noexcept {
    return math::means(m);
  }

  template <Real Scalar>
  static Jacobi<Scalar> jacobi(Scalar u, Modulus<Scalar> m) noexcept {
    return math::jacobi(u, m);
  }

  template <Real Scalar>
  static Scalar zeta(Scalar u, Modulus<Scalar> m) noexcept {
    return math::zeta(u, m);
  }

  template <Real Scalar>
  static Scalar incomplete_F(Scalar phi, Modulus<Scalar> m) noexcept {
    return math::incomplete_F(phi, m);
  }

  template <Real Scalar>
  static Scalar incomplete_E(Scalar phi, Modulus<Scalar> m) noexcept {
    return math::incomplete_E(phi, m);
  }

  template <Real Scalar>
  static Scalar incomplete_Pi(Scalar phi, Scalar n, Modulus<Scalar> m) noexcept {
    return math::incomplete_Pi(phi, n, m);
  }
};

}  // namespace gyrostat::math
