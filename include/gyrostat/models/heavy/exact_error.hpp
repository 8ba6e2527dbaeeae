// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"

namespace gyrostat::heavy {

/// Bounds of what an exact motion errs, by the rounding of the data and of the arithmetic. Infinite where first order
/// does not suffice.
template <Real Scalar>
struct ExactError {
  Scalar attitude = 0;          ///< angle, rad
  Scalar down = 0;              ///< of the unit vector
  Scalar angular_velocity = 0;  ///< rad/s

  ExactError& operator+=(const ExactError& by) noexcept {
    attitude += by.attitude, down += by.down, angular_velocity += by.angular_velocity;
    return *this;
  }
  /// The lesser and the greater of both, each by itself.
  ExactError least(const ExactError& other) const noexcept {
    return {std::min(attitude, other.attitude), std::min(down, other.down),
            std::min(angular_velocity, other.angular_velocity)};
  }
  ExactError most(const ExactError& other) const noexcept {
    const auto greater = [](Scalar a, Scalar b) { return a > b || a != a ? a : b; };
    return {greater(attitude, other.attitude), greater(down, other.down),
            greater(angular_velocity, other.angular_velocity)};
  }
  /// Infinite in the place of what is no number.
  ExactError or_infinite() const noexcept {
    const auto one = [](Scalar x) { return x == x ? x : infinity<Scalar>; };
    return {one(attitude), one(down), one(angular_velocity)};
  }
  ExactError over(Scalar x) const noexcept { return {attitude / x, down / x, angular_velocity / x}; }
  /// Of a motion that is off by an angle, and its rates by so much, rad/s.
  static ExactError of(Scalar angle, Scalar rates) noexcept {
    if (!(angle < Scalar(0.05))) return {infinity<Scalar>, infinity<Scalar>, infinity<Scalar>};
    return {angle, angle, rates};
  }
};

/// By how much the rounding of the data puts an oscillation out of time at t, s. Its frequency errs by `relative`.
/// Where it passes a saddle, with argument `rate` t of Jacobi's functions and quarter period K, a perturbation grows
/// like exp(rate t) until the passage ends, by which time it has moved the argument by `shift`: the relative error of
/// k'^2.
template <Real Scalar>
Scalar time_error(Scalar relative, Scalar shift, Scalar K, Scalar rate, Scalar t) noexcept {
  if (!(rate > 0)) return relative * t;
  const Scalar passages = 1 + (K < infinity<Scalar> ? rate * t / K : Scalar(0));
  return relative * t + passages * std::min(shift, relative * std::expm1(rate * t)) / rate;
}

/// Displacement at t of an equilibrium disturbed by the acceleration `push`: z'' = push + square z, from rest.
template <Real Scalar>
Scalar pushed_off(Scalar push, Scalar square, Scalar t) noexcept {
  if (push == 0) return 0;
  const Scalar half = std::sqrt(std::abs(square)) * t / 2;
  if (square <= 0) return push * (half < 1 ? t * t / 2 : 2 / -square);
  const Scalar growth = half > 0 ? std::sinh(half) / half : Scalar(1);
  return push * t * t / 2 * growth * growth;
}

/// For how long, s, what turns with the body can add up: the torques by which a body is off its symmetry have the same shape in every nutation, of this
/// period, but turn on by `turn`, rad, once or twice. Their sum over any number of nutations is at most one over the sine of half of that. Infinite
/// where they do not turn.
template <Real Scalar>
Scalar lasting(Scalar period, Scalar turn) noexcept {
  const Scalar least = std::min(std::abs(std::sin(turn / 2)), std::abs(std::sin(turn)));
  const Scalar time = period * (1 + 1 / least);
  return time < infinity<Scalar> ? time : infinity<Scalar>;
}

}  // namespace gyrostat::heavy
