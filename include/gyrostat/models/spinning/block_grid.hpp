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

GYROSTAT_QUIET_LOOPS
namespace gyrostat::spinning {

namespace detail {

/// The exact linear map of the linear motion over a time, from (1, Pi, Pi~, Gamma) at its start; two in a row are one, at a tenth of the
/// cost of the functions it is made of.
template <Real Scalar>
class Propagator {
  using Complex = math::Complex<Scalar>;

 public:
  /// Coefficients of Pi, Pi~ and 1.
  struct Form {
    Complex a, b, one;
    friend Form operator+(const Form& x, const Form& y) noexcept { return {x.a + y.a, x.b + y.b, x.one + y.one}; }
    friend Form operator*(Complex c, const Form& x) noexcept { return {c * x.a, c * x.b, c * x.one}; }
    friend Form operator*(Scalar c, const Form& x) noexcept { return {c * x.a, c * x.b, c * x.one}; }
  };

  /// What all times share.
  struct Constants {
    Scalar kappa1, kappa2, nu2, mean, split;
    Complex mu, push;

    explicit Constants(const Problem<Scalar>& w) noexcept
        : kappa1(w.kappa1(w.spin())),
          kappa2(w.kappa2(w.spin())),
          nu2(kappa1 * kappa2),
          mean((kappa1 + kappa2) / 2),
          split((kappa2 - kappa1) / 2),
          mu{w.torque[0] / w.inertia[0], w.torque[1] / w.inertia[1]},
          push{-kappa1 * mu.im, kappa2 * mu.re} {}
  };

  Scalar time = 0;
  Scalar S = 0, V = 0;         ///< of linear_functions.hpp, as E1 and E2
  Complex spin{1, 0}, E1, E2;  ///< e^(i r0 s)
  Form turned[3];              ///< int e^(i r0 s) Pi, its integral, and the integral of that
  Form tilted[2];              ///< int Gamma and its integral, but for conj(E1) Gamma and conj(E2) Gamma

  Propagator() = default;

  Propagator(const Constants& c, const LinearFunctions<Scalar>& functions, Scalar t) noexcept : time(t) {
    const LinearValues<Scalar> f = functions.at(t, true);
    S = f.S;
    V = f.V;
    spin = f.spin;
    E1 = f.E[1];
    E2 = f.E[2];
    const auto form = [&c](Complex first, Complex second, Complex third) noexcept {
      return Form{first + math::turned(c.mean * second) - c.nu2 * third, math::turned(c.split * second),
                  c.mu * second + c.push * third};
    };
    for (int k = 1; k <= 3; ++k) turned[k - 1] = form(f.E[k], f.J[k], f.K[k]);
    for (int k = 1; k <= 2; ++k) tilted[k - 1] = form(math::conjugate(f.E[k + 1]), f.H[k], f.H[k + 1]);
  }

  /// Pi after the time.
  Form rates(const Constants& c) const noexcept {
    return {{1 - c.nu2 * V, c.mean * S}, {0, c.split * S}, S * c.mu + V * c.push};
  }

  /// This time, and then another.
  Propagator then(const Propagator& next, const Constants& c) const noexcept {
    const Form now = rates(c);
    const auto after = [&now](const Form& f) noexcept {
      return Form{f.a * now.a + f.b * math::conjugate(now.b), f.a * now.b + f.b * math::conjugate(now.a),
                  f.a * now.one + f.b * math::conjugate(now.one) + f.one};
    };
    const Complex back = math::conjugate(spin);
    const Scalar s = next.time, half_s2 = s * s / 2;
    Propagator both;
    both.time = time + s;
    both.S = S * (1 - c.nu2 * next.V) + (1 - c.nu2 * V) * next.S;
    both.V = V + S * next.S + (1 - c.nu2 * V) * next.V;
    both.spin = spin * next.spin;
    both.E1 = E1 + spin * next.E1;
    both.E2 = E2 + s * E1 + spin * next.E2;
    both.turned[0] = turned[0] + spin * after(next.turned[0]);
    both.turned[1] = turned[1] + s * turned[0] + spin * after(next.turned[1]);
    both.turned[2] = turned[2] + s * turned[1] + half_s2 * turned[0] + spin * after(next.turned[2]);
    both.tilted[0] = tilted[0] + after(next.tilted[0]) + (math::conjugate(next.E1) * back) * turned[0];
    both.tilted[1] = tilted[1] + s * tilted[0] + after(next.tilted[1]) + (math::conjugate(next.E2) * back) * turned[0];
    return both;
  }
};

}  // namespace detail

/// The linear motion on an even grid by its propagator: the exact linear map from the state at the start of a block (64 entries,
/// fewer where they turn through more than 32 rad) to the states inside is tabulated once, without trigonometry or a divisor left to the grid (docs/spinning.md, section 4.3).
/// Good at and near every resonance, with unstable spin, zero spin and at small t: each value errs by some eps of itself or of
/// what its parts amount to inside a block. The starts of 64 blocks come from a second table of the same kind, and the start of each such
/// group from Linear in wider numbers and at most three leaps in them, so nothing accumulates.
template <Real Scalar>
class BlockGrid {
 public:
  static constexpr std::size_t longest = 64;  ///< block, and group of blocks

  BlockGrid() = default;

  /// Times start + i step, i = 0, 1, ..., about `points` of them (which sets the size of a group). The tables take some 0.2 us for
  /// each of 64 + sqrt(points)/8 offsets, the start of a group 0.5 us.
  BlockGrid(const Problem<Scalar>& problem, Scalar start, Scalar step, std::size_t points) noexcept
      : wide_(detail::problem_cast<Wide>(problem)), begin_(start), step_(step) {
    const auto w = detail::problem_cast<Wide>(problem);
    const LinearFunctions<Wide> functions(w);
    const LinearStart<Wide> s(w);
    const typename Map::Constants constants(w);
    const Wide r0 = w.spin();
    const Wide rate = std::abs(r0) + std::abs(w.kappa1(r0)) + std::abs(w.kappa2(r0));
    const auto up_to_longest = [](Wide n) noexcept {  // NaN: 1
      return n < Wide(longest) ? std::size_t(1) + static_cast<std::size_t>(n > 0 ? n : 0) : longest;
    };
    const Wide turn = rate * std::abs(Wide(step));
    block_ = std::max(std::size_t(8), up_to_longest(32 / turn));
    const std::size_t blocks = up_to_longest(std::min(std::sqrt(Wide(points)) / 8, 512 / (turn * Wide(block_))));
    group_ = blocks * block_;
    fine_.set(block_, s, constants, Map(constants, functions, Wide(step)));
    coarse_.set(blocks, s, constants, Map(constants, functions, Wide(step) * Wide(block_)));
    leap_ = Map(constants, functions, Wide(step) * Wide(group_));
    constants_ = constants;
    loads_ = s;
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
    Standing now;
    for (std::size_t i = 0, k = 0; i < count; i += group_, ++k) {
      if (k % leaps == 0) {
        now = standing(Wide(begin_) + Wide(first + i) * Wide(step_));
      } else {
        advance(now);
      }
      group(now, first + i, std::min(group_, count - i), to.from(i));
    }
  }

 private:
  using Wide = detail::Wide<Scalar>;
  using Complex = math::Complex<Scalar>;
  using Map = detail::Propagator<Wide>;

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
      void set(std::size_t j, math::Complex<Wide> a) noexcept {
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

    /// Offsets 0 .. n - 1 of the time of `one`, each a multiple of 8 and a rest in a row, so that errors do not add up.
    void set(std::size_t n, const LinearStart<Wide>& start, const typename Map::Constants& c, const Map& one) noexcept {
      Map rest[8], eights;
      for (std::size_t j = 1; j < 8; ++j) rest[j] = j == 1 ? one : rest[j - 1].then(one, c);
      const Map eight = rest[7].then(one, c);
      for (std::size_t j = 0; j < n; ++j) {
        if (j % 8 == 0 && j > 0) eights = j == 8 ? eight : eights.then(eight, c);
        put(j, start, c, j < 8 ? rest[j] : j % 8 == 0 ? eights : eights.then(rest[j % 8], c));
      }
    }

   private:
    void put(std::size_t j, const LinearStart<Wide>& start, const typename Map::Constants& c, const Map& map) noexcept {
      using W = math::Complex<Wide>;
      using math::conjugate, math::turned;
      const auto in = [j](Row& row, Wide value) noexcept { row.value[j] = static_cast<Scalar>(value); };
      const auto [now_a, now_b, now_one] = map.rates(c);
      const W pull{0, -start.axial_acceleration};
      const Wide t = map.time;
      in(s, t);
      in(half_s2, t * t / 2);
      in(cosine, now_a.re);
      in(sine, map.S);
      in(forced_p, now_one.re);
      in(forced_q, now_one.im);
      spin.set(j, map.spin);
      A1.set(j, map.turned[0].a);
      B1.set(j, map.turned[0].b);
      C1.set(j, map.turned[0].one);
      torque.set(j, start.torque * map.E1 - start.charge_momentum * turned(map.turned[0].one));
      A2.set(j, map.turned[1].a);
      B2.set(j, map.turned[1].b);
      force1.set(j, start.acceleration * map.E1 + pull * map.turned[1].one);
      A3.set(j, map.turned[2].a);
      B3.set(j, map.turned[2].b);
      force2.set(j, start.acceleration * map.E2 + pull * map.turned[2].one);
      // Re(i a~ int Gamma), or of its integral
      const auto axial = [&](Axial& rows, W a, const typename Map::Form& f, W tilt, Wide more) noexcept {
        const auto along = [&a](W b) noexcept { return a.im * b.re - a.re * b.im; };
        in(rows.one, more + along(f.one));
        in(rows.p, along(f.a + f.b));
        in(rows.q, along(turned(f.a - f.b)));
        in(rows.psi, along(tilt));
        in(rows.phi, along(turned(tilt)));
      };
      const W T1 = conjugate(map.E1), T2 = conjugate(map.E2);
      axial(G3, start.torque, map.tilted[0], T1, Wide(0));
      axial(v3, start.acceleration, map.tilted[0], T1, start.axial_acceleration * t);
      axial(x3, start.acceleration, map.tilted[1], T2, start.axial_acceleration * t * t / 2);
    }
  };

  /// The state at the start of a block.
  struct Start {
    Scalar p, q, psi, phi, G1, G2, G3, v1, v2, v3, x1, x2, x3, cos_theta, sin_theta;
  };

  /// The state at the start of a group.
  struct Standing {
    math::Complex<Wide> Pi, Gamma, heading, G, v, x;
    Wide G3 = 0, v3 = 0, x3 = 0;
  };
  /// Groups from one start by the closed form.
  static constexpr std::size_t leaps = 4;

  Standing standing(Wide t) const noexcept {
    const State<Wide> y = wide_.at(t);
    const auto &w = y.angular_velocity, &G = y.momentum_I, &v = y.velocity, &x = y.position;
    return {{w[0], w[1]},
            {y.angles.psi, y.angles.phi},
            math::unit(y.angles.theta),
            {G[0], G[1]},
            {v[0], v[1]},
            {x[0], x[1]},
            G[2],
            v[2],
            x[2]};
  }

  /// To the start of the next group.
  void advance(Standing& y) const noexcept {
    using W = math::Complex<Wide>;
    using math::conjugate, math::turned;
    const auto of = [&y](const typename Map::Form& f) noexcept { return f.a * y.Pi + f.b * conjugate(y.Pi) + f.one; };
    const auto along = [](W a, W b) noexcept { return a.im * b.re - a.re * b.im; };
    const auto squared = [](W a) noexcept { return a.re * a.re + a.im * a.im; };
    const Wide s = leap_.time, half_s2 = s * s / 2, f3 = loads_.axial_acceleration;
    const W pull{0, -f3}, I = of(leap_.turned[0]);
    const W B1 = of(leap_.tilted[0]) + conjugate(leap_.E1) * y.Gamma,
            B2 = of(leap_.tilted[1]) + conjugate(leap_.E2) * y.Gamma;
    y.x3 = y.x3 + s * y.v3 + half_s2 * f3 + along(loads_.acceleration, B2);
    y.v3 = y.v3 + s * f3 + along(loads_.acceleration, B1);
    y.x =
        y.x + s * y.v + y.heading * (loads_.acceleration * leap_.E2 + pull * (of(leap_.turned[2]) + half_s2 * y.Gamma));
    y.v = y.v + y.heading * (loads_.acceleration * leap_.E1 + pull * (of(leap_.turned[1]) + s * y.Gamma));
    y.G = y.G + y.heading * (loads_.torque * leap_.E1 - loads_.charge_momentum * turned(I));
    const W tilt = conjugate(leap_.spin) * (y.Gamma + I);
    y.G3 = y.G3 + along(loads_.torque, B1) - loads_.charge_momentum * (squared(tilt) - squared(y.Gamma)) / 2;
    y.Gamma = tilt;
    y.heading = y.heading * leap_.spin;
    // the rates feed on themselves from group to group: by the stiffnesses, either of which may be near 0, not by their mean
    const auto& c = constants_;
    const Wide cosine = 1 - c.nu2 * leap_.V, sine = leap_.S;
    const W forced = leap_.S * c.mu + leap_.V * c.push;
    y.Pi = {cosine * y.Pi.re - c.kappa1 * sine * y.Pi.im + forced.re,
            cosine * y.Pi.im + c.kappa2 * sine * y.Pi.re + forced.im};
  }

  /// Up to 64 blocks that start at entry `first`.
  void group(const Standing& y, std::size_t first, std::size_t count, const GridColumns<Scalar>& to) const noexcept {
    const auto narrow = [](Wide a) noexcept { return static_cast<Scalar>(a); };
    const Start start{narrow(y.Pi.re), narrow(y.Pi.im), narrow(y.Gamma.re), narrow(y.Gamma.im),   narrow(y.G.re),
                      narrow(y.G.im),  narrow(y.G3),    narrow(y.v.re),     narrow(y.v.im),       narrow(y.v3),
                      narrow(y.x.re),  narrow(y.x.im),  narrow(y.x3),       narrow(y.heading.re), narrow(y.heading.im)};
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
  typename Map::Constants constants_{Problem<Wide>{}};
  LinearStart<Wide> loads_{Problem<Wide>{}};
  Map leap_;  ///< over a group
  Scalar begin_ = 0, step_ = 0, r0_ = 0, theta0_ = 0, charge_ = 0, kappa1_ = 0, kappa2_ = 0;
  Complex pull_;  ///< -i f3/m
  std::size_t block_ = longest;
  std::size_t group_ = longest;  ///< entries from one start by the closed form
  bool pushed_ = false;          ///< a transverse force acts
};

#ifdef GYROSTAT_COMPILED
extern template class BlockGrid<double>;
#endif

}  // namespace gyrostat::spinning
GYROSTAT_QUIET_LOOPS_END
