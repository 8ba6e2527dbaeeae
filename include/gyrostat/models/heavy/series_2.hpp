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
  Scalar period_error() const noexcept { return known((error_.phase + 4 * epsilon<Scalar>) / std::abs(1 + f_.rate)); }
  /// Of precession_rate(), rad/s.
  Scalar precession_error() const noexcept { return known(std::abs(s_.spin) * error_.drift); }
  /// The largest errors over |times| <= t: the next four orders of the series, and a geometric tail. Against the periodic motion with the
  /// same r0 and G0; where that is unstable, a motion started beside it leaves it.
  MotionError<Scalar> error(Scalar t) const noexcept { return error_.at(t); }

  /// At any t of either sign.
  State<Scalar> at(Scalar t) const noexcept {
    const auto half = math::unit(phase_rate() * t / 2), turn = half * half;
    State<Scalar> state;
    set(state, shape(turn.re, turn.im, 2 * half.im * half.im));
    state.attitude = attitude(t, turn, state.down);
    return state;
  }

  /// states[i] at times[i], in any order; as many as both spans hold. Without `turning` the attitude is left as it is, at a fraction of
  /// the cost.
  void at(std::span<const Scalar> times, std::span<State<Scalar>> states, bool turning = true) const noexcept {
    constexpr std::size_t block = PhaseTurns<Scalar>::block;
    const std::size_t n = std::min(times.size(), states.size());
    const PhaseTurns<Scalar> turns(times.first(n), phase_rate());
    for (std::size_t first = 0; first < n; first += block) {
      alignas(64) Scalar c[block], s[block], p[block], q[block], r[block], d1[block], d2[block], d3[block];
      turns.write(first, c, s);
      for (std::size_t k = 0; k < block; ++k) {
        const Shape here = shape(c[k], s[k], 1 - c[k]);
        p[k] = here.p, q[k] = here.q, r[k] = here.r;
        d1[k] = here.d1, d2[k] = here.d2, d3[k] = here.d3;
      }
      for (std::size_t k = 0; k < block && first + k < n; ++k) {
        State<Scalar>& to = states[first + k];
        set(to, {p[k], q[k], r[k], d1[k], d2[k], d3[k]});
        if (turning) to.attitude = attitude(times[first + k], {c[k], s[k]}, to.down);
      }
    }
  }

 private:
  /// The same where the terms are known, else infinite.
  Scalar known(Scalar error) const noexcept { return error_.rates < infinity<Scalar> ? error : infinity<Scalar>; }

  /// Rates over r0, down but for its length.
  struct Shape {
    Scalar p, q, r, d1, d2, d3;
  };

  /// Of cos u, sin u and 1 - cos u.
  Shape shape(Scalar c, Scalar s, Scalar v) const noexcept {
    const Scalar x = s_.load[0], y = s_.load[1], k = s_.gradient, C1 = s_.C1, M3 = s_.M3, G0 = s_.G0;
    const Scalar s2 = 2 * s * c, v2 = 2 * s * s;                           // sin 2u, 1 - cos 2u
    const Scalar lift = f_.X * v + f_.Y * s - M3 * C1 * f_.lift * v2 / 2;  // of g3, over M3
    const Scalar swing = f_.X * s - f_.Y * v;
    const Scalar shift = M3 * (M3 * (x * s - y * v) + k * C1 * M3 * M3 * s2 / 8) -
                         G0 * (swing + M3 * (f_.chi + f_.kap) * s2 / 4);  // of phi, times M3
    const Scalar radius = M3 - G0 * lift;
    return {f_.X + f_.chi * M3 * c, f_.Y + f_.kap * M3 * s,  1 - M3 * (x * v + y * s + k * C1 * M3 * v2 / 4),
            radius * c - shift * s, -radius * s - shift * c, G0 + M3 * lift};
  }

  void set(State<Scalar>& to, const Shape& is) const noexcept {
    const Scalar over = 1 / std::sqrt(is.d1 * is.d1 + is.d2 * is.d2 + is.d3 * is.d3);
    to.angular_velocity = {s_.spin * is.p, s_.spin * is.q, s_.spin * is.r};
    to.down = {over * is.d1, over * is.d2, over * is.d3};
  }

  Quat<Scalar> attitude(Scalar t, math::Complex<Scalar> turn, const Vec3<Scalar>& down) const noexcept {
    const Scalar swing = f_.X * turn.im - f_.Y * (1 - turn.re);
    const Scalar psi = precession_rate() * t + (f_.chi + f_.kap) * turn.im * turn.re / 2 + swing / s_.M3;
    return attitude_from_angles(psi, spin_angle(down, phase_rate() * t, turn), down);
  }

  Scaled<Scalar> s_;
  FirstOrder<Scalar> f_;
  ForcedError<Scalar> error_;
};

}  // namespace gyrostat::heavy
