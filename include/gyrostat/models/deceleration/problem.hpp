// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Despin of an asymmetric gyrostat in a resistive medium: the carrier with inertia J turns with omega, its rotors hold
/// the momentum l in the carrier, the total momentum is M = J omega + l, and
///     dM/dt = M x omega - drag D - control U/|U|,   omega = J^-1 (M - l).
namespace gyrostat::deceleration {

/// What a torque opposes: the total momentum M, or the carrier's share G = J omega = M - l.
enum class Law : std::uint8_t { total, carrier };

/// The scene in the principal axes of the carrier, A >= B >= C. SI units. Plain data: whoever fills it has validated it.
template <Real Scalar>
struct Problem {
  Vec3<Scalar> inverse_inertia{1, 1, 1};  ///< a = (1/A, 1/B, 1/C), ascending, 1/(kg m^2)
  /// (a2 - a1, a3 - a2, a3 - a1), 1/(kg m^2), where the differences are known better than a tells (Inertia::inverse_gaps).
  std::optional<Vec3<Scalar>> gaps{};
  bool exact_moments =
      false;  ///< the moments are data; else they come from a tensor, whose elements err as the greatest does
  Vec3<Scalar> rotor_momentum{0, 0, 0};  ///< l, constant in the carrier and relative to it, N m s
  Mat3<Scalar> control =
      Mat3<Scalar>::Zero();         ///< eps b: symmetric, diagonal if the actuators lie on principal axes, N m
  Scalar drag = 0;                  ///< eps lambda, 1/s
  Law law = Law::total;             ///< U: M or G
  Law drag_law = Law::total;        ///< D: M or G
  Vec3<Scalar> momentum{0, 0, 0};   ///< M at t = 0, N m s
  bool momentum_converted = false;  ///< M was taken from omega by a tensor, whose elements err as the greatest does

  /// (a2 - a1, a3 - a2, a3 - a1), as well as they are known.
  Vec3<Scalar> inverse_gaps() const noexcept {
    const Vec3<Scalar>& a = inverse_inertia;
    return gaps ? *gaps : Vec3<Scalar>(a[1] - a[0], a[2] - a[1], a[2] - a[0]);
  }

  /// Of a body in turned axes: moments that agree to some roundings of the greatest are made equal, and a rotor that is on the axis of
  /// revolution but for some roundings is put there.
  void make_round() noexcept {
    Vec3<Scalar>& a = inverse_inertia;
    Vec3<Scalar> d = inverse_gaps();
    for (int i = 0; i < 2; ++i) {
      if (!(d[i] <= 4 * epsilon<Scalar> * a[i] * a[i + 1] / a[0])) continue;
      a[i] = a[i + 1] = (a[i] + a[i + 1]) / 2;
      Scalar &l = rotor_momentum[i], &m = rotor_momentum[i + 1];
      if (std::max(std::abs(l), std::abs(m)) <= 4 * epsilon<Scalar> * rotor_momentum.norm()) l = m = 0;
      d[i] = 0;
      d[2] = d[1 - i];
    }
    gaps = d;
  }

  /// How far off the inverse_gaps may be: by their own rounding where the moments are exact, else by that of the greatest
  /// moment in all of them, 1/(kg m^2).
  Vec3<Scalar> gap_errors() const noexcept {
    const Vec3<Scalar>& a = inverse_inertia;
    if (exact_moments) return 2 * epsilon<Scalar> * inverse_gaps();
    return 4 * epsilon<Scalar> * Vec3<Scalar>(a[1], a[1] * a[2] / a[0], a[2] * a[2] / a[0]);
  }

  /// How far off the carrier energy of M may be because the moments come from a tensor, by the rounding of its greatest element, J.
  Scalar energy_error(const Vec3<Scalar>& M) const noexcept {
    return exact_moments ? Scalar(0) : 4 * epsilon<Scalar> / inverse_inertia[0] * angular_velocity(M).squaredNorm();
  }

  /// Magnitude of the terms that M at t = 0 is a sum of, to which its rounding is relative, N m s: of a slim body that turns about the axis of its
  /// least moment far more than |M|.
  Scalar momentum_terms() const noexcept {
    const Scalar carrier = momentum_converted ? Scalar(angular_velocity(momentum).norm() / inverse_inertia[0])
                                              : Scalar((momentum - rotor_momentum).norm());
    return carrier + rotor_momentum.norm();
  }

  /// How far M at t = 0 may be off because it was taken from omega by a tensor, N m s.
  Scalar momentum_error() const noexcept {
    return momentum_converted ? 4 * epsilon<Scalar> * momentum_terms() : Scalar(0);
  }

  /// g = J^-1 l, the rate at which the carrier would turn if all of l were its own, rad/s.
  Vec3<Scalar> gyro_rate() const noexcept { return inverse_inertia.cwiseProduct(rotor_momentum); }

  /// l.J^-1 l; the carrier energy at M = 0 is half of it, J.
  Scalar rotor_energy_scale() const noexcept { return rotor_momentum.dot(gyro_rate()); }

  /// Carrier energy of the total momentum M, J.
  Scalar energy(const Vec3<Scalar>& M) const noexcept {
    const Vec3<Scalar> G = M - rotor_momentum;
    return G.dot(inverse_inertia.cwiseProduct(G)) / 2;
  }

  /// omega = J^-1 (M - l), rad/s.
  Vec3<Scalar> angular_velocity(const Vec3<Scalar>& M) const noexcept {
    return inverse_inertia.cwiseProduct(M - rotor_momentum);
  }
};

}  // namespace gyrostat::deceleration
