// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

/// Taylor recurrences of the full equations (docs/rotor.md, section 2, form C) for eight gyrostats side by side, each with its own body,
/// motor and start. A state, in the principal axes of R, is (w, x, y, z, H1, H2, H3, p, b), b = integral of omega - omega*.
///
/// One order costs six products a term for H x Omega and twelve for the quaternion.
template <Real Real_>
class FullBatch {
 public:
  using Scalar = Real_;
  static constexpr int width = 9;
  static constexpr int size = 8;
  using Numbers = std::array<Scalar, width>;

  /// Omega unit/2.
  template <int Order>
  struct Work {
    alignas(64) Scalar turn[Order][3][size];
  };

  /// Eight unit spheres at rest.
  FullBatch() noexcept {
    for (int b = 0; b < size; ++b) set(b, Gyrostat<Scalar>{}, State<Scalar>{});
  }

  /// The constants of problem b, and those that its projection keeps.
  void set(int b, const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept {
    const PrincipalAxes<Scalar> free = gyrostat.free_axes();
    const Vec3<Scalar> e = free.R_BP.transpose() * gyrostat.axis();
    const Vec3<Scalar> L = rotate<Scalar>(normalised(start.attitude), start.momentum);
    for (int i = 0; i < 3; ++i) {
      inverse_[i][b] = 1 / free.moments[i];
      pull_[i][b] = inverse_[i][b] * e[i];
      momentum_[i][b] = L[i];
    }
    rotor_inverse_[b] = 1 / gyrostat.axial_inertia() + e.dot(free.moments.cwiseInverse().cwiseProduct(e));
    no_load_rate_[b] = gyrostat.no_load_rate();
    slope_[b] = gyrostat.slope();
    const auto at = static_cast<std::size_t>(b);
    q_BF_[at] = from_matrix<Scalar>(free.R_BP);
    angle_[at] = start.rotor_angle;
    const Quat<Scalar> q = normalised(start.attitude) * q_BF_[at];
    const Vec3<Scalar> H = rotate<Scalar>(conjugate(q_BF_[at]), start.momentum);
    start_[at] = {q.w, q.x, q.y, q.z, H[0], H[1], H[2], start.axial_momentum, 0};
    // where nothing moves any scale will do, but zero would leave the component out
    const auto positive = [](Scalar value) noexcept { return value > 0 ? value : Scalar(1); };
    const Scalar l = start.momentum.norm();
    const Scalar wheel = std::abs(gyrostat.target_momentum()) + std::abs(start.axial_momentum);
    const Scalar h = positive(l + wheel);
    const Scalar p = positive(std::min(l, gyrostat.axial_inertia() / gyrostat.free_principal()[0] * l) + wheel);
    scale_[at] = {1, 1, 1, 1, h, h, h, p, 0};
  }

  /// The numbers of problem b at t = 0, and what its steps measure errors against.
  const Numbers& start(int b) const noexcept { return start_[static_cast<std::size_t>(b)]; }
  const Numbers& scale(int b) const noexcept { return scale_[static_cast<std::size_t>(b)]; }
  /// The state, in body axes, that numbers of problem b at t mean.
  State<Scalar> state(int b, Scalar t, const Numbers& x) const noexcept {
    const auto at = static_cast<std::size_t>(b);
    const Quat<Scalar> q{x[0], x[1], x[2], x[3]};
    return {normalised(q * conjugate(q_BF_[at])), rotate<Scalar>(q_BF_[at], Vec3<Scalar>(x[4], x[5], x[6])), x[7],
            angle_[at] + (no_load_rate_[b] * t + x[8])};
  }

  template <int Order>
  void expand(const Scalar (&unit)[size], Scalar (&x)[Order + 1][width][size], Work<Order>& work) const noexcept {
    // the registers of one order side by side: while one waits for its newest terms the other works
    for (int k = 0; k < Order; ++k) {
      for (int first = 0; first < size; first += wide_size<Scalar>) extend(k, first, unit, x, work);
    }
  }

  /// |q| = 1 and P H = L.
  void project(int first, Scalar (&x)[width][size], Scalar (&low)[width][size]) const noexcept;

 private:
  using Pack = Wide<Scalar>;

  /// Order k + 1 of the problems first, first + 1, ... of one register.
  template <int Order>
  GYROSTAT_INLINE void extend(int k, int first, const Scalar (&unit)[size], Scalar (&x)[Order + 1][width][size],
                              Work<Order>& work) const noexcept;

  alignas(64) Scalar inverse_[3][size];     ///< 1/R
  alignas(64) Scalar pull_[3][size];        ///< R^-1 e
  alignas(64) Scalar momentum_[3][size];    ///< L, inertial axes
  alignas(64) Scalar rotor_inverse_[size];  ///< 1/(lambda k)
  alignas(64) Scalar no_load_rate_[size];
  alignas(64) Scalar slope_[size];
  std::array<Quat<Scalar>, size> q_BF_;
  std::array<Scalar, size> angle_;
  std::array<Numbers, size> start_, scale_;
};

template <Real Real_>
template <int Order>
GYROSTAT_INLINE void FullBatch<Real_>::extend(int k, int first, const Scalar (&units)[size],
                                              Scalar (&x)[Order + 1][width][size], Work<Order>& work) const noexcept {
  const Pack zero = wide(Scalar(0));
  const auto row = [&](int j, int i) { return load_wide(&x[j][i][first]); };
  const auto turn = [&](int j, int i) { return load_wide(&work.turn[j][i][first]); };
  Pack c[6] = {zero, zero, zero, zero, zero, zero};
  const auto momentum = [&](int j) {
    const Pack h0 = row(j, 4), h1 = row(j, 5), h2 = row(j, 6);
    const Pack o0 = turn(k - j, 0), o1 = turn(k - j, 1), o2 = turn(k - j, 2);
    c[0] = multiply_add(h1, o2, c[0]);
    c[1] = multiply_add(h2, o1, c[1]);
    c[2] = multiply_add(h2, o0, c[2]);
    c[3] = multiply_add(h0, o2, c[3]);
    c[4] = multiply_add(h0, o1, c[4]);
    c[5] = multiply_add(h1, o0, c[5]);
  };
  Pack s[3][4] = {{zero, zero, zero, zero}, {zero, zero, zero, zero}, {zero, zero, zero, zero}};
  const auto attitude = [&](int j) {
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Pack o = turn(k - j, i);
#pragma GCC unroll 4
      for (int n = 0; n < 4; ++n) s[i][n] = multiply_add(o, row(j, n), s[i][n]);
    }
  };
  const Pack unit = load_wide(&units[first]);
  const Pack half = unit * wide(Scalar(0.5));
  const Pack g[3] = {load_wide(&pull_[0][first]), load_wide(&pull_[1][first]), load_wide(&pull_[2][first])};
  const Pack p = row(k, 7), h0 = row(k, 4), h1 = row(k, 5), h2 = row(k, 6);
  store(&work.turn[k][0][first], half * (load_wide(&inverse_[0][first]) * h0 - g[0] * p));
  store(&work.turn[k][1][first], half * (load_wide(&inverse_[1][first]) * h1 - g[1] * p));
  store(&work.turn[k][2][first], half * (load_wide(&inverse_[2][first]) * h2 - g[2] * p));
  Pack excess = load_wide(&rotor_inverse_[first]) * p - multiply_add(g[0], h0, multiply_add(g[1], h1, g[2] * h2));
  if (k == 0) excess = excess - load_wide(&no_load_rate_[first]);

  if constexpr (wide_size<Scalar> == 8) {
    // first the terms known since the last order
    for (int j = 1; j < k; ++j) {
      momentum(j);
      attitude(j);
    }
    momentum(0);
    attitude(0);
    if (k > 0) {
      momentum(k);
      attitude(k);
    }
  } else {  // with sixteen registers, one after the other
    for (int j = 0; j <= k; ++j) momentum(j);
    for (int j = 0; j <= k; ++j) attitude(j);
  }
  const Pack share = wide(Scalar(1) / static_cast<Scalar>(k + 1));
  const Pack twice = share + share;
  store(&x[k + 1][0][first], share * (zero - ((s[0][1] + s[1][2]) + s[2][3])));
  store(&x[k + 1][1][first], share * ((s[0][0] + s[2][2]) - s[1][3]));
  store(&x[k + 1][2][first], share * ((s[1][0] + s[0][3]) - s[2][1]));
  store(&x[k + 1][3][first], share * ((s[2][0] + s[1][1]) - s[0][2]));
  store(&x[k + 1][4][first], twice * (c[0] - c[1]));
  store(&x[k + 1][5][first], twice * (c[2] - c[3]));
  store(&x[k + 1][6][first], twice * (c[4] - c[5]));
  const Pack advance = share * (unit * excess);
  store(&x[k + 1][7][first], zero - load_wide(&slope_[first]) * advance);
  store(&x[k + 1][8][first], advance);
}

template <Real Real_>
void FullBatch<Real_>::project(int first, Scalar (&x)[width][size], Scalar (&low)[width][size]) const noexcept {
  const Pack one = wide(Scalar(1)), zero = wide(Scalar(0));
  Pack q[4];
  Pack missing = one, along = zero;
  for (int i = 0; i < 4; ++i) q[i] = load_wide(&x[i][first]);
  for (int i = 0; i < 4; ++i) {
    missing = multiply_add(zero - q[i], q[i], missing);
    along = multiply_add(q[i], load_wide(&low[i][first]), along);
  }
  const Pack stretch = wide(Scalar(0.5)) * missing - along;
  for (int i = 0; i < 4; ++i) {
    const Pack y = load_wide(&low[i][first]) + stretch * q[i];
    const Pack moved = q[i] + y;
    const Pack part = moved - q[i];
    store(&low[i][first], (q[i] - (moved - part)) + (y - part));
    store(&x[i][first], moved);
  }
  // H = q* L q, with u the vector part of q*
  const Pack u[3] = {zero - q[1], zero - q[2], zero - q[3]};
  Pack L[3], twice[3];
  for (int i = 0; i < 3; ++i) L[i] = load_wide(&momentum_[i][first]);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Pack across = u[j] * L[k] - u[k] * L[j];
    twice[i] = across + across;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    store(&x[4 + i][first], L[i] + (q[0] * twice[i] + (u[j] * twice[k] - u[k] * twice[j])));
    store(&low[4 + i][first], zero);
  }
}

}  // namespace gyrostat::rotor
