// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/models/spinning/second_order.hpp"

namespace gyrostat::spinning {

namespace detail {

/// A sum of c int_0^t e^(i w s) ds: how large it may be within [0, T]. Terms whose frequencies agree so well that they hardly part within T are added with their
/// phases, as the large ones of modes that all but agree cancel; the rest by their sizes.
template <Real Scalar, std::size_t most>
class ModeSum {
 public:
  using Complex = math::Complex<Scalar>;

  void add(Complex c, Scalar w) noexcept { terms_[count_++] = {c, w}; }

  Scalar greatest(Scalar T) noexcept {
    std::sort(terms_.begin(), terms_.begin() + std::ptrdiff_t(count_),
              [](const Term& a, const Term& b) noexcept { return a.w < b.w; });
    Scalar sum = 0;
    for (std::size_t first = 0, last = 0; first < count_; first = last) {
      ++last;
      while (last < count_ && (terms_[last].w - terms_[first].w) * T <= 1) ++last;
      const std::span<const Term> cluster(&terms_[first], last - first);
      const Scalar middle = (terms_[first].w + terms_[last - 1].w) / 2;
      sum += std::abs(middle) * T <= 2 ? still(cluster, T) : swinging(cluster, middle, T);
    }
    return sum;
  }

 private:
  struct Term {
    Complex c;
    Scalar w;
  };
  static constexpr int looks = 8;  // what is slower than a radian in T is smooth

  static Scalar still(std::span<const Term> cluster, Scalar T) noexcept {
    Scalar greatest = 0;
    for (int i = 1; i <= looks; ++i) {
      const Scalar t = T * Scalar(i) / looks;
      Complex sum{};
      // t times what is smooth at w = 0: the sine and cosine of half the angle
      for (const auto& [c, w] : cluster) {
        const Scalar half = w * t / 2;
        sum = sum + (t * (half == 0 ? Scalar(1) : std::sin(half) / half)) * (c * math::unit(half));
      }
      greatest = std::max(greatest, magnitude(sum));
    }
    return greatest;
  }
  static Scalar swinging(std::span<const Term> cluster, Scalar middle, Scalar T) noexcept {
    std::array<Complex, looks + 1> sum{};
    for (const auto& [c, w] : cluster) {
      const Complex step = math::unit((w - middle) * T / looks);
      Complex now = (1 / w) * c;
      for (Complex& at : sum) {
        at = at + now;
        now = now * step;
      }
    }
    Scalar greatest = 0;
    for (const Complex& at : sum) greatest = std::max(greatest, magnitude(at));
    return magnitude(sum[0]) + greatest;
  }

  std::array<Term, most> terms_{};
  std::size_t count_ = 0;
};

}  // namespace detail

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
    const Turned now(modes_, spin_, t);
    Complex A = start_;
    for (int j = 1; j < count; ++j) A = A + modes_.rate[j] * now.grown[j];
    const Complex Gamma = conjugate(math::unit(now.spin)) * A;
    return nutation(now) + change_of_spin(now) - (Gamma.re * Gamma.im - start_.re * start_.im) / 2;
  }

  /// Whether tilt() and third_order() say it: the nutation is stable, or there is hardly any within T, and of no mode is the tilt so many times what it is of all
  /// that rounding would count; and of an asymmetric body all turn through a radian.
  bool knows_tilt() const noexcept { return knows_tilt_; }

  /// What SecondOrder leaves out of the tilt to third order, rad, but for what the change of the spin rate makes of the nutation: half the integral of
  /// |A|^2 A' less the turn of the part that stands still.
  Scalar tilt(Scalar t) const noexcept {
    const Turned now(apart_, spin_, t);
    Complex sum{};
    for (int k = 1; k < count; ++k)
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
          const Complex turned = now.turn[i] * conjugate(now.turn[j]) * now.turn[k];
          sum = sum + product(i, j, k) *
                          integral(apart_.pace[i] + conjugate(apart_.pace[j]) + apart_.pace[k], now.time, turned);
        }
    const Scalar change = change_of_spin(now);
    return magnitude(sum + math::turned(change * apart_.tilt[0] - (nutation(now) + change) * turned_back_));
  }

  /// Bounds over [0, T], where knows_tilt(). Some ten microseconds.
  ThirdOrder<Scalar> third_order() const noexcept {
    if (!knows_tilt_) return {};
    detail::ModeSum<Scalar, 12> phase;
    detail::ModeSum<Scalar, 48> body;
    detail::ModeSum<Scalar, 72> second;
    for (int k = 1; k < count; ++k)
      for (int j = 0; j < count; ++j) {
        const Scalar w = apart_.turning(k) - apart_.turning(j);
        const Complex c = apart_.rate[k] * conjugate(apart_.tilt[j]) / Scalar(2);
        phase.add(c, w);
        second.add(-(turned_back_ * c) / Scalar(2), w);
        second.add(turned_back_ * conjugate(c) / Scalar(2), -w);
        for (int i = 0; i < count; ++i) {
          body.add(product(i, j, k), w + apart_.turning(i));
          second.add(product(i, j, k), w + apart_.turning(i));
        }
      }
    const Scalar bent = std::pow(magnitude(start_), 3) / 2;  // at the start the angles are no direction
    const Scalar whole = phase.greatest(span_) + std::abs(start_.re * start_.im) / 2;
    ThirdOrder<Scalar> most;
    most.in_body = body.greatest(span_) + change_ * apart_.tilted[0] + bent;
    most.in_space = most.in_body + (whole + change_) * size_.tilt;
    most.second = second.greatest(span_) + change_ * (apart_.tilted[0] + magnitude(turned_back_));
    return most;
  }

 private:
  using Complex = math::Complex<Scalar>;
  using Modes = detail::TiltModes<Scalar>;
  static constexpr int count = Modes::count;

  TiltOrders(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar T) noexcept
      : start_(start.Gamma),
        spin_(problem.spin()),
        skew_((problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2])),
        span_(T),
        modes_(problem, start, turning_nutation(problem, T)),
        apart_(problem, start, nutation_apart(problem, T)),
        size_(amplitudes(problem, T)) {
    constexpr Scalar greatest = 3000;
    turned_back_ = detail::StillTilt<Scalar>(Modes(problem, start), size_, T).still;
    if (skew_ != 0) change_ = detail::SpinChange<Scalar>(problem, start, size_.rate, T).angle;
    knows_tilt_ = apart_.stable && (skew_ == 0 || nutation_apart(problem, T) == problem.nutation_squared());
    for (int j = 0; j < count; ++j) knows_tilt_ = knows_tilt_ && apart_.tilted[j] <= greatest * size_.tilt;
    // where the spin rate changes, it turns what stands still and a mode that all but does, and these cancel
    for (int j = 1; j < count && skew_ != 0; ++j) knows_tilt_ = knows_tilt_ && std::abs(apart_.turning(j)) * T >= 1;
  }

  static constexpr Scalar least_turn = Scalar(3e-3L);  ///< within T, rad
  /// The square of the nutation's frequency; one that does not turn has no modes, but one that hardly turns within T says the same of the spin angle.
  static Scalar turning_nutation(const Problem<Scalar>& problem, Scalar T) noexcept {
    const Scalar square = problem.nutation_squared(), least = least_turn * least_turn / (T * T);
    return std::abs(square) < least ? least : square;
  }
  /// The same, so far from the spin rate that no mode stands still: of the tilt it says as much to a share least_turn.
  static Scalar nutation_apart(const Problem<Scalar>& problem, Scalar T) noexcept {
    const Scalar square = turning_nutation(problem, T), spin = std::abs(problem.spin()), least = least_turn / T;
    if (!(square > 0) || !(std::abs(std::sqrt(square) - spin) < least)) return square;
    return (spin + least) * (spin + least);
  }

  /// e^(pace t) of all modes, its integral of those of the rates, and the angle of the spin.
  struct Turned {
    const Modes& modes;
    Scalar time, spin;
    Complex turn[count], grown[count];

    Turned(const Modes& of, Scalar rate, Scalar t) noexcept : modes(of), time(t), spin(rate * t) {
      for (int j = 0; j < count; ++j) turn[j] = math::exponential(t * of.pace[j]);
      for (int j = 1; j < count; ++j) grown[j] = integral(of.pace[j], t, turn[j]);
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
    const Complex z = now.modes.pace[k], w = conjugate(now.modes.pace[j]);
    constexpr Scalar still = Scalar(1e-4L);  // below, to (w t)^2/24
    if (math::magnitude_at_most(now.time * w) > still) {
      const Complex both = integral(z + w, now.time, now.turn[k] * conjugate(now.turn[j]));
      return (both - now.grown[k]) * math::inverse(w);
    }
    const Complex middle = z + w / Scalar(2), turned = math::exponential(now.time * middle);
    return now.time * integral(middle, now.time, turned) - second_integral(middle, now.time, turned);
  }

  /// Of half the integral of |A|^2 A'.
  Complex product(int i, int j, int k) const noexcept {
    return apart_.rate[k] * (apart_.tilt[i] * conjugate(apart_.tilt[j])) / Scalar(2);
  }

  /// Half the integral of Im(Pi Gamma~).
  Scalar nutation(const Turned& now) const noexcept {
    Scalar sum = 0;
    for (int k = 1; k < count; ++k) {
      Complex reached = conjugate(start_) * now.grown[k];
      for (int j = 1; j < count; ++j) reached = reached + conjugate(now.modes.rate[j]) * paired(k, j, now);
      sum += (now.modes.rate[k] * reached).im;
    }
    return sum / 2;
  }
  /// The integral of r - r0.
  Scalar change_of_spin(const Turned& now) const noexcept {
    if (skew_ == 0) return 0;
    const Complex back = math::unit(-2 * now.spin), frame{0, -2 * spin_};
    Scalar sum = 0;
    for (int k = 1; k < count; ++k)
      for (int j = 1; j < count; ++j)
        sum +=
            (now.modes.rate[k] * now.modes.rate[j] *
             second_integral(now.modes.pace[k] + now.modes.pace[j] + frame, now.time, now.turn[k] * now.turn[j] * back))
                .im;
    return skew_ * sum;
  }

  Complex start_;       ///< Gamma at t = 0, rad
  Scalar spin_, skew_;  ///< r0, rad/s; (D1 - D2)/(2 D3)
  Scalar span_;         ///< T, s
  Modes modes_, apart_;
  Amplitudes<Scalar> size_;
  Scalar change_ = 0;  ///< of the spin angle by that of the spin rate, at most, rad
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
