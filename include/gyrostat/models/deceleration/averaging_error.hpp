// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/models/deceleration/second_order.hpp"

namespace gyrostat::deceleration {

/// Estimated greatest errors over a span.
template <Real Scalar>
struct SlowError {
  Scalar norm;    ///< of |M|, N m s
  Scalar energy;  ///< of the carrier energy, J
  Scalar k2;      ///< of the modulus squared
  Scalar vector;  ///< of M itself, N m s
};

/// Collects along an averaged motion what its error is made of, and says how large it is.
///
/// First order leaves out the oscillation itself. Second order leaves out its product with the relative change of the
/// orbit in one quarter period, and with the relative change of kp2 in one oscillation (docs/errors.md): the estimates
/// are these terms times the factors below, which hold 3000 random bodies, spreads of b up to 10 and eps from 1e-4 to
/// 0.3 without exception; the median of estimate over error is 4 for |M| and k2.
template <Real Scalar>
class AveragingError {
 public:
  static constexpr Scalar first_order_factor = 3, second_order_factor = 5;
  static constexpr Scalar phase_factor = 3, squeeze_factor = 9;  // of M
  static constexpr Scalar crossing_norm_factor = 1, crossing_k2_factor = 6;

  void visit(const Polhode<Scalar>& p, const ControlTorques<Scalar>& b, const MeanTorque<Scalar>& mean, Scalar drag,
             Scalar norm) noexcept {
    const auto o = greatest_oscillation(p, b, norm);
    const Scalar tilt = p.tilt, k2 = p.modulus.k2, kp2 = p.modulus.kp2;
    const Scalar k2_swing = std::min(Scalar(1), o.spread * k2);
    const Scalar tilt_swing = std::min(Scalar(1), o.spread * tilt * (p.axes.axisymmetric() ? Scalar(1) : p.along));
    // |M| errs also through the torque of the wrong k2.
    const Scalar most = std::max({b.near, b.mid, b.far}), least = std::min({b.near, b.mid, b.far});
    const auto moved = shifted(p, o.spread);
    const Scalar torque = moved.valid ? std::abs(mean_torque(moved.polhode, b).deceleration - mean.deceleration)
                                      : (most - least) * std::min(Scalar(1), o.spread);
    const Scalar fall = drag * norm + mean.deceleration;
    const Scalar norm_swing = norm * std::min(Scalar(1), o.norm + (fall > 0 ? torque / fall : Scalar(0)) / 2);
    const Scalar turn = p.rate_per_momentum() / mean.K * norm * norm;
    const Scalar change = (fall + 2 * std::abs(mean.escape)) / turn;  // in one quarter period
    const Scalar squeeze = k2_swing / kp2;
    const Scalar shift = change + 3 * squeeze;
    const Scalar energy = norm * norm * p.energy_ratio() / 2;
    const Scalar energy_swing =
        std::min(energy, 2 * energy * norm_swing / norm + norm * norm / 2 * p.axes.near_far * tilt_swing);
    const Scalar nonlinear = 1 + std::min(Scalar(1), squeeze);
    keep(first_.norm, norm_swing * nonlinear);
    keep(first_.k2, k2_swing * nonlinear);
    keep(first_.energy, energy_swing * nonlinear);
    keep(second_.norm, norm_swing * shift);
    keep(second_.k2, k2_swing * shift);
    keep(second_.energy, energy_swing * shift);
    // The phase oscillates by the part of `change` in which the axes differ; M moves by as much of its own swing.
    const Scalar uneven = most > 0 ? (most - least) / most : Scalar(0);
    const Scalar swing = std::min(Scalar(1), 3 * std::sqrt(tilt * p.axes.near_far / p.axes.near_mid));
    keep(second_.vector, norm * (phase_factor * uneven * change * swing + squeeze_factor * squeeze));
    keep(squeeze_, squeeze);
  }

  /// The motion passed the separatrix at |M| = norm: the averaged equations err there by mu |ln mu|.
  void cross(Scalar norm, Scalar greatest_torque, const Vec3<Scalar>& a) noexcept {
    const Scalar mu = greatest_torque / (norm * norm * std::sqrt((a[1] - a[0]) * (a[2] - a[1])));
    const Scalar size = mu * (1 + std::max(Scalar(0), -std::log(mu)));
    keep(crossing_, size);
    keep(crossing_norm_, norm);
  }

  SlowError<Scalar> first_order(Scalar greatest_norm, Scalar greatest_energy) const noexcept {
    return {std::max(first_order_factor * first_.norm, crossing_norm_factor * crossing_ * crossing_norm_),
            std::max(first_order_factor * first_.energy, crossing_norm_factor * crossing_ * greatest_energy),
            std::min(Scalar(1), std::max(first_order_factor * first_.k2, crossing_k2_factor * crossing_)),
            2 * greatest_norm};
  }

  /// Without a crossing; a motion that crosses has no second order.
  SlowError<Scalar> second_order() const noexcept {
    const Scalar f = second_order_factor;
    return {f * second_.norm, f * second_.energy, std::min(Scalar(1), f * second_.k2),
            second_.vector + f * second_.norm};
  }

  Scalar greatest_squeeze() const noexcept { return squeeze_; }  ///< k2 oscillation over kp2

 private:
  static void keep(Scalar& greatest, Scalar value) noexcept {
    if (!(value <= greatest) && greatest == greatest) greatest = value;  // NaN stays
  }
  SlowError<Scalar> first_{}, second_{};
  Scalar crossing_ = 0, crossing_norm_ = 0, squeeze_ = 0;
};

}  // namespace gyrostat::deceleration
