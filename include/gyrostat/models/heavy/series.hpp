// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/heavy/attitude.hpp"
#include "gyrostat/models/heavy/lindstedt.hpp"
#include "gyrostat/models/heavy/phase_turns.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

namespace gyrostat::heavy {

/// Errors up to here (of rates over the spin; rad) mean something: beyond, the terms left out are no longer the lesser ones.
inline constexpr double series_domain = 0.3;

/// The largest errors of a motion over a span of time.
template <Real Scalar>
struct MotionError {
  Scalar angular_velocity = 0;  ///< rad/s
  Scalar down = 0;              ///< rad
  Scalar attitude = 0;          ///< rotation angle, rad, at most pi

  /// The largest of the three, the first over |spin|.
  Scalar relative(Scalar spin) const noexcept {
    return std::fmax(angular_velocity / std::abs(spin), std::fmax(down, attitude));
  }
  /// Infinite in the place of what is no number.
  MotionError or_infinite() const noexcept {
    const auto one = [](Scalar x) { return x == x ? x : infinity<Scalar>; };
    return {one(angular_velocity), one(down), one(attitude)};
  }
};

/// Errors of a forced motion: of its shape, and of its phase and precession, which grow with time.
template <Real Scalar>
struct ForcedError {
  Scalar spin = 1;  ///< r0, rad/s
  Scalar rates = 0, down = 0, swing = 0;
  Scalar phase = 0, drift = 0;                              ///< of Omega and of the mean of psi'/r0
  Scalar rates_slope = 0, down_slope = 1, swing_slope = 0;  ///< of the motion over its phase, bounds

  /// Over |times| up to t.
  MotionError<Scalar> at(Scalar t) const noexcept {
    const Scalar angle = std::abs(spin * t), late = (phase + 4 * epsilon<Scalar>)*angle;
    // down is set to length one, which moves it by no more than its error
    const Scalar direction = 2 * down + down_slope * late;
    return MotionError<Scalar>{
        std::abs(spin) * (rates + rates_slope * late), direction,
        std::fmin(direction + (swing_slope + 1) * late + swing + (drift + 4 * epsilon<Scalar>)*angle, pi<Scalar>)}
        .or_infinite();
  }

  /// What a sum of the terms 0..kept leaves out, and rounding.
  static ForcedError of(const Lindstedt<Scalar>& terms, int kept) noexcept {
    const Scaled<Scalar>& s = terms.scaled();
    const auto left = terms.remainder(kept);
    Scalar amplified = std::abs(detail::ratio_or_zero(s.torque(), s.flatness));
    if (s.load[0] != 0) amplified = std::fmax(amplified, s.torque() / std::abs(s.off_a));
    if (s.load[1] != 0) amplified = std::fmax(amplified, s.torque() / std::abs(s.off_b));
    const Scalar rounding = 8 * epsilon<Scalar> * (1 + amplified);
    return {.spin = s.spin,
            .rates = left.rates + rounding,
            .down = left.down + rounding,
            .swing = left.swing + rounding,
            .phase = left.phase + 2 * terms.imbalance() / s.M3 + 8 * epsilon<Scalar> * amplified,
            .drift = left.drift + 2 * terms.imbalance() / (s.M3 * s.M3) + 8 * epsilon<Scalar> * amplified};
  }
};

/// The forced motion of a fast spin, of period 2 pi/(Omega r0) but for its precession, by the series of Lindstedt to any even order in
/// eps = c/r0 up to 30, without smallness of its inclination (docs/heavy.md, section 3). At t = 0: r = r0, down = (M3, 0, G0); p0
/// and q0 are those of the periodic motion (state at t = 0), and no others give it: a free nutation is not in it. No heap; a
/// construction takes about 120 kB of stack (double).
template <Real Scalar>
class Series {
 public:
  static constexpr int highest_order = 2 * Lindstedt<Scalar>::most;

  Series() = default;

  /// To a given order, or to a lower one where the terms between are below rounding. Errors: those of Scaled; out_of_domain (order odd, < 2 or > highest_order); not_applicable (a divisor 1 - a, 1 - b,
  /// a + b - 1 vanishes); no_convergence (the terms do not fall: too slow a spin, or too near such a divisor).
  static Result<Series> make(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination, int order) noexcept {
    if (order < 2 || order > highest_order || order % 2 != 0) return Errc::out_of_domain;
    const auto scaled = Scaled<Scalar>::make(problem, spin, cos_inclination);
    if (!scaled) return scaled.error();
    if (outweighs_flatness(*scaled)) return Errc::no_convergence;
    Lindstedt<Scalar> terms(*scaled);
    const int needed = std::min(order / 2 + 2, Lindstedt<Scalar>::most);
    while (terms.order() < needed && !terms.spent() && terms.advance()) {
    }
    if (terms.order() < needed && !terms.spent()) return Errc::not_applicable;
    if (!(terms.fall() < 1)) return Errc::no_convergence;
    return Series(terms, std::min(order / 2, terms.order()));
  }

  /// To the least order that keeps every error over |times| <= span below the tolerance (relative to r0 for the rates, rad for down and
  /// attitude), or, where none does, to the order of least error: see error(). Errors: as above.
  static Result<Series> to_tolerance(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination,
                                     Scalar tolerance, Scalar span) noexcept {
    const auto scaled = Scaled<Scalar>::make(problem, spin, cos_inclination);
    if (!scaled) return scaled.error();
    if (outweighs_flatness(*scaled)) return Errc::no_convergence;
    Lindstedt<Scalar> terms(*scaled);
    const auto error = [&](int kept) noexcept { return ForcedError<Scalar>::of(terms, kept).at(span); };
    // the last term is a check alone: an error is never estimated from terms that are kept
    while (!terms.spent() && terms.advance())
      if (terms.order() >= 3 && error(terms.order() - 1).relative(spin) <= tolerance)
        return Series(terms, terms.order() - 1);
    if (terms.order() < 2) return Errc::not_applicable;
    if (!(terms.fall() < 1)) return Errc::no_convergence;
    // near the vertical the attitude may be lost whatever the order: then the rest decides
    const auto measure = [&](int kept) noexcept {
      const MotionError<Scalar> e = error(kept);
      return e.relative(spin) + e.angular_velocity / std::abs(spin) + e.down;
    };
    int best = 1;
    for (int kept = 2; kept < terms.order(); ++kept)
      if (measure(kept) < measure(best)) best = kept;
    return Series(terms, best);
  }

  int order() const noexcept { return order_; }  ///< in eps, even
  const Scaled<Scalar>& scaled() const noexcept { return scaled_; }
  Scalar phase_rate() const noexcept { return rate_ * scaled_.spin; }                 ///< of u, rad/s
  Scalar period() const noexcept { return 2 * pi<Scalar> / std::abs(phase_rate()); }  ///< of rates and down, s
  Scalar precession_rate() const noexcept { return drift_ * scaled_.spin; }           ///< mean of psi', rad/s
  /// Relative, of the period.
  Scalar period_error() const noexcept { return (error_.phase + 4 * epsilon<Scalar>) / std::abs(rate_); }
  /// Of precession_rate(), rad/s.
  Scalar precession_error() const noexcept {
    return std::abs(scaled_.spin) * (error_.drift + 4 * epsilon<Scalar> * std::abs(drift_));
  }
  /// The largest errors over |times| <= t: the terms left out as far as known, and a geometric tail. Measured against the periodic motion
  /// with the same r0 and G0; where that is unstable, a motion started beside it leaves it.
  MotionError<Scalar> error(Scalar t) const noexcept { return error_.at(t); }

  /// At any t of either sign.
  State<Scalar> at(Scalar t) const noexcept {
    const auto step = math::unit(phase_rate() * t);
    math::Complex<Scalar> turn = step;
    alignas(64) Scalar sum[width];
    for (int i = 0; i < width; ++i) sum[i] = c_[0][i];
    for (int j = 1; j < harmonics_; ++j, turn = turn * step)
      for (int i = 0; i < width; ++i) sum[i] += turn.re * c_[j][i] + turn.im * s_[j][i];
    State<Scalar> state;
    set_rates(state, sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]);
    state.attitude = attitude(t, step, state.down, sum[6]);
    return state;
  }

  /// states[i] at times[i], in any order; as many as both spans hold. The sums of many times side by side. Without `turning` the
  /// attitude is left as it is, at a fraction of the cost.
  void at(std::span<const Scalar> times, std::span<State<Scalar>> states, bool turning = true) const noexcept {
    constexpr std::size_t block = PhaseTurns<Scalar>::block;
    const std::size_t n = std::min(times.size(), states.size());
    const PhaseTurns<Scalar> turns(times.first(n), phase_rate());
    for (std::size_t first = 0; first < n; first += block) {
      const std::size_t here = std::min(block, n - first);
      alignas(64) Scalar c1[block], s1[block], c[block], s[block], sum[width][block];
      turns.write(first, c1, s1);
      std::copy(c1, c1 + block, c);
      std::copy(s1, s1 + block, s);
      for (int i = 0; i < width; ++i)
        for (std::size_t k = 0; k < block; ++k) sum[i][k] = c_[0][i];
      const int last = turning ? Lindstedt<Scalar>::unknowns : Lindstedt<Scalar>::turn;
      for (int j = 1; j < harmonics_; ++j) {
        for (int i = 0; i < last; ++i)
          for (std::size_t k = 0; k < block; ++k) sum[i][k] += c_[j][i] * c[k] + s_[j][i] * s[k];
        for (std::size_t k = 0; k < block; ++k) {
          const Scalar next = c[k] * c1[k] - s[k] * s1[k];
          s[k] = s[k] * c1[k] + c[k] * s1[k];
          c[k] = next;
        }
      }
      for (std::size_t k = 0; k < here; ++k) {
        State<Scalar>& to = states[first + k];
        set_rates(to, sum[0][k], sum[1][k], sum[2][k], sum[3][k], sum[4][k], sum[5][k]);
        if (turning) to.attitude = attitude(times[first + k], {c1[k], s1[k]}, to.down, sum[6][k]);
      }
    }
  }

 private:
  static constexpr int width = 8;

  /// The body is so nearly a lamina, whose free nutation keeps pace with the spin, that the torque decides whether it does: terms fall at first, and
  /// grow behind the last that is known.
  static bool outweighs_flatness(const Scaled<Scalar>& s) noexcept {
    return s.flatness != 0 && s.torque() > std::abs(s.flatness);
  }

  Series(const Lindstedt<Scalar>& terms, int kept) noexcept
      : scaled_(terms.scaled()), order_(2 * kept), error_(ForcedError<Scalar>::of(terms, kept)) {
    using L = Lindstedt<Scalar>;
    rate_ = 0;
    for (int n = kept; n >= 0; --n) rate_ += terms.rate(n);
    const int all = std::min(2 * kept + 2, L::harmonics);
    for (int i = 0; i < L::unknowns; ++i) {
      for (int j = 0; j < all; ++j) {
        Scalar c = 0, s = 0;
        for (int n = kept; n >= 0; --n) {
          if (i == L::turn && n == 0) continue;
          const auto& wave = terms.wave(static_cast<typename L::Unknown>(i), n);
          c += wave.c[j];
          s += wave.s[j];
        }
        c_[j][i] = c;
        s_[j][i] = s;
      }
    }
    // psi less its mean growth, 0 at u = 0
    drift_ = c_[0][L::turn];
    c_[0][L::turn] = 0;
    for (int j = 1; j < all; ++j) {
      const Scalar c = c_[j][L::turn], s = s_[j][L::turn], rate = rate_ * Scalar(j);
      c_[j][L::turn] = -s / rate;
      s_[j][L::turn] = c / rate;
      c_[0][L::turn] += s / rate;
    }
    harmonics_ = 1;
    error_.down_slope = 0;
    for (int j = 1; j < all; ++j) {
      const auto size = [&](int i) noexcept { return std::hypot(c_[j][i], s_[j][i]); };
      const Scalar rates = size(L::P) + size(L::Q) + size(L::R), down = size(L::g1) + size(L::g2) + size(L::g3);
      error_.rates_slope += Scalar(j) * rates;
      error_.down_slope += Scalar(j) * down;
      error_.swing_slope += Scalar(j) * size(L::turn);
      if (rates + down + size(L::turn) > epsilon<Scalar> / 32) harmonics_ = j + 1;
    }
  }

  void set_rates(State<Scalar>& to, Scalar p, Scalar q, Scalar r, Scalar d1, Scalar d2, Scalar d3) const noexcept {
    const Scalar over = 1 / std::sqrt(d1 * d1 + d2 * d2 + d3 * d3);
    to.angular_velocity = {scaled_.spin * p, scaled_.spin * q, scaled_.spin * r};
    to.down = {over * d1, over * d2, over * d3};
  }

  Quat<Scalar> attitude(Scalar t, math::Complex<Scalar> turn, const Vec3<Scalar>& down, Scalar swing) const noexcept {
    return attitude_from_angles(precession_rate() * t + swing, spin_angle(down, phase_rate() * t, turn), down);
  }

  Scaled<Scalar> scaled_;
  int order_ = 0;
  int harmonics_ = 1;
  Scalar rate_ = 1, drift_ = 0;
  ForcedError<Scalar> error_;
  alignas(64) Scalar c_[Lindstedt<Scalar>::harmonics][width] = {};  ///< cos ju of P, Q, R, g1, g2, g3, psi, nothing
  alignas(64) Scalar s_[Lindstedt<Scalar>::harmonics][width] = {};
};

#ifdef GYROSTAT_COMPILED
extern template class Series<double>;
#endif

}  // namespace gyrostat::heavy
