// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/grid_columns.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"

GYROSTAT_QUIET_LOOPS
namespace gyrostat::spinning {

/// The linear motion on an even grid as a sum of its modes, with cos and sin of theta and nu t by a rotation of two levels:
/// (start of a block) x (table of offsets), one multiplication and never a chain of them (docs/spinning.md, section 4.3). The
/// fastest, where it may be used: nu^2 > 0 and no divisor is small. Each value errs by some eps of the amplitudes of the modes,
/// which exceed the value where t or a divisor times t is small.
template <Real Scalar>
class ModeGrid {
 public:
  static constexpr std::size_t block = 256;

  ModeGrid() = default;

  /// Times start + i step, i = 0, 1, ...
  ModeGrid(const Problem<Scalar>& problem, Scalar start, Scalar step) noexcept : begin_(start), step_(step) {
    using Wide = detail::Wide<Scalar>;
    using Complex = math::Complex<Wide>;
    const auto w = detail::problem_cast<Wide>(problem);
    const LinearStart<Wide> s(w);
    const Wide r = w.spin(), nu2 = w.nutation_squared(), nu = std::sqrt(nu2), X = w.effective_momentum();
    const RateModes<Wide> rates(s, nu2);
    // r0 + nu and r0 - nu, the smaller from (r0 + nu)(r0 - nu) = X (r0 (D1 + D2) - X)/(D1 D2)
    const Wide product = X / w.inertia[0] * ((r * (w.inertia[0] + w.inertia[1]) - X) / w.inertia[1]);
    const Wide plus = r > 0 ? r + nu : product / (r - nu), minus = r > 0 ? product / (r + nu) : r - nu;
    const Modes<Wide> tilt{over(rates.constant, r), over(rates.up, plus), over(rates.down, minus)};
    const Complex still = s.Gamma - tilt.constant - tilt.up - tilt.down;  // of e^(-i r0 t)
    const Complex pull{0, -s.axial_acceleration};
    const Modes<Wide> v{over(s.acceleration + pull * tilt.constant, r), over(pull * tilt.up, plus),
                        over(pull * tilt.down, minus)};
    const Modes<Wide> x{over(v.constant, r), over(v.up, plus), over(v.down, minus)};
    const Complex drift = s.heading * (pull * still);
    const Complex v_rest = Complex{w.velocity[0], w.velocity[1]} - s.heading * v.sum();
    const Complex x_rest = Complex{w.position[0], w.position[1]} - s.heading * x.sum();

    rates_ = Ellipse(Modes<Wide>{rates.constant, rates.up, rates.down});
    tilt_ = Ellipse(tilt);
    v_ = Ellipse(v);
    x_ = Ellipse(x);
    still_ = narrow(s.heading * still);
    v_rest_ = narrow(v_rest);
    drift_ = narrow(drift);
    half_drift_ = narrow(drift / Wide(2));
    x_rest_ = narrow(x_rest);
    const auto circle = momentum_circle(w);
    centre_ = narrow(circle.centre);
    push_ = narrow(over(s.torque, r));
    charge_ = problem.charge_momentum;
    spin_ = detail::FineRate<Scalar>(r * Wide(step));
    nutation_ = detail::FineRate<Scalar>(nu * Wide(step));
    heading_ = narrow(s.heading * math::unit(r * Wide(start)));
    ahead_ = narrow(math::unit(nu * Wide(start)));
    r0_ = problem.spin();
    theta0_ = problem.angles.theta;

    set_axial(w, s, nu, tilt, still);
    pushed_ = problem.force[0] != 0 || problem.force[1] != 0;
    fill_table();
  }

  /// Values first .. first + count - 1 of the grid.
  void write(std::size_t first, std::size_t count, const GridColumns<Scalar>& to) const noexcept {
    for (std::size_t i = 0; i < count; i += block) {
      const std::size_t n = std::min(block, count - i);
      Rotation now;
      turn(first + i, n, now);
      turning(now, n, to.from(i));
      if (pushed_) {
        moving<true>(now, n, to.from(i));
      } else {
        moving<false>(now, n, to.from(i));
      }
      if (to.G3 != nullptr) axial_momentum(now, n, to.from(i));
    }
  }

 private:
  template <Real S>
  struct Modes {
    math::Complex<S> constant, up, down;
    math::Complex<S> sum() const noexcept { return constant + up + down; }
  };

  template <Real S>
  static math::Complex<Scalar> narrow(math::Complex<S> a) noexcept {
    return math::complex_cast<Scalar>(a);
  }

  /// a/(i rate).
  template <Real S>
  static math::Complex<S> over(math::Complex<S> a, S rate) noexcept {
    return -math::turned(a) / rate;
  }

  /// constant + up e^(i nu t) + down e^(-i nu t) over 1, cos, sin.
  struct Ellipse {
    Scalar re = 0, re_c = 0, re_s = 0, im = 0, im_c = 0, im_s = 0;

    Ellipse() = default;
    template <Real S>
    explicit Ellipse(const Modes<S>& m) noexcept
        : re(static_cast<Scalar>(m.constant.re)),
          re_c(static_cast<Scalar>(m.up.re + m.down.re)),
          re_s(static_cast<Scalar>(m.down.im - m.up.im)),
          im(static_cast<Scalar>(m.constant.im)),
          im_c(static_cast<Scalar>(m.up.im + m.down.im)),
          im_s(static_cast<Scalar>(m.up.re - m.down.re)) {}
  };

  /// Re(i a~ (constant e^(-i r0 t) + up e^(i nu t) + down e^(-i nu t))) and a polynomial of t, over cos and sin of theta and
  /// nu t.
  struct Axial {
    Scalar one = 0, t = 0, t2 = 0, c = 0, s = 0, C = 0, S = 0;

    Axial() = default;
    template <Real W>
    Axial(math::Complex<W> a, math::Complex<W> heading, const Modes<W>& m, W one_, W t_, W t2_) noexcept
        : one(static_cast<Scalar>(one_)), t(static_cast<Scalar>(t_)), t2(static_cast<Scalar>(t2_)) {
      const auto i_a = math::turned(math::conjugate(a));
      const auto up = i_a * m.up, down = i_a * m.down, back = i_a * (heading * m.constant);
      c = static_cast<Scalar>(up.re + down.re);
      s = static_cast<Scalar>(down.im - up.im);
      C = static_cast<Scalar>(back.re);
      S = static_cast<Scalar>(back.im);
    }
  };

  /// v3, x3 and G3: Re(i a~ int Gamma) and its integral, a = f/m or M.
  template <Real Wide>
  void set_axial(const Problem<Wide>& w, const LinearStart<Wide>& s, Wide nu, const Modes<Wide>& tilt,
                 math::Complex<Wide> still) noexcept {
    using Complex = math::Complex<Wide>;
    const auto along = [](Complex a, Complex b) noexcept { return a.im * b.re - a.re * b.im; };
    const Modes<Wide> B1{over(still, -w.spin()), over(tilt.up, nu), over(tilt.down, -nu)};
    const Modes<Wide> B2{over(B1.constant, -w.spin()), over(B1.up, nu), over(B1.down, -nu)};
    const Wide forward = s.axial_acceleration + along(s.acceleration, tilt.constant);
    const Wide v3 = w.velocity[2] - along(s.acceleration, B1.sum());
    v3_ = Axial(s.acceleration, s.heading, B1, v3, forward, Wide(0));
    x3_ = Axial(s.acceleration, s.heading, B2, w.position[2] - along(s.acceleration, B2.sum()), v3, forward / 2);
    const Wide tilted = s.Gamma.re * s.Gamma.re + s.Gamma.im * s.Gamma.im;
    G3_ = Axial(s.torque, s.heading, B1, s.axial_momentum - along(s.torque, B1.sum()) + s.charge_momentum * tilted / 2,
                along(s.torque, tilt.constant), Wide(0));
  }

  /// 16 x 16 rotations.
  void fill_table() noexcept {
    math::Complex<Scalar> spin[32], nutation[32];
    for (int i = 0; i < 32; ++i) {
      const Scalar steps = Scalar(i < 16 ? i : 16 * (i - 16));
      spin[i] = spin_.turn(steps);
      nutation[i] = nutation_.turn(steps);
    }
    for (std::size_t j = 0; j < block; ++j) {
      const auto c = spin[16 + j / 16] * spin[j % 16], n = nutation[16 + j / 16] * nutation[j % 16];
      table_.C[j] = c.re;
      table_.S[j] = c.im;
      table_.c[j] = n.re;
      table_.s[j] = n.im;
    }
  }

  struct Rotation {
    alignas(64) Scalar c[block], s[block], C[block], S[block], t[block];
  };

  void turn(std::size_t first, std::size_t n, Rotation& now) const noexcept {
    const Scalar index = static_cast<Scalar>(first);
    const auto nutation = ahead_ * nutation_.turn(index), spin = heading_ * spin_.turn(index);
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j) {
      now.c[j] = nutation.re * table_.c[j] - nutation.im * table_.s[j];
      now.s[j] = nutation.im * table_.c[j] + nutation.re * table_.s[j];
      now.C[j] = spin.re * table_.C[j] - spin.im * table_.S[j];
      now.S[j] = spin.im * table_.C[j] + spin.re * table_.S[j];
      now.t[j] = begin_ + (index + static_cast<Scalar>(static_cast<int>(j))) * step_;
    }
  }

  /// p, q, psi, phi, theta and G = centre + e^(i theta) (-i M/r0 - i e_H Gamma).
  void turning(const Rotation& now, std::size_t n, const GridColumns<Scalar>& to) const noexcept {
    Scalar* __restrict p = to.p, * __restrict q = to.q, * __restrict psi = to.psi, * __restrict phi = to.phi, * __restrict theta = to.theta, * __restrict G1 = to.G1, * __restrict G2 = to.G2;
    const Ellipse a = rates_, g = tilt_;
    const auto still = still_, centre = centre_, push = push_;
    const Scalar r0 = r0_, theta0 = theta0_, e = charge_;
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j) {
      const Scalar c = now.c[j], s = now.s[j], C = now.C[j], S = now.S[j];
      p[j] = a.re + a.re_c * c + a.re_s * s;
      q[j] = a.im + a.im_c * c + a.im_s * s;
      const Scalar tilt1 = g.re + g.re_c * c + g.re_s * s + still.re * C + still.im * S;
      const Scalar tilt2 = g.im + g.im_c * c + g.im_s * s + still.im * C - still.re * S;
      psi[j] = tilt1;
      phi[j] = tilt2;
      theta[j] = theta0 + r0 * now.t[j];
      const Scalar re = push.re + e * tilt2, im = push.im - e * tilt1;
      G1[j] = centre.re + C * re - S * im;
      G2[j] = centre.im + S * re + C * im;
    }
  }

  template <bool pushed>
  void moving(const Rotation& now, std::size_t n, const GridColumns<Scalar>& to) const noexcept {
    Scalar* __restrict v1 = to.v1, * __restrict v2 = to.v2, * __restrict v3 = to.v3, * __restrict x1 = to.x1, * __restrict x2 = to.x2, * __restrict x3 = to.x3;
    const Ellipse v = v_, x = x_;
    const Axial a = v3_, b = x3_;
    const auto v0 = v_rest_, drift = drift_, half = half_drift_, x0 = x_rest_;
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j) {
      const Scalar c = now.c[j], s = now.s[j], C = now.C[j], S = now.S[j], t = now.t[j];
      const Scalar v_re = v.re + v.re_c * c + v.re_s * s, v_im = v.im + v.im_c * c + v.im_s * s;
      v1[j] = v0.re + drift.re * t + C * v_re - S * v_im;
      v2[j] = v0.im + drift.im * t + S * v_re + C * v_im;
      const Scalar x_re = x.re + x.re_c * c + x.re_s * s, x_im = x.im + x.im_c * c + x.im_s * s;
      x1[j] = x0.re + t * (v0.re + half.re * t) + C * x_re - S * x_im;
      x2[j] = x0.im + t * (v0.im + half.im * t) + S * x_re + C * x_im;
      Scalar v_axial = a.one + a.t * t, x_axial = b.one + t * (b.t + b.t2 * t);
      if constexpr (pushed) {
        v_axial += a.c * c + a.s * s + a.C * C + a.S * S;
        x_axial += b.c * c + b.s * s + b.C * C + b.S * S;
      }
      v3[j] = v_axial;
      x3[j] = x_axial;
    }
  }

  void axial_momentum(const Rotation& now, std::size_t n, const GridColumns<Scalar>& to) const noexcept {
    Scalar* __restrict G3 = to.G3;
    const Scalar* __restrict psi = to.psi, * __restrict phi = to.phi;
    const Axial G = G3_;
    const Scalar e = charge_ / 2;
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j) {
      const Scalar modes = G.c * now.c[j] + G.s * now.s[j] + G.C * now.C[j] + G.S * now.S[j];
      G3[j] = G.one + G.t * now.t[j] + modes - e * (psi[j] * psi[j] + phi[j] * phi[j]);
    }
  }

  struct Table {
    alignas(64) Scalar c[block], s[block], C[block], S[block];
  };

  Table table_;
  Scalar begin_ = 0, step_ = 0, r0_ = 0, theta0_ = 0, charge_ = 0;
  detail::FineRate<Scalar> spin_, nutation_;  ///< rad a step
  math::Complex<Scalar> heading_, ahead_, still_, centre_, push_, v_rest_, drift_, half_drift_, x_rest_;
  Ellipse rates_, tilt_, v_, x_;
  Axial v3_, x3_, G3_;
  bool pushed_ = false;  ///< a transverse force acts
};

#ifdef GYROSTAT_COMPILED
extern template class ModeGrid<double>;
#endif

}  // namespace gyrostat::spinning
GYROSTAT_QUIET_LOOPS_END
