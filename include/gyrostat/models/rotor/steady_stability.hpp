// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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

/// What the eigenvalues say of a steady rotation.
enum class Verdict : std::uint8_t {
  asymptotically_stable,  ///< a strict minimum of F that the rotor feels
  unstable,               ///< at least one growing mode
  marginal,  ///< no exponential rate: a fold, or e principal and m = +-e (from a minimum algebraic decay, from a maximum
             ///< algebraic growth)
  not_isolated,  ///< one of a continuum of steady rotations
  conservative,  ///< S = 0
};

/// Eigenvalues of a steady rotation, how fast it damps, and the motor that would damp it fastest.
template <Real Scalar>
struct SteadyStability {
  Scalar determinant = 0;                             ///< D, of B on the tangent plane, 1/s^2
  Scalar tilt_coupling = 0;                           ///< q, 1/(kg^2 m^4 s)
  std::array<Scalar, 4> cubic{};                      ///< k, S/lambda, k D + lambda l q, S D/lambda
  std::array<std::complex<Scalar>, 3> eigenvalues{};  ///< roots of the cubic, 1/s: a real one, then the two others
  Scalar decay_rate = 0;  ///< -max Re, 1/s: negative for growth; NaN where the slowest mode is not exponential
  Verdict verdict = Verdict::marginal;
  Scalar best_slope =
      0;  ///< the S > 0 with the fastest decay of the slowest mode, N m s/rad; NaN unless a minimum with q > 0
  Scalar best_rate = 0;  ///< that decay, 1/s
};

namespace detail {

/// Roots of (d + s)(d^2 + D) + kappa d = 0, s >= 0: a real one, then the two others. Each real part to a few eps of
/// itself, as far as D and kappa determine it.
template <Real Scalar>
std::array<std::complex<Scalar>, 3> nutation_roots(Scalar s, Scalar D, Scalar kappa) noexcept {
  using std::abs, std::sqrt, std::max;
  // The two roots of d^2 + 2 half d + product, without cancellation.
  const auto pair = [](Scalar half, Scalar product) noexcept -> std::array<std::complex<Scalar>, 2> {
    const Scalar square = half * half - product;
    if (square < 0) return {{{-half, sqrt(-square)}, {-half, -sqrt(-square)}}};
    const Scalar far = -(half + std::copysign(sqrt(square), half));
    return {{{far, 0}, {far == 0 ? Scalar(0) : product / far, 0}}};
  };
  // Newton's method from a side on which its steps do not pass the root.
  const auto newton = [](const auto& f, Scalar x) noexcept {
    for (int call = 0; call < 100; ++call) {
      const auto [value, slope] = f(x);
      const Scalar step = value / slope;
      if (!(abs(step) < infinity<Scalar>)) break;
      x -= step;
      if (abs(step) <= 2 * epsilon<Scalar> * abs(x)) break;
    }
    return x;
  };
  struct Slope {
    Scalar value, slope;
  };

  if (s == 0) {
    const auto rest = pair(0, D + kappa);
    return {0, rest[0], rest[1]};
  }
  if (D == 0) {
    const auto rest = pair(s / 2, kappa);
    return {0, rest[0], rest[1]};
  }
  if (D > 0) {
    // -a real: (a - s)(a^2 + D) + kappa a = 0; the others have the sum s - a = kappa a/(a^2 + D) with changed sign
    const auto f = [&](Scalar a) noexcept -> Slope {
      const Scalar square = a * a + D;
      return {(a - s) * square + kappa * a, square + (a - s) * 2 * a + kappa};
    };
    // convex above s/3, concave below
    Scalar start = s;
    if (kappa < 0) start = s + std::min(-kappa / (2 * sqrt(D)), sqrt(-kappa));
    else if (f(s / 3).value > 0) start = 0;
    const Scalar a = newton(f, start);
    const auto rest = pair(kappa * a / (2 * (a * a + D)), s * (D / a));
    return {-a, rest[0], rest[1]};
  }
  // a saddle: one root r > 0, (r + s)(r^2 + D) + kappa r = 0, convex
  const auto f = [&](Scalar r) noexcept -> Slope {
    const Scalar square = r * r + D;
    return {(r + s) * square + kappa * r, square + (r + s) * 2 * r + kappa};
  };
  const Scalar r = newton(f, sqrt(-D + max(Scalar(0), -kappa)));
  const auto rest = pair((s + r) / 2, s * (-D / r));
  return {r, rest[0], rest[1]};
}

}  // namespace detail

/// The motor slope with the fastest decay of the slowest mode, and that decay, of (d + s)(d^2 + D) + kappa d = 0 with
/// D, kappa > 0 over all s > 0.
template <Real Scalar>
struct FastestDamping {
  Scalar relaxation;  ///< s = S/(lambda k), 1/s
  Scalar rate;        ///< 1/s
};

/// Exact. With D = 1 (times in 1/sqrt D): a real root -a leaves two roots of mean -kappa a/(2(1 + a^2)), at most kappa/4 in
/// size, which a = 1, s = 1 + kappa/2 attains while kappa <= 4; beyond, all three real parts are equal, a^2 = kappa/2 - 1; from
/// kappa = 8 on the slowest two roots are equal and real.
template <Real Scalar>
FastestDamping<Scalar> fastest_damping(Scalar D, Scalar kappa) noexcept {
  if (!(D > 0) || !(kappa > 0)) return {nan<Scalar>, nan<Scalar>};
  const Scalar root = std::sqrt(D), c = kappa / D;
  if (c <= 4) return {root * (1 + c / 2), root * (c / 4)};
  if (c <= 8) {
    const Scalar a = std::sqrt(c / 2 - 1);
    return {root * 3 * a, root * a};
  }
  const Scalar square = 2 * (1 + c) / (c - 2 + std::sqrt(c * (c - 8)));
  const Scalar a = std::sqrt(square);
  return {root * a * (1 + c / (1 + square)), root * a};
}

/// momentum_norm, N m s: that of steady_rotations. n and m count as parallel where n x m is rounding: 16 eps/theta_1 from n = theta^-1 e, and
/// from m, which rounding of l m - h e moves along each principal direction of B on the tangent plane by what theta^-1 makes of it there, the more the
/// smaller B is. q, of second order in that, is then rounding alone, and is set to 0.
template <Real Scalar>
SteadyStability<Scalar> stability_of(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm,
                                     const SteadyRotation<Scalar>& rotation) noexcept {
  const Scalar l = momentum_norm, psi = rotation.spin_rate, k = gyrostat.coupling(), lambda = gyrostat.axial_inertia();
  const Mat3<Scalar>& J = gyrostat.inverse_inertia();
  const Vec3<Scalar>& m = rotation.direction;
  const Vec3<Scalar> n = J * gyrostat.axis();
  const detail::Tangent<Scalar> t(m);
  const Vec3<Scalar> Ju = J * t.u, Jv = J * t.v;
  const Scalar uu = l * t.u.dot(Ju) - psi, uv = l * t.u.dot(Jv), vv = l * t.v.dot(Jv) - psi;
  // n x m = (n.v) u - (n.u) v
  const Scalar along_u = n.dot(t.v), along_v = -n.dot(t.u);
  const Scalar sine = std::sqrt(along_u * along_u + along_v * along_v);
  SteadyStability<Scalar> r;
  r.determinant = uu * vv - uv * uv;
  const auto& moments = gyrostat.principal();
  constexpr Scalar some = 16 * epsilon<Scalar>;
  Scalar rounding = some / moments[0];
  if (rotation.type != SteadyType::degenerate) {
    const Scalar half = (uu - vv) / 2, turn = std::atan2(uv, half) / 2, size = l + std::abs(psi) * moments[2];
    for (const Scalar angle : {turn, turn + pi<Scalar> / 2}) {
      const Scalar c = std::cos(angle), d = std::sin(angle);
      const Scalar along = uu * c * c + 2 * uv * c * d + vv * d * d;
      rounding += some * n.norm() * size * Vec3<Scalar>(c * Ju + d * Jv).norm() / std::abs(along);
    }
  }
  const bool felt = sine > rounding;
  r.tilt_coupling = felt ? along_u * along_u * uu + 2 * along_u * along_v * uv + along_v * along_v * vv : Scalar(0);
  if (rotation.type == SteadyType::degenerate) r.determinant = 0;
  const Scalar s = gyrostat.relaxation_rate(), D = r.determinant, kappa = lambda * l * r.tilt_coupling / k;
  r.cubic = {k, s * k, k * (D + kappa), s * k * D};
  r.eigenvalues = detail::nutation_roots<Scalar>(s, D, kappa);
  const Scalar growth = std::max({r.eigenvalues[0].real(), r.eigenvalues[1].real(), r.eigenvalues[2].real()});
  const bool stable = rotation.type == SteadyType::minimum;
  if (gyrostat.slope() == 0) r.verdict = Verdict::conservative;
  else if (!rotation.isolated) r.verdict = Verdict::not_isolated;
  else if (rotation.type == SteadyType::degenerate) r.verdict = growth > 0 ? Verdict::unstable : Verdict::marginal;
  else if (rotation.type == SteadyType::saddle) r.verdict = Verdict::unstable;
  else r.verdict = !felt ? Verdict::marginal : stable ? Verdict::asymptotically_stable : Verdict::unstable;
  const bool exponential = r.verdict == Verdict::asymptotically_stable || r.verdict == Verdict::unstable;
  r.decay_rate = exponential ? -growth : nan<Scalar>;
  const bool damped = stable && felt;
  const auto best = fastest_damping(damped ? D : nan<Scalar>, kappa);
  r.best_slope = lambda * k * best.relaxation;
  r.best_rate = best.rate;
  return r;
}

}  // namespace gyrostat::rotor
