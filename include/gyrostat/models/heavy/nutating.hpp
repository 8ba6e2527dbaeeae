// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/heavy/attitude.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/scaled.hpp"
#include "gyrostat/models/heavy/series.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::heavy {

/// The motion of a fast spin from any start, to first order in the tilt of the spin and in eps = c/r0 (docs/heavy.md, section 5): the
/// forced motion, and a free nutation whose frequency and that of the spin depend on the amplitude. Two frequencies: it never
/// repeats. Axis 3 is that of the largest or the least moment.
template <Real Scalar>
class Nutating {
 public:
  Nutating() = default;

  /// From t = 0. Errors: those of Scaled, with spin = r and cos_inclination = the third of down; not_finite; not_applicable (axis 3 is the
  /// intermediate one, or A = C or B = C, or a divisor vanishes).
  /// @param start down of unit length, the attitude's last row -down
  static Result<Nutating> make(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept {
    if (!start.angular_velocity.allFinite() || !start.down.allFinite()) return Errc::not_finite;
    const auto scaled = Scaled<Scalar>::make(problem, start.angular_velocity[2], start.down[2]);
    if (!scaled) return scaled.error();
    const FirstOrder<Scalar> first(*scaled);
    const Scalar forced = std::abs(first.chi) + std::abs(first.kap) + std::abs(first.X) + std::abs(first.Y);
    if (!(scaled->nutation_squared() > 0) || !(forced < infinity<Scalar>)) return Errc::not_applicable;
    return Nutating(*scaled, first, start);
  }

  const Scaled<Scalar>& scaled() const noexcept { return s_; }
  Scalar nutation_rate() const noexcept { return nutation_ * s_.spin; }          ///< of p, q in the body, rad/s
  Scalar phase_rate() const noexcept { return rate_ * s_.spin; }                 ///< of down in the body, rad/s
  Scalar precession_rate() const noexcept { return f_.precession() * s_.spin; }  ///< mean of psi', rad/s
  Scalar amplitude() const noexcept { return amplitude_ * std::abs(s_.spin); }   ///< of p in the free nutation, rad/s

  /// The largest errors over |times| <= t: orders 2 and 3 of the small quantities, with twice the constants of some hundred bodies, and
  /// stiffening().
  MotionError<Scalar> error(Scalar t) const noexcept {
    const Scalar angle = std::abs(s_.spin * t), rounding = 4 * epsilon<Scalar> * (1 + angle);
    const Scalar stiffened = stiffening(angle);
    const Scalar shape = std::fmax(6 * small_ * small_ * (1 + small_ * angle / 4),
                                   std::fmax(std::fmax(s_.a, s_.b), Scalar(1)) * stiffened);
    const Scalar down = shape + rounding;
    // half the spin rate is a resonance of the next order
    const Scalar near = 1 + Scalar(0.04L) / std::abs(1 - 2 * std::sqrt(s_.nutation_squared()));
    const Scalar rates = small_ > 0 ? std::fmax(near * small_ * shape, stiffened)
                                    : Scalar(0);  // on the resonance itself nothing is left of a steady spin's
    return MotionError<Scalar>{std::abs(s_.spin) * (rates + rounding), down,
                               std::fmin(down + shape / s_.M3, pi<Scalar>)}
        .or_infinite();
  }

  /// At any t of either sign; at t = 0 the start itself.
  State<Scalar> at(Scalar t) const noexcept {
    State<Scalar> state = model(t);
    state.attitude = turned_ * state.attitude;
    return state;
  }

  /// states[i] at times[i], in any order; as many as both spans hold. Without `turning` the attitude means nothing.
  void at(std::span<const Scalar> times, std::span<State<Scalar>> states, bool turning = true) const noexcept {
    for (std::size_t i = 0; i < times.size() && i < states.size(); ++i)
      states[i] = turning ? at(times[i]) : model(times[i]);
  }

 private:
  using Complex = math::Complex<Scalar>;

  Nutating(const Scaled<Scalar>& scaled, const FirstOrder<Scalar>& first, const State<Scalar>& start) noexcept
      : s_(scaled), f_(first) {
    const Scalar a = s_.a, b = s_.b, G0 = s_.G0, k = s_.gradient, A1 = s_.A1, B1 = s_.B1;
    const Scalar P = start.angular_velocity[0] / s_.spin - f_.X, Q = start.angular_velocity[1] / s_.spin - f_.Y;
    const Scalar d1 = start.down[0], d2 = start.down[1];
    // p = m + chi g + X, q = n + kap h + Y, d1 = g + a G0 m, d2 = -h + b G0 n with g + i h = Gamma e^(i u), m = Re, n = kappa Im
    const Scalar g = (d1 - a * G0 * P) / (1 - a * G0 * f_.chi);
    const Scalar h = -(d2 - b * G0 * Q) / (1 + b * G0 * f_.kap);
    const Scalar m = P - f_.chi * g, n = Q - f_.kap * h;
    const Scalar omega2 = s_.nutation_squared(), omega = std::sqrt(omega2);
    kappa_ = omega / A1;
    down_ = {g, h};
    nutating_ = {m, n / kappa_};
    const Scalar e2 = m * m + n * n / (kappa_ * kappa_), M2 = g * g + h * h, x = s_.load[0], y = s_.load[1],
                 z = s_.load[2];
    amplitude_ = std::sqrt(e2);
    start_ = a * m * m + b * n * n - 2 * (x * g - y * h) + k * (a * g * g + b * h * h);
    raised_ = a * m * g - b * n * h;
    const Scalar pull = a * f_.chi * s_.flatness / (a * b);
    const Scalar L = omega2 * (e2 / 4 * (s_.C1 / A1 + 3 * a + b * kappa_ * kappa_) - start_) - G0 * (z / a + pull) +
                     k * (A1 * (G0 * G0 - M2 / 2) + M2 / 2 * (a * A1 + omega2 * b));
    const Scalar N = -start_ - e2 / 2 * (a * B1 + kappa_ * kappa_ * s_.off_b) - G0 * (z / b - pull) +
                     k * (M2 / 2 * (a + b) - B1 * G0 * G0);
    nutation_ = omega - L / (2 * omega);
    stiffer_ = std::abs(L) / omega2;
    rate_ = 1 - N / 2;
    const Scalar forced = std::abs(f_.chi) + std::abs(f_.kap) + std::abs(f_.X) + std::abs(f_.Y);
    // the tilts of the spin and of the momentum, which is the larger where axis 3 is that of the least moment
    const Scalar tilt = std::fmax(std::fmax(Scalar(1), a), std::fmax(Scalar(1), b) * std::abs(kappa_));
    small_ = std::sqrt(forced + s_.torque() + e2 * tilt * tilt);
    turned_ = start.attitude * conjugate(model(0).attitude);
  }

  /// What the free nutation errs by in p and q, over the spin, within an angle of the spin: weight and amplitude change the two differences of
  /// moments A1 and B1 that hold it, of which the motion takes the change of the frequency alone. Where moment A or B is next to C that is
  /// no small part of A1 or B1, which share p and q out.
  Scalar stiffening(Scalar angle) const noexcept {
    const Scalar swung = std::sqrt(s_.nutation_squared()) * angle;
    return amplitude_ * std::fmax(std::abs(kappa_), Scalar(1)) * stiffer_ *
           (std::fmin(swung, Scalar(1)) + stiffer_ * swung / 2);
  }

  /// With the attitude of psi = 0 at t = 0.
  State<Scalar> model(Scalar t) const noexcept {
    const Scalar angle = s_.spin * t, u = rate_ * angle, a = s_.a, b = s_.b, G0 = s_.G0;
    const Complex spun = math::unit(u), swung = math::unit(nutation_ * angle);
    const Complex G = down_ * spun, F = nutating_ * swung;
    const Scalar g = G.re, h = G.im, m = F.re, n = kappa_ * F.im;
    const Scalar gained = start_ - (a * m * m + b * n * n - 2 * (s_.load[0] * g - s_.load[1] * h) +
                                    s_.gradient * (a * g * g + b * h * h));
    State<Scalar> state;
    state.angular_velocity = {s_.spin * (m + f_.chi * g + f_.X), s_.spin * (n + f_.kap * h + f_.Y),
                              s_.spin * (1 + gained / 2)};
    const Vec3<Scalar> down{g + a * G0 * m, -h + b * G0 * n, G0 + raised_ - (a * m * g - b * n * h)};
    state.down = down / down.norm();
    const Scalar psi = precession_rate() * t + swing(F, G) - swing(nutating_, down_);
    const Scalar phase = std::atan2(down_.im, down_.re);
    state.attitude = attitude_from_angles(psi, spin_angle(state.down, u + phase, math::unit(u + phase)), state.down);
    return state;
  }

  /// The integral of (m g - n h)/M3^2, the first order of psi'.
  Scalar swing(Complex F, Complex G) const noexcept {
    const Scalar omega = std::sqrt(s_.nutation_squared()), together = (F * G).im, apart = (F * math::conjugate(G)).im;
    return ((1 + kappa_) * together / (omega + 1) + (1 - kappa_) * apart / (omega - 1)) / (2 * s_.M3 * s_.M3);
  }

  Scaled<Scalar> s_;
  FirstOrder<Scalar> f_;
  Complex down_, nutating_;
  Scalar kappa_ = 1, nutation_ = 0, rate_ = 1, amplitude_ = 0, small_ = 0;
  Scalar stiffer_ = 0;             ///< relative change of the square of the frequency of nutation
  Scalar start_ = 0, raised_ = 0;  // what r and the third of down hold at t = 0
  Quat<Scalar> turned_;
};

}  // namespace gyrostat::heavy
