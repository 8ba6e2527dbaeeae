// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/result.hpp"
#include "gyrostat/math/elliptic.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/deceleration/regime.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Where the control torques drive the polhode of a body without rotor momentum (deceleration.md, section 2.1). In a
/// regime around the axis `near`, with b the torques in principal axes,
///     dk2/dtau = (2/M) G,   G = k2 F ((b_near - b_far) - (b_mid - b_far) phi(k2)):
/// the drag drops out, and phi falls from 1/2 on the axis (k2 = 0) to 0 on the separatrix (k2 = 1), so that everything
/// follows from two signs.
namespace gyrostat::deceleration {

/// What the flow does at a fixed point of k2.
enum class Tendency : std::uint8_t {
  none,  ///< there is no such point
  attracts,
  repels,
  neutral,  ///< k2 stands still: the three torques are equal
};

/// The four open regions of the torque ratios in one regime, and the point where they meet. A boundary belongs to the
/// region whose flow it shares.
enum class Region : std::uint8_t {
  to_axis,        ///< k2 falls to 0: steady rotation about the near axis
  to_separatrix,  ///< k2 grows to 1
  to_interior,    ///< k2 tends to k*2
  from_interior,  ///< k2 leaves k*2, for 0 below it and for 1 above
  neutral,        ///< equal torques: k2 is constant
};

/// The stability table of one regime.
template <Real Scalar>
struct RegimeStability {
  Region region = Region::neutral;
  Tendency axis = Tendency::neutral;                                 ///< of k2 = 0
  Tendency interior = Tendency::none;                                ///< of k*2
  Tendency separatrix = Tendency::neutral;                           ///< of k2 = 1
  math::Modulus<Scalar> quasi_stationary{nan<Scalar>, nan<Scalar>};  ///< k*2; NaN where there is none

  /// The point that k2 tends to from `start`.
  math::Modulus<Scalar> attractor(math::Modulus<Scalar> start) const noexcept {
    switch (region) {
      case Region::to_axis: return {0, 1};
      case Region::to_separatrix: return {1, 0};
      case Region::to_interior: return quasi_stationary;
      case Region::from_interior:
        if (start.k2 < quasi_stationary.k2) return {0, 1};
        if (start.kp2 < quasi_stationary.kp2) return {1, 0};
        return start;
      case Region::neutral: break;
    }
    return start;
  }
};

/// phi(k2) = kp2 W/(k2 F), from 1/2 at k2 = 0 falling to 0 at k2 = 1. Outside [0, 1] or NaN: NaN.
template <class Elliptic = math::Native, Real Scalar>
Scalar torque_balance(math::Modulus<Scalar> m) noexcept {
  if (m.k2 == 0) return Scalar(0.5);
  if (m.kp2 == 0) return 0;
  const auto mean = Elliptic::means(m);
  return m.kp2 * mean.W / (m.k2 * mean.F);
}

/// The modulus at which phi has a value in (0, 1/2): kp2 to full relative accuracy, k2 as far as the value determines
/// it, a few eps absolute. Errc::not_finite, out_of_domain.
template <class Elliptic = math::Native, Real Scalar>
Result<math::Modulus<Scalar>> modulus_of_balance(Scalar value) noexcept {
  using math::Modulus;
  if (!std::isfinite(value)) return Errc::not_finite;
  if (!(value > 0 && value < Scalar(0.5))) return Errc::out_of_domain;
  const Scalar wanted = std::log(value);
  const auto at = [](Scalar x) noexcept {
    const Scalar e = std::exp(-std::abs(x));
    return x < 0 ? Modulus<Scalar>::from_parts(e, 1) : Modulus<Scalar>::from_parts(1, e);
  };
  // Unknown x = ln(k2/kp2), in which ln phi is flat on the left and has slope -1 on the right.
  const auto misfit = [&](Scalar x) noexcept -> math::Slope<Scalar> {
    const Modulus<Scalar> m = at(x);
    const auto mean = Elliptic::means(m);
    return {std::log(m.kp2 * mean.W / (m.k2 * mean.F)) - wanted,
            (mean.W * m.kp2 + mean.F * mean.V) / (2 * mean.W * mean.F) - 1};
  };
  const Scalar low = 2 * std::log(epsilon<Scalar>);
  const Scalar high = 8 - wanted;
  const Result<Scalar> x = math::newton_root<Scalar>(misfit, low, high, false, -wanted, epsilon<Scalar>);
  if (!x) return x.error();
  return at(*x);
}

/// The stability table of a regime, about_largest or about_smallest, for the torques b >= 0 about the principal axes
/// 1, 2, 3 (only their ratios matter). Errc::not_finite, negative; out_of_domain for another regime.
template <class Elliptic = math::Native, Real Scalar>
Result<RegimeStability<Scalar>> regime_stability(const Vec3<Scalar>& b, Regime regime) noexcept {
  if (!b.allFinite()) return Errc::not_finite;
  if (b.minCoeff() < 0) return Errc::negative;
  if (regime != Regime::about_largest && regime != Regime::about_smallest) return Errc::out_of_domain;
  const Scalar near = regime == Regime::about_largest ? b[0] : b[2];
  const Scalar far = regime == Regime::about_largest ? b[2] : b[0];
  const Scalar near_far = near - far;
  const Scalar mid_far = b[1] - far;

  RegimeStability<Scalar> table;
  if (near_far == 0 && mid_far == 0) return table;
  // Signs of dk2/dtau beside the two ends; where one vanishes, phi's distance from its end value decides.
  const Scalar twice = near_far + (near - b[1]);
  const bool grows_at_axis = twice > 0 || (twice == 0 && mid_far > 0);
  const bool grows_at_separatrix = near_far > 0 || (near_far == 0 && mid_far < 0);
  table.axis = grows_at_axis ? Tendency::repels : Tendency::attracts;
  table.separatrix = grows_at_separatrix ? Tendency::attracts : Tendency::repels;
  if (grows_at_axis == grows_at_separatrix) {
    table.region = grows_at_axis ? Region::to_separatrix : Region::to_axis;
    return table;
  }
  table.region = grows_at_axis ? Region::to_interior : Region::from_interior;
  table.interior = grows_at_axis ? Tendency::attracts : Tendency::repels;
  const auto balance = modulus_of_balance<Elliptic>(near_far / mid_far);
  // A ratio that rounds to 0 or 1/2 puts k*2 at that end to rounding.
  table.quasi_stationary = balance                             ? *balance
                           : near_far / mid_far < Scalar(0.25) ? math::Modulus<Scalar>{1, 0}
                                                               : math::Modulus<Scalar>{0, 1};
  return table;
}

}  // namespace gyrostat::deceleration
