// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/models/deceleration/averaged.hpp"

/// Mean and osculating polhodes without rotor momentum (deceleration.md, section 2.2). The second-order term of the mean
/// equations vanishes, so the first-order equations started from the mean polhode are right to second order.
namespace gyrostat::deceleration {

/// Osculating minus mean: |M| in units of itself, and k2 in units of k2 (of the tilt where the near axis is one of
/// symmetry, in units of the tilt).
template <Real Scalar>
struct Oscillation {
  Scalar norm, spread;
};

/// Jacobi zeta over k2, which stays regular at k2 = 0.
template <class Elliptic, Real Scalar>
Scalar zeta_over_k2(Scalar u, math::Modulus<Scalar> m) noexcept {
  return m.k2 > 0 ? Elliptic::zeta(u, m) / m.k2 : std::sin(2 * u) / 4;
}

/// The oscillation per unit of zeta_over_k2, at momentum |M|.
template <Real Scalar>
Oscillation<Scalar> oscillation_factor(const Polhode<Scalar>& p, const ControlTorques<Scalar>& b,
                                       Scalar norm) noexcept {
  const auto& x = p.axes;
  const Scalar k2 = p.modulus.k2, kp2 = p.modulus.kp2;
  const Scalar scale = 1 / (norm * norm * p.rate_per_momentum());
  const Scalar length = (b.near * x.mid_far - b.mid * x.near_far + b.far * x.near_mid) * p.tilt / x.near_mid;
  const Scalar shape = 2 * (b.near * k2 + b.mid * kp2 - b.far);
  return {-length * scale, shape * scale * (x.axisymmetric() ? p.along : 1)};
}

/// The oscillation at argument u.
template <class Elliptic = math::Native, Real Scalar>
Oscillation<Scalar> oscillation(const Polhode<Scalar>& p, const ControlTorques<Scalar>& b, Scalar norm,
                                Scalar u) noexcept {
  const auto factor = oscillation_factor(p, b, norm);
  const Scalar z = zeta_over_k2<Elliptic>(u, p.modulus);
  return {factor.norm * z, factor.spread * z};
}

/// Bound of the oscillation over the orbit, between 1 and 1.4 times the greatest: max Z <= 1 - sqrt(k').
template <Real Scalar>
Oscillation<Scalar> greatest_oscillation(const Polhode<Scalar>& p, const ControlTorques<Scalar>& b,
                                         Scalar norm) noexcept {
  const Scalar kp = std::sqrt(p.modulus.kp2);
  const Scalar z = 1 / ((1 + kp) * (1 + std::sqrt(kp)));
  const auto factor = oscillation_factor(p, b, norm);
  return {std::abs(factor.norm) * z, std::abs(factor.spread) * z};
}

/// The polhode with its modulus changed by `relative` times k2. Beyond half the way to either end of [0, 1] the
/// correction has no meaning: then `valid` is false.
template <Real Scalar>
struct Shifted {
  Polhode<Scalar> polhode;
  bool valid;
};

/// Shifted of p; of an axisymmetric body, which has no modulus, the tilt is changed by `relative` times itself.
template <Real Scalar>
Shifted<Scalar> shifted(Polhode<Scalar> p, Scalar relative) noexcept {
  const Scalar size = std::abs(relative);
  if (p.axes.axisymmetric()) {
    const Scalar change = relative * p.tilt;
    if (!(std::abs(change) <= std::min(p.tilt, p.along) / 2)) return {p, false};
    p.tilt += change;
    p.along -= change;
    return {p, true};
  }
  const Scalar change = relative * p.modulus.k2;
  if (!(size <= Scalar(.5)) || !(std::abs(change) <= p.modulus.kp2 / 2)) return {p, false};
  return {at_modulus(p, {p.modulus.k2 + change, p.modulus.kp2 - change}), true};
}

}  // namespace gyrostat::deceleration
