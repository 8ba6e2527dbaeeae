// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>

#include "gyrostat/models/rotor/steady.hpp"

/// Linear stability of a steady rotation (docs/rotor.md, section 4). With B = l J - psi_dot E, x = omega - omega* and dm normal
/// to m,
///     dm' = m x (B dm - lambda x n),   lambda (k x' + l n.dm') = -S x,
///     k d^3 + (S/lambda) d^2 + (k D + lambda l q) d + (S/lambda) D = 0,
///     D = m.adj(B) m,   q = (n x m).B (n x m).
/// Divided by k, with s = S/(lambda k) and kappa = lambda l q/k: (d + s)(d^2 + D) + kappa d = 0. Where -a is its real root, the two
/// others have the sum -kappa a/(a^2 + D): the slow damping of a nutation comes without cancellation.
namespace gyrostat::rotor {

enum class Verdict : std::uint8_t {
  asymptotically_stable,  ///< a strict minimum of F that the rotor feels
  unstable,               ///< at least one growing mode
  marginal,               ///< no exponential rate: a fold, or e principal and m = +-e (from a minimum algebraic decay, from a maximum
                          ///< algebraic growth)
  not_isolated,           ///< one of a continuum of steady rotations
  conservative,           ///< S = 0
};

template <Real Scalar>
struct SteadyStability {
  Scalar determinant = 0;                             ///< D, of B on the tangent plane, 1/s^2
  Scalar feeling = 0;                                 ///< q, 1/(kg^2 m^4 s)
  std::array<Scalar, 4> cubic{};                      ///< k, S/lambda, k D + lambda l q, S D/lambda
  std::array<std::complex<Scalar>, 3> eigenvalues{};  ///< roots of the cubic, 1/s: a real one, then the two others
  Scalar decay_rate = 0;  ///< -max Re, 1/s: negative for growth; NaN where the slowest mode is not exponential
  Verdict verdict = Verdict::marginal;
  Scalar best_slope = 0;  ///< the S > 0 with the fastest decay of the slowest mode, N m s/rad; NaN unless a minimum with q > 0
  Scalar best_rate = 0;   ///< that decay, 1/s
};

/// momentum_norm, N m s: that of steady_rotations.
template <Real Scalar>
SteadyStability<Scalar> stability_of(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm,
                                     const SteadyRotation<Scalar>& rotation) noexcept;

}  // namespace gyrostat::rotor
