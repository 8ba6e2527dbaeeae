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
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/models/heavy/scaled.hpp"
#include "gyrostat/models/heavy/series.hpp"

namespace gyrostat::heavy {

/// The forced motion of a fast spin to second order in eps = c/r0 in closed form, any inclination (docs/heavy.md, section 3). Errors are
/// O(eps^4) of r0 in the rates, O(eps^4) in down. At t = 0: r = r0, down = (M3, 0, G0), psi = 0; p0 and q0 are those of the periodic
/// motion, and no others give it.
template <Real Scalar>
class Series2 {
 public:
  Series2() = default;

  /// Errors: those of Scaled; not_applicable (a divisor 1 - a, 1 - b, a + b - 1 vanishes that divides something). Where the terms do not
  /// fall it is made all the same, with an infinite error.
  static Result<Series2> make(const Problem<Scalar>& problem, Scalar spin, Scalar cos_inclination) noexcept {
    const auto scaled = Scaled<Scalar>::make(problem, spin, cos_inclination);
    if (!scaled) return scaled.error();
    Series2 made;
    made.s_ = *scaled;
    made.f_ = FirstOrder<Scalar>(*scaled);
    const auto& f = made.f_;
    if (!(std::abs(f.chi) + std::abs(f.kap) + std::abs(f.X) + std::abs(f.Y) < infinity<Scalar>))
      return Errc::not_applicable;
    Lindstedt<Scalar> terms(*scaled);
    while (terms.order() < 5 && terms.advance()) {
    }
    made.error_ = ForcedError<Scalar>::of(terms, 1);
    if (terms.order() < 5) made.error_.rates = made.error_.down = infinity<Scalar>;
    const Scalar M3 = scaled->M3, C1 = std::abs(scaled->C1);
    const Scalar wide = std::abs(f.X) + std::abs(f.Y), twice = M3 * C1 * (std::abs(f.lift) + scaled->gradient);
    const Scalar load = std::abs(scaled->load[0]) + std::abs(scaled->load[1]);
    made.error_.rates_slope = M3 * (std::abs(f.chi) + std::abs(f.kap) + load + twice);
    made.error_.down_slope = M3 + 4 * (wide + load + twice);
    made.error_.swing_slope = wide / M3 + (std::abs(f.chi) + std::abs(f.kap)) / 2;
    return made;
  }

  const Scaled<Scalar>& scaled() const noexcept { return s_; }
  const FirstOrder<Scalar>& first_order() const noexcept { return f_; }
  Scalar phase_rate() const noexcept { return (1 + f_.rate) * s_.spin; }              ///< of u, rad/s
  Scalar period() const noexcept { return 2 * pi<Scalar> / std::abs(phase_rate()); }  ///< of rates and down, s
  Scalar precession_rate() const noexcept { return f_.precession() * s_.spin; }       ///< mean of psi', rad/s
  /// Relative, of the period.
  Scalar period_error() const noexcept { return (error_.phase + 4 * epsilon<Scalar>) / std::abs(1 + f_.rate); }
  /// Of precession_rate(), rad/s.
  Scalar precession_error() const noexcept { return std::abs(s_.spin) * error_.drift; }
  /// The largest errors over |times| <= t: the next four orders of the series, and a geometric tail. Against the periodic motion with the
  /// same r0 and G0; where that is unstable, a motion started beside it leaves it.
  MotionError<Scalar> error(Scalar t) const noexcept { return error_.at(t); }

  /// At any t of either sign.
  State<Scalar> at(Scalar t) const noexcept {
    const Scalar x = s_.load[0], y = s_.load[1], k = s_.gradient, C1 = s_.C1, M3 = s_.M3, G0 = s_.G0;
    const Scalar u = phase_rate() * t;
    const auto half = math::unit(u / 2), turn = half * half;
    const Scalar c = turn.re, s = turn.im, s2 = 2 * s * c;
    const Scalar v = 2 * half.im * half.im, v2 = 2 * s * s;                // 1 - cos u, 1 - cos 2u
    const Scalar lift = f_.X * v + f_.Y * s - M3 * C1 * f_.lift * v2 / 2;  // of g3, over M3
    const Scalar swing = f_.X * s - f_.Y * v;
    const Scalar shift = M3 * (M3 * (x * s - y * v) + k * C1 * M3 * M3 * s2 / 8) -
                         G0 * (swing + M3 * (f_.chi + f_.kap) * s2 / 4);  // of phi, times M3
    const Scalar radius = M3 - G0 * lift;
    State<Scalar> state;
    state.angular_velocity = {s_.spin * (f_.X + f_.chi * M3 * c), s_.spin * (f_.Y + f_.kap * M3 * s),
                              s_.spin * (1 - M3 * (x * v + y * s + k * C1 * M3 * v2 / 4))};
    const Vec3<Scalar> down{radius * c - shift * s, -radius * s - shift * c, G0 + M3 * lift};
    state.down = down / down.norm();
    const Scalar psi = precession_rate() * t + (f_.chi + f_.kap) * s2 / 4 + swing / M3;
    state.attitude = attitude_from_angles(psi, spin_angle(state.down, u, turn), state.down);
    return state;
  }

  /// states[i] at times[i], in any order; as many as both spans hold.
  void at(std::span<const Scalar> times, std::span<State<Scalar>> states) const noexcept {
    for (std::size_t i = 0; i < times.size() && i < states.size(); ++i) states[i] = at(times[i]);
  }

 private:
  Scaled<Scalar> s_;
  FirstOrder<Scalar> f_;
  ForcedError<Scalar> error_;
};

}  // namespace gyrostat::heavy
