// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/models/spinning/second_order.hpp"

namespace gyrostat::spinning {

/// What the linear motion and SecondOrder leave out of the attitude at one time, in the lowest order, without a torque about axis 3: sums over the
/// modes of the linear motion, where its nutation is stable and the modes are apart (docs/spinning.md, section 6.1). Half a microsecond
/// a time. Over [0, T], T > 0.
template <Real Scalar>
class TiltOrders {
 public:
  TiltOrders(const Problem<Scalar>& problem, Scalar T) noexcept
      : TiltOrders(problem, LinearStart<Scalar>(problem), amplitudes(problem, T), T) {}

  /// The modes are apart: at most a hundred times as large as the tilt, and of an asymmetric body all turn through a radian.
  bool known() const noexcept { return known_; }

  /// What the linear motion leaves out of the spin angle to second order, rad: of SecondOrder nothing is left of it.
  Scalar spin_angle(Scalar t) const noexcept {
    const Turned now(*this, t);
    const Complex Gamma = conjugate(math::unit(now.spin)) * tilt_of_order_1(now);
    return nutation(now) + change_of_spin(now) - (Gamma.re * Gamma.im - start_.re * start_.im) / 2;
  }

  /// What SecondOrder leaves out of the tilt to third order, rad, but for what the change of the spin rate makes of the nutation: half the integral of
  /// |A|^2 A' less the turn of the part that stands still.
  Scalar tilt(Scalar t) const noexcept {
    const Turned now(*this, t);
    Complex sum{};
    for (int k = 1; k < modes; ++k)
      for (int i = 0; i < modes; ++i)
        for (int j = 0; j < modes; ++j) {
          const Complex turned = now.turn[i] * conjugate(now.turn[j]) * now.turn[k];
          sum = sum + rate_[k] * (tilt_[i] * conjugate(tilt_[j])) *
                          integral(turning_[i] - turning_[j] + turning_[k], now.time, turned);
        }
    const Complex turned = nutation(now) * turned_back_ - change_of_spin(now) * (tilt_[0] - turned_back_);
    return magnitude(sum / Scalar(2) - math::turned(turned));
  }

 private:
  using Complex = math::Complex<Scalar>;
  static constexpr int modes = 4;  ///< what stands still in space, and those of the rates

  TiltOrders(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, const Amplitudes<Scalar>& size,
             Scalar T) noexcept
      : start_(start.Gamma),
        spin_(problem.spin()),
        skew_((problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2])) {
    const detail::TiltModes<Scalar> found(problem, start);
    if (!found.stable) return;
    constexpr Scalar apart = 100;
    tilt_[0] = found.still;
    known_ = magnitude(found.still) <= apart * size.tilt;
    for (int j = 1; j < modes; ++j) {
      rate_[j] = found.rates[j - 1];
      tilt_[j] = found.tilts[j - 1];
      turning_[j] = found.turning[j - 1];
      // where the spin rate changes, it turns what stands still and a mode that all but does, and these cancel
      known_ = known_ && found.tilt[j - 1] <= apart * size.tilt && (skew_ == 0 || std::abs(turning_[j]) * T >= 1);
    }
    turned_back_ = detail::StillTilt<Scalar>(found, size, T).still;
  }

  /// e^(i turning t) of all modes.
  struct Turned {
    Scalar time, spin;
    Complex turn[modes];

    Turned(const TiltOrders& of, Scalar t) noexcept : time(t), spin(of.spin_ * t) {
      for (int j = 0; j < modes; ++j) turn[j] = math::unit(of.turning_[j] * t);
    }
  };

  /// int_0^t e^(i w s) ds, where e^(i w t) = turned.
  static Complex integral(Scalar w, Scalar t, Complex turned) noexcept {
    const Scalar phase = w * t;
    if (std::abs(phase) > Scalar(0.5L)) return -math::turned(turned - Complex{1, 0}) / w;
    return series(phase, t, 1);
  }
  /// int_0^t int_0^s e^(i w r) dr ds.
  static Complex second_integral(Scalar w, Scalar t, Complex turned) noexcept {
    const Scalar phase = w * t;
    if (std::abs(phase) > Scalar(0.5L)) return (Complex{1, phase} - turned) / (w * w);
    return series(phase, t * t / 2, 2);
  }
  /// first (1 + i x/(n + 1) (1 + i x/(n + 2) (...))), |x| <= 1/2: to 1e-13.
  static Complex series(Scalar x, Scalar first, int n) noexcept {
    constexpr int terms = 11;
    Complex sum{1, 0};
    for (int k = terms; k > 0; --k) sum = Complex{1, 0} + (x / Scalar(n + k)) * math::turned(sum);
    return first * sum;
  }

  Complex tilt_of_order_1(const Turned& now) const noexcept {
    Complex sum{};
    for (int j = 0; j < modes; ++j) sum = sum + tilt_[j] * now.turn[j];
    return sum;
  }
  /// Half the integral of Im(Pi Gamma~).
  Scalar nutation(const Turned& now) const noexcept {
    Scalar sum = 0;
    for (int k = 1; k < modes; ++k)
      for (int j = 0; j < modes; ++j)
        sum += (rate_[k] * conjugate(tilt_[j]) *
                integral(turning_[k] - turning_[j], now.time, now.turn[k] * conjugate(now.turn[j])))
                   .im;
    return sum / 2;
  }
  /// The integral of r - r0.
  Scalar change_of_spin(const Turned& now) const noexcept {
    if (skew_ == 0) return 0;
    const Complex back = math::unit(-2 * now.spin);
    Scalar sum = 0;
    for (int k = 1; k < modes; ++k)
      for (int j = 1; j < modes; ++j)
        sum += (rate_[k] * rate_[j] *
                second_integral(turning_[k] + turning_[j] - 2 * spin_, now.time, now.turn[k] * now.turn[j] * back))
                   .im;
    return skew_ * sum;
  }

  Complex start_;       ///< Gamma at t = 0, rad
  Scalar spin_, skew_;  ///< r0, rad/s; (D1 - D2)/(2 D3)
  bool known_ = false;
  Complex rate_[modes]{}, tilt_[modes]{};
  Scalar turning_[modes]{};
  Complex turned_back_{};  ///< the tilt that SecondOrder turns back
};

/// The error of the attitude of the linear motion at the times, rad, where the modes tell it: the second order of the spin angle, times 1.1, and what
/// is left of higher orders. Never above error.attitude. `left`: second_order_errors of the same span.
template <Real Scalar>
Scalar linear_attitude_error(const LinearErrors<Scalar>& error, const LinearErrors<Scalar>& left,
                             const TiltOrders<Scalar>& orders, std::span<const Scalar> times) noexcept {
  if (!orders.known()) return error.attitude;
  Scalar most = 0;
  for (const Scalar t : times) most = std::max(most, std::abs(orders.spin_angle(t)));
  return std::min(error.attitude, std::hypot(Scalar(1.1L) * most + left.theta, error.tilt));
}

/// The same of SecondOrder, whose errors are `error`: the third order of the tilt, times 1.25, and what the change of the spin rate makes of it.
template <Real Scalar>
Scalar second_order_attitude_error(const LinearErrors<Scalar>& error, const TiltOrders<Scalar>& orders,
                                   std::span<const Scalar> times) noexcept {
  if (!orders.known()) return error.attitude;
  Scalar most = 0;
  for (const Scalar t : times) most = std::max(most, orders.tilt(t));
  const Scalar tilt = Scalar(1.25L) * most + error.of_spin_rate + error.size.tilt * error.theta;
  return std::min(error.attitude, std::hypot(error.theta, tilt));
}

}  // namespace gyrostat::spinning
