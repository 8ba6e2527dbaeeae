// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::heavy {

namespace detail {

/// n/d; 0 where n vanishes, whatever d.
template <Real Scalar>
constexpr Scalar ratio_or_zero(Scalar n, Scalar d) noexcept {
  return n == 0 ? Scalar(0) : n / d;
}

}  // namespace detail

/// Body, field and a fast spin without units (docs/heavy.md, section 1): time in 1/r0, rates in r0. With eps = c/r0 the torques are
/// eps^2 (x', y', z') and eps^2 k. Here they stand as these products, which are finite also without weight, where c = 0.
template <Real Scalar>
struct Scaled {
  Scalar spin = 1;                ///< r0, rad/s, of either sign
  Scalar a = 1, b = 1;            ///< A/C, B/C
  Scalar off_a = 0, off_b = 0;    ///< 1 - a, 1 - b
  Scalar flatness = 1;            ///< a + b - 1, not negative; 0 for a lamina in the plane of axes 1, 2
  Scalar A1 = 0, B1 = 0, C1 = 0;  ///< (1 - b)/a, (a - 1)/b, b - a
  Vec3<Scalar> load{0, 0, 0};     ///< M g r_cm/(C r0^2) = eps^2 (x', y', z')
  Scalar gradient = 0;            ///< N/r0^2 = eps^2 k
  Scalar G0 = 0, M3 = 1;          ///< cosine and sine of the angle between axis 3 and down at t = 0

  Scaled() = default;

  /// Errors: not_finite; out_of_domain (no spin, |cos_inclination| >= 1).
  /// @param spin r0, rad/s   @param cos_inclination G0, the third component of down at t = 0
  static Result<Scaled> make(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination) noexcept {
    if (!(std::abs(spin) < infinity<Scalar>) || !(std::abs(cos_inclination) < infinity<Scalar>))
      return Errc::not_finite;
    if (spin == 0 || !(std::abs(cos_inclination) < 1)) return Errc::out_of_domain;
    const Vec3<Scalar>& I = problem.inertia();
    Scaled s;
    s.spin = spin;
    s.a = I[0] / I[2];
    s.b = I[1] / I[2];
    s.off_a = (I[2] - I[0]) / I[2];
    s.off_b = (I[2] - I[1]) / I[2];
    s.flatness = (I[0] < I[1] ? I[0] + (I[1] - I[2]) : I[1] + (I[0] - I[2])) / I[2];
    s.A1 = s.off_b / s.a;
    s.B1 = -s.off_a / s.b;
    s.C1 = (I[1] - I[0]) / I[2];
    s.load = problem.moment() / I[2] / spin / spin;
    s.gradient = problem.gradient() / spin / spin;
    s.G0 = cos_inclination;
    s.M3 = std::sqrt((1 - cos_inclination) * (1 + cos_inclination));
    if (!s.load.allFinite() || !(s.gradient < infinity<Scalar>)) return Errc::not_finite;
    return s;
  }

  /// omega^2, the square of the free nutation over the spin: in [0, 1], or negative where axis 3 is the intermediate one.
  Scalar nutation_squared() const noexcept { return -A1 * B1; }
  /// eps^2 of whatever torque there is: the larger of |load| and gradient.
  Scalar torque() const noexcept { return std::fmax(load.norm(), gradient); }
};

/// The first order of the forced motion, eps^2 in all of it (docs/heavy.md, section 3):
///     p/r0 = X + chi M3 cos u,   q/r0 = Y + kap M3 sin u,   u = (1 + rate) r0 t.
/// Infinite where a divisor 1 - a, 1 - b or a + b - 1 vanishes and what it divides does not.
template <Real Scalar>
struct FirstOrder {
  Scalar chi = 0, kap = 0, X = 0, Y = 0, rate = 0;
  Scalar lift = 0;  ///< z'/(a + b - 1) + k G0/2

  FirstOrder() = default;
  explicit FirstOrder(const Scaled<Scalar>& s) noexcept {
    using detail::ratio_or_zero;
    const Scalar x = s.load[0], y = s.load[1], z = s.load[2], k = s.gradient;
    const Scalar raised = ratio_or_zero(z, s.flatness);
    chi = -raised * (s.b - s.off_b) + k * s.G0 * s.off_b;
    kap = raised * (s.a - s.off_a) - k * s.G0 * s.off_a;
    X = ratio_or_zero(x * s.G0, s.off_a);
    Y = ratio_or_zero(y * s.G0, s.off_b);
    lift = raised + k * s.G0 / 2;
    rate = -(s.M3 * x - z * s.G0 + k * s.C1 * s.M3 * s.M3 / 4 + k * s.G0 * s.G0 * (s.off_a + s.off_b) / 2);
  }

  /// The mean of psi' over r0.
  Scalar precession() const noexcept { return (chi - kap) / 2; }
};

/// Where the fast motion is near an end of its domain (docs/heavy.md, section 10). Errors are estimated with or without a doubt.
struct Doubts {
  bool slow = false;             ///< r0 < 3 c
  bool strong_gradient = false;  ///< N > 0.1 r0^2
  bool near_a = false;           ///< 1 - a is small against x' eps^2: axis 1 can hardly be distinguished from axis 3
  bool near_b = false;           ///< 1 - b is small against y' eps^2
  bool near_lamina = false;      ///< a + b - 1 is small against eps^2
  bool upright = false;          ///< down stays so near axis 3 that psi, phi lose their meaning

  constexpr bool any() const noexcept { return slow || strong_gradient || near_a || near_b || near_lamina || upright; }
};

template <Real Scalar>
Doubts doubts(const Scaled<Scalar>& s) noexcept {
  constexpr Scalar much = Scalar(0.1L);
  const FirstOrder<Scalar> first(s);
  return {.slow = 9 * s.load.norm() > 1,
          .strong_gradient = s.gradient > much,
          .near_a = std::abs(s.load[0]) > much * std::abs(s.off_a),
          .near_b = std::abs(s.load[1]) > much * std::abs(s.off_b),
          .near_lamina = s.torque() > much * s.flatness,
          .upright = std::hypot(first.X, first.Y) > much * s.M3};
}

}  // namespace gyrostat::heavy
