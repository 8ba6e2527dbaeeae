// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/grid_columns.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/linear_functions.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

/// The linear motion on an even grid by its propagator: the exact linear map from the state at the start of a block (64 entries,
/// fewer where they turn through more than 32 rad) to the states inside is tabulated once, without trigonometry or a divisor left to the grid (docs/spinning.md, section 4.3).
/// Good at and near every resonance, with unstable spin, zero spin and at small t: each value errs by some eps of itself or of
/// what its parts amount to inside a block. The starts of 64 blocks come from a second table of the same kind, and the start of each such
/// group from Linear in wider numbers, so nothing accumulates.
template <Real Scalar>
class BlockGrid {
 public:
  static constexpr std::size_t longest = 64;  ///< block, and group of blocks

  BlockGrid() = default;

  /// Times start + i step, i = 0, 1, ..., about `points` of them (which sets the size of a group). The tables take 1 to 5 us for
  /// each of 64 + sqrt(points)/8 offsets, the start of a group about as much.
  BlockGrid(const Problem<Scalar>& problem, Scalar start, Scalar step, std::size_t points) noexcept
      : wide_(detail::problem_cast<Wide>(problem)), begin_(start), step_(step) {
    const auto w = detail::problem_cast<Wide>(problem);
    const LinearFunctions<Wide> functions(w);
    const LinearStart<Wide> s(w);
    const LinearFunctions<Scalar> near_functions(problem);
    const LinearStart<Scalar> near(problem);
    const Wide r0 = w.spin();
    const Wide rate = std::abs(r0) + std::abs(w.kappa1(r0)) + std::abs(w.kappa2(r0));
    const auto up_to_longest = [](Wide n) noexcept {  // NaN: 1
      return n < Wide(longest) ? std::size_t(1) + static_cast<std::size_t>(n > 0 ? n : 0) : longest;
    };
    const Wide turn = rate * std::abs(Wide(step));
    block_ = std::max(std::size_t(8), up_to_longest(32 / turn));
    const std::size_t blocks = up_to_longest(std::min(std::sqrt(Wide(points)) / 8, 512 / (turn * Wide(block_))));
    group_ = blocks * block_;
    for (std::size_t j = 0; j < block_; ++j) {
      const Wide t = Wide(step) * Wide(j);
      if (rate * std::abs(t) <= 1) {  // no sum of the map cancels
        fine_.set(j, problem, near, near_functions, static_cast<Scalar>(t));
      } else {
        fine_.set(j, w, s, functions, t);
      }
    }
    for (std::size_t j = 0; j < blocks; ++j) coarse_.set(j, w, s, functions, Wide(step) * Wide(j * block_));
    kappa1_ = static_cast<Scalar>(w.kappa1(r0));
    kappa2_ = static_cast<Scalar>(w.kappa2(r0));
    pull_ = math::complex_cast<Scalar>(math::Complex<Wide>{0, -s.axial_acceleration});
    charge_ = problem.charge_momentum;
    r0_ = problem.spin();
    theta0_ = problem.angles.theta;
    pushed_ = problem.force[0] != 0 || problem.force[1] != 0;
  }

  /// Values first .. first + count - 1 of the grid.
  void write(std::size_t first, std::size_t count, const GridColumns<Scalar>& to) const noexcept {
    for (std::size_t i = 0; i < count; i += group_) {
      const std::size_t n = std::min(group_, count - i);
      group(first + i, n, to.from(i));
    }
  }

 private:
  using Wide = detail::Wide<Scalar>;
  using Complex = math::Complex<Scalar>;

  /// The map over offsets s_j from (1, Pi, Pi~, Gamma): with hd = e^(i theta) at the start, e_H the charge, c = -i f3/m,
  ///     p = p0 cosine - kappa1 q0 sine + forced_p,   q = q0 cosine + kappa2 p0 sine + forced_q,
  ///     I = Pi A1 + Pi~ B1,   Gamma = spin~ (Gamma0 + I + C1),   G = G0 + hd (torque - i e_H I),
  ///     v = v0 + hd (force1 + c (Pi A2 + Pi~ B2 + Gamma0 s)),   x = x0 + v0 s + hd (force2 + c (Pi A3 + Pi~ B3 + Gamma0 s^2/2)),
  /// and the axial components as sums over 1, p, q, psi, phi.
  struct Table {
    struct Row {
      alignas(64) Scalar value[longest];
    };
    struct Rows {
      Row re, im;
      template <Real R>
      void set(std::size_t j, math::Complex<R> a) noexcept {
        re.value[j] = static_cast<Scalar>(a.re);
        im.value[j] = static_cast<Scalar>(a.im);
      }
    };
    struct Axial {
      Row one, p, q, psi, phi;
    };

    Row s, half_s2, cosine, sine, forced_p, forced_q;
    Rows spin, A1, B1, C1, torque, A2, B2, force1, A3, B3, force2;
    Axial G3, v3, x3;

    template <Real R>
    void set(std::size_t j, const Problem<R>& w, const LinearStart<R>& start, const LinearFunctions<R>& functions,
             R t) noexcept {
      using W = math::Complex<R>;
      using math::conjugate, math::turned;
      const auto put = [j](Row& row, R value) noexcept { row.value[j] = static_cast<Scalar>(value); };
      const LinearValues<R> f = functions.at(t, true);
      const R kappa1 = w.kappa1(w.spin()), kappa2 = w.kappa2(w.spin()), nu2 = kappa1 * kappa2;
      const R mean = (kappa1 + kappa2) / 2, split = (kappa2 - kappa1) / 2;
      const W mu{w.torque[0] / w.inertia[0], w.torque[1] / w.inertia[1]};
      const W push = turned(mean * mu + split * conjugate(mu));
      const W pull{0, -start.axial_acceleration};
      put(s, t);
      put(half_s2, t * t / 2);
      put(cosine, 1 - nu2 * f.V);
      put(sine, f.S);
      put(forced_p, mu.re * f.S + push.re * f.V);
      put(forced_q, mu.im * f.S + push.im * f.V);
      W A[4], B[4], C[4];
      for (int k = 1; k <= 3; ++k) {
        A[k] = f.E[k] + turned(mean * f.J[k]) - nu2 * f.K[k];
        B[k] = turned(split * f.J[k]);
        C[k] = mu * f.J[k] + push * f.K[k];
      }
      spin.set(j, f.spin);
      A1.set(j, A[1]);
      B1.set(j, B[1]);
      C1.set(j, C[1]);
      torque.set(j, start.torque * f.E[1] - start.charge_momentum * turned(C[1]));
      A2.set(j, A[2]);
      B2.set(j, B[2]);
      force1.set(j, start.acceleration * f.E[1] + pull * C[2]);
      A3.set(j, A[3]);
      B3.set(j, B[3]);
      force2.set(j, start.acceleration * f.E[2] + pull * C[3]);
      // int Gamma (k = 1) and its integral (k = 2) for Pi, Pi~, 1 and Gamma0
      const auto axial = [&](Axial& rows, W a, int k, R rest) noexcept {
        const auto along = [&a](W b) noexcept { return a.im * b.re - a.re * b.im; };
        const W rate = conjugate(f.E[k + 1]) + turned(mean * f.H[k]) - nu2 * f.H[k + 1];
        const W mirrored = turned(split * f.H[k]), tilt = conjugate(f.E[k]);
        put(rows.one, rest + along(mu * f.H[k] + push * f.H[k + 1]));
        put(rows.p, along(rate + mirrored));
        put(rows.q, along(turned(rate - mirrored)));
        put(rows.psi, along(tilt));
        put(rows.phi, along(turned(tilt)));
      };
      axial(G3, start.torque, 1, R(0));
      axial(v3, start.acceleration, 1, start.axial_acceleration * t);
      axial(x3, start.acceleration, 2, start.axial_acceleration * t * t / 2);
    }
  };

  /// The state at the start of a block.
  struct Start {
    Scalar p, q, psi, phi, theta, G1, G2, G3, v1, v2, v3, x1, x2, x3, cos_theta, sin_theta;
  };

  /// Up to 64 blocks that start at entry `first`.
  void group(std::size_t first, std::size_t count, const GridColumns<Scalar>& to) const noexcept {
    const Wide t = Wide(begin_) + Wide(first) * Wide(step_);
    const State<Wide> state = wide_.at(t);
    const auto narrow = [](Wide a) noexcept { return static_cast<Scalar>(a); };
    const auto &w = state.angular_velocity, &G = state.momentum_I, &v = state.velocity, &x = state.position;
    const auto& a = state.angles;
    const Start start{narrow(w[0]),
                      narrow(w[1]),
                      narrow(a.psi),
                      narrow(a.phi),
                      narrow(a.theta),
                      narrow(G[0]),
                      narrow(G[1]),
                      narrow(G[2]),
                      narrow(v[0]),
                      narrow(v[1]),
                      narrow(v[2]),
                      narrow(x[0]),
                      narrow(x[1]),
                      narrow(x[2]),
                      narrow(std::cos(a.theta)),
                      narrow(std::sin(a.theta))};
    if (count <= block_) {
      fill(fine_, start, first, 1, count, to);
      return;
    }
    alignas(64) Scalar at[14][longest];
    const GridColumns<Scalar> starts{at[0], at[1], at[2], at[3],  at[4],  at[5],  at[6],
                                     at[7], at[8], at[9], at[10], at[11], at[12], at[13]};
    const std::size_t blocks = (count + block_ - 1) / block_;
    fill(coarse_, start, first, block_, blocks, starts);
    for (std::size_t b = 0; b < blocks; ++b) {
      const Scalar c = coarse_.spin.re.value[b], s = coarse_.spin.im.value[b];
      const Start now{starts.p[b],
                      starts.q[b],
                      starts.psi[b],
                      starts.phi[b],
                      starts.theta[b],
                      starts.G1[b],
                      starts.G2[b],
                      starts.G3[b],
                      starts.v1[b],
                      starts.v2[b],
                      starts.v3[b],
                      starts.x1[b],
                      starts.x2[b],
                      starts.x3[b],
                      start.cos_theta * c - start.sin_theta * s,
                      start.sin_theta * c + start.cos_theta * s};
      fill(fine_, now, first + b * block_, 1, std::min(block_, count - b * block_), to.from(b * block_));
    }
  }

  void fill(const Table& table, const Start& start, std::size_t first, std::size_t stride, std::size_t n,
            const GridColumns<Scalar>& to) const noexcept {
    turning(table, start, first, stride, n, to);
    if (pushed_) {
      moving<true>(table, start, n, to);
    } else {
      moving<false>(table, start, n, to);
    }
    if (to.G3 != nullptr) axial_momentum(table, start, n, to);
  }

  void turning(const Table& table, const Start& y, std::size_t first, std::size_t stride, std::size_t n,
               const GridColumns<Scalar>& to) const noexcept {
    Scalar* __restrict p = to.p, * __restrict q = to.q, * __restrict psi = to.psi, * __restrict phi = to.phi, * __restrict theta = to.theta, * __restrict G1 = to.G1, * __restrict G2 = to.G2;
    const Scalar p0 = y.p, q0 = y.q, p_turned = -kappa1_ * y.q, q_turned = kappa2_ * y.p, psi0 = y.psi, phi0 = y.phi;
    const Scalar C = y.cos_theta, S = y.sin_theta, Gx = y.G1, Gy = y.G2;
    const Scalar e_C = charge_ * C, e_S = charge_ * S;
    const Scalar r0 = r0_, theta0 = theta0_, begin = begin_, step = step_;
    const Scalar index = static_cast<Scalar>(first), hop = static_cast<Scalar>(stride);
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j) {
      const Scalar cosine = table.cosine.value[j], sine = table.sine.value[j];
      p[j] = table.forced_p.value[j] + p0 * cosine + p_turned * sine;
      q[j] = table.forced_q.value[j] + q0 * cosine + q_turned * sine;
      const Scalar a = table.A1.re.value[j], b = table.A1.im.value[j], c = table.B1.re.value[j],
                   d = table.B1.im.value[j];
      const Scalar I_re = p0 * a - q0 * b + p0 * c + q0 * d, I_im = p0 * b + q0 * a + p0 * d - q0 * c;
      const Scalar w_re = psi0 + table.C1.re.value[j] + I_re, w_im = phi0 + table.C1.im.value[j] + I_im;
      const Scalar turn_re = table.spin.re.value[j], turn_im = table.spin.im.value[j];
      psi[j] = turn_re * w_re + turn_im * w_im;
      phi[j] = turn_re * w_im - turn_im * w_re;
      const Scalar M_re = table.torque.re.value[j], M_im = table.torque.im.value[j];
      G1[j] = Gx + C * M_re - S * M_im + e_C * I_im + e_S * I_re;
      G2[j] = Gy + S * M_re + C * M_im + e_S * I_im - e_C * I_re;
      theta[j] = theta0 + r0 * (begin + (index + hop * static_cast<Scalar>(static_cast<int>(j))) * step);
    }
  }

  template <bool pushed>
  void moving(const Table& table, const Start& y, std::size_t n, const GridColumns<Scalar>& to) const noexcept {
    Scalar* __restrict v1 = to.v1, * __restrict v2 = to.v2, * __restrict v3 = to.v3, * __restrict x1 = to.x1, * __restrict x2 = to.x2, * __restrict x3 = to.x3;
    const Complex heading{y.cos_theta, y.sin_theta}, pull = heading * pull_;
    const Complex a = pull * Complex{y.p, y.q}, b = pull * Complex{y.p, -y.q}, g = pull * Complex{y.psi, y.phi};
    const Scalar C = heading.re, S = heading.im;
    const Scalar v1_0 = y.v1, v2_0 = y.v2, v3_0 = y.v3, x1_0 = y.x1, x2_0 = y.x2, x3_0 = y.x3;
    const Scalar p0 = y.p, q0 = y.q, psi0 = y.psi, phi0 = y.phi;
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j) {
      const Scalar s = table.s.value[j];
      {
        const Scalar f_re = table.force1.re.value[j], f_im = table.force1.im.value[j];
        const Scalar A_re = table.A2.re.value[j], A_im = table.A2.im.value[j];
        const Scalar B_re = table.B2.re.value[j], B_im = table.B2.im.value[j];
        v1[j] = v1_0 + g.re * s + C * f_re - S * f_im + a.re * A_re - a.im * A_im + b.re * B_re - b.im * B_im;
        v2[j] = v2_0 + g.im * s + S * f_re + C * f_im + a.im * A_re + a.re * A_im + b.im * B_re + b.re * B_im;
      }
      {
        const Scalar s2 = table.half_s2.value[j];
        const Scalar f_re = table.force2.re.value[j], f_im = table.force2.im.value[j];
        const Scalar A_re = table.A3.re.value[j], A_im = table.A3.im.value[j];
        const Scalar B_re = table.B3.re.value[j], B_im = table.B3.im.value[j];
        x1[j] =
            x1_0 + v1_0 * s + g.re * s2 + C * f_re - S * f_im + a.re * A_re - a.im * A_im + b.re * B_re - b.im * B_im;
        x2[j] =
            x2_0 + v2_0 * s + g.im * s2 + S * f_re + C * f_im + a.im * A_re + a.re * A_im + b.im * B_re + b.re * B_im;
      }
      if constexpr (!pushed) {
        v3[j] = v3_0 + table.v3.one.value[j];
        x3[j] = x3_0 + v3_0 * s + table.x3.one.value[j];
      }
    }
    if constexpr (pushed) {
      GYROSTAT_INDEPENDENT
      for (std::size_t j = 0; j < n; ++j) {
        v3[j] = v3_0 + axial(table.v3, j, p0, q0, psi0, phi0);
        x3[j] = x3_0 + v3_0 * table.s.value[j] + axial(table.x3, j, p0, q0, psi0, phi0);
      }
    }
  }

  static Scalar axial(const typename Table::Axial& rows, std::size_t j, Scalar p, Scalar q, Scalar psi,
                      Scalar phi) noexcept {
    return rows.one.value[j] + p * rows.p.value[j] + q * rows.q.value[j] + psi * rows.psi.value[j] +
           phi * rows.phi.value[j];
  }

  void axial_momentum(const Table& table, const Start& y, std::size_t n, const GridColumns<Scalar>& to) const noexcept {
    Scalar* __restrict G3 = to.G3;
    const Scalar* __restrict psi = to.psi, * __restrict phi = to.phi;
    const Scalar p0 = y.p, q0 = y.q, psi0 = y.psi, phi0 = y.phi, e = charge_ / 2;
    const Scalar G0 = y.G3 + e * (psi0 * psi0 + phi0 * phi0);
    GYROSTAT_INDEPENDENT
    for (std::size_t j = 0; j < n; ++j)
      G3[j] = G0 + axial(table.G3, j, p0, q0, psi0, phi0) - e * (psi[j] * psi[j] + phi[j] * phi[j]);
  }

  Table fine_, coarse_;
  Linear<Wide> wide_{Problem<Wide>{}};
  Scalar begin_ = 0, step_ = 0, r0_ = 0, theta0_ = 0, charge_ = 0, kappa1_ = 0, kappa2_ = 0;
  Complex pull_;  ///< -i f3/m
  std::size_t block_ = longest;
  std::size_t group_ = longest;  ///< entries from one start by the closed form
  bool pushed_ = false;          ///< a transverse force acts
};

}  // namespace gyrostat::spinning
