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
/// modes of the linear motion (docs/spinning.md, section 6.1). Half a microsecond a time. Over [0, T], T > 0.
template <Real Scalar>
class TiltOrders {
 public:
  TiltOrders(const Problem<Scalar>& problem, Scalar T) noexcept
      : TiltOrders(problem, LinearStart<Scalar>(problem), T) {}

  /// What the linear motion leaves out of the spin angle to second order, rad: of SecondOrder nothing is left of it. Where the modes are not apart to 1e-4 of
  /// itself; not finite where they overflow.
  Scalar spin_angle(Scalar t) const noexcept {
    const Turned now(*this, t);
    Complex A = start_;
    for (int j = 1; j < modes; ++j) A = A + modes_.rate[j] * now.grown[j];
    const Complex Gamma = conjugate(math::unit(now.spin)) * A;
    return nutation(now) + change_of_spin(now) - (Gamma.re * Gamma.im - start_.re * start_.im) / 2;
  }

  /// Whether tilt() says it: the nutation is stable and the modes are apart, of none is the tilt more than a hundred times what it is of all, and of
  /// an asymmetric body all turn through a radian.
  bool knows_tilt() const noexcept { return knows_tilt_; }

  /// What SecondOrder leaves out of the tilt to third order, rad, but for what the change of the spin rate makes of the nutation: half the integral of
  /// |A|^2 A' less the turn of the part that stands still.
  Scalar tilt(Scalar t) const noexcept {
    const Turned now(*this, t);
    Complex sum{};
    for (int k = 1; k < modes; ++k)
      for (int i = 0; i < modes; ++i)
        for (int j = 0; j < modes; ++j) {
          const Complex turned = now.turn[i] * conjugate(now.turn[j]) * now.turn[k];
          sum = sum + modes_.rate[k] * (modes_.tilt[i] * conjugate(modes_.tilt[j])) *
                          integral(modes_.pace[i] + conjugate(modes_.pace[j]) + modes_.pace[k], now.time, turned);
        }
    const Complex turned = nutation(now) * turned_back_ - change_of_spin(now) * (modes_.tilt[0] - turned_back_);
    return magnitude(sum / Scalar(2) - math::turned(turned));
  }

 private:
  using Complex = math::Complex<Scalar>;
  static constexpr int modes = detail::TiltModes<Scalar>::count;

  TiltOrders(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar T) noexcept
      : start_(start.Gamma),
        spin_(problem.spin()),
        skew_((problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2])),
        modes_(problem, start, turning_nutation(problem, T)) {
    constexpr Scalar apart = 100;
    const Amplitudes<Scalar> size = amplitudes(problem, T);
    turned_back_ = detail::StillTilt<Scalar>(modes_, size, T).still;
    knows_tilt_ = modes_.stable && turning_nutation(problem, T) == problem.nutation_squared();
    for (int j = 0; j < modes; ++j) knows_tilt_ = knows_tilt_ && modes_.tilted[j] <= apart * size.tilt;
    // where the spin rate changes, it turns what stands still and a mode that all but does, and these cancel
    for (int j = 1; j < modes && skew_ != 0; ++j) knows_tilt_ = knows_tilt_ && std::abs(modes_.turning(j)) * T >= 1;
  }

  /// The square of the nutation's frequency; one that does not turn has no modes, but one that hardly turns within T says the same of the spin angle.
  static Scalar turning_nutation(const Problem<Scalar>& problem, Scalar T) noexcept {
    const Scalar square = problem.nutation_squared(), least = Scalar(9e-6L) / (T * T);
    return std::abs(square) < least ? least : square;
  }

  /// e^(pace t) of all modes, its integral of those of the rates, and the angle of the spin.
  struct Turned {
    Scalar time, spin;
    Complex turn[modes], grown[modes];

    Turned(const TiltOrders& of, Scalar t) noexcept : time(t), spin(of.spin_ * t) {
      for (int j = 0; j < modes; ++j) turn[j] = math::exponential(t * of.modes_.pace[j]);
      for (int j = 1; j < modes; ++j) grown[j] = integral(of.modes_.pace[j], t, turn[j]);
    }
  };

  /// int_0^t e^(z s) ds, where e^(z t) = turned.
  static Complex integral(Complex z, Scalar t, Complex turned) noexcept {
    const Complex zt = t * z;
    if (math::magnitude_at_most(zt) > Scalar(0.5L)) return (turned - Complex{1, 0}) * math::inverse(z);
    return series(zt, t, 1);
  }
  /// int_0^t int_0^s e^(z r) dr ds.
  static Complex second_integral(Complex z, Scalar t, Complex turned) noexcept {
    const Complex zt = t * z;
    if (!(math::magnitude_at_most(zt) > Scalar(0.5L))) return series(zt, t * t / 2, 2);
    const Complex back = math::inverse(z);
    return (turned - Complex{1, 0} - zt) * (back * back);
  }
  /// first (1 + x/(n + 1) (1 + x/(n + 2) (...))), |x| <= 1/2: to 1e-13.
  static Complex series(Complex x, Scalar first, int n) noexcept {
    constexpr int terms = 11;
    Complex sum{1, 0};
    for (int k = terms; k > 0; --k) sum = Complex{1, 0} + (x / Scalar(n + k)) * sum;
    return first * sum;
  }

  /// int_0^t e^(z s) (int_0^s e^(w r) dr) ds, z and w being the pace of mode k and the conjugate of that of mode j.
  Complex paired(int k, int j, const Turned& now) const noexcept {
    const Complex z = modes_.pace[k], w = conjugate(modes_.pace[j]);
    constexpr Scalar still = Scalar(1e-4L);  // below, to (w t)^2/24
    if (math::magnitude_at_most(now.time * w) > still) {
      const Complex both = integral(z + w, now.time, now.turn[k] * conjugate(now.turn[j]));
      return (both - now.grown[k]) * math::inverse(w);
    }
    const Complex middle = z + w / Scalar(2), turned = math::exponential(now.time * middle);
    return now.time * integral(middle, now.time, turned) - second_integral(middle, now.time, turned);
  }

  /// Half the integral of Im(Pi Gamma~).
  Scalar nutation(const Turned& now) const noexcept {
    Scalar sum = 0;
    for (int k = 1; k < modes; ++k) {
      Complex reached = conjugate(start_) * now.grown[k];
      for (int j = 1; j < modes; ++j) reached = reached + conjugate(modes_.rate[j]) * paired(k, j, now);
      sum += (modes_.rate[k] * reached).im;
    }
    return sum / 2;
  }
  /// The integral of r - r0.
  Scalar change_of_spin(const Turned& now) const noexcept {
    if (skew_ == 0) return 0;
    const Complex back = math::unit(-2 * now.spin), frame{0, -2 * spin_};
    Scalar sum = 0;
    for (int k = 1; k < modes; ++k)
      for (int j = 1; j < modes; ++j)
        sum += (modes_.rate[k] * modes_.rate[j] *
                second_integral(modes_.pace[k] + modes_.pace[j] + frame, now.time, now.turn[k] * now.turn[j] * back))
                   .im;
    return skew_ * sum;
  }

  Complex start_;       ///< Gamma at t = 0, rad
  Scalar spin_, skew_;  ///< r0, rad/s; (D1 - D2)/(2 D3)
  detail::TiltModes<Scalar> modes_;
  bool knows_tilt_ = false;
  Complex turned_back_{};  ///< the tilt that SecondOrder turns back
};

/// The error of the attitude of the linear motion at the times, rad: the second order of the spin angle, times 1.1, and what is left of higher
/// orders. Never above error.attitude. `left`: second_order_errors of the same span.
template <Real Scalar>
Scalar linear_attitude_error(const LinearErrors<Scalar>& error, const LinearErrors<Scalar>& left,
                             const TiltOrders<Scalar>& orders, std::span<const Scalar> times) noexcept {
  Scalar most = 0;
  for (const Scalar t : times) {
    const Scalar angle = std::abs(orders.spin_angle(t));
    if (!(angle < infinity<Scalar>)) return error.attitude;
    most = std::max(most, angle);
  }
  return std::min(error.attitude, std::hypot(Scalar(1.1L) * most + left.theta, error.tilt));
}

/// The same of SecondOrder, whose errors are `error`: the third order of the tilt, times 1.25, and what the change of the spin rate makes of it.
template <Real Scalar>
Scalar second_order_attitude_error(const LinearErrors<Scalar>& error, const TiltOrders<Scalar>& orders,
                                   std::span<const Scalar> times) noexcept {
  if (!orders.knows_tilt()) return error.attitude;
  Scalar most = 0;
  for (const Scalar t : times) most = std::max(most, orders.tilt(t));
  const Scalar tilt = Scalar(1.25L) * most + error.of_spin_rate + error.size.tilt * error.theta;
  return std::min(error.attitude, std::hypot(error.theta, tilt));
}

}  // namespace gyrostat::spinning
