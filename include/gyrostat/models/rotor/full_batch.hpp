// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"
#include "gyrostat/math/sine_wide.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/rotate_once.hpp"

namespace gyrostat::rotor {

/// Taylor recurrences of the full equations (docs/rotor.md, section 2, form C) for eight gyrostats side by side, each with its own body,
/// motor and start. A state, in the principal axes of R, is
///     (H1, H2, H3, p, b, psi | w, x, y, z, n1, n2, n3),  b = integral of omega - omega*,
/// the numbers behind the bar those at the begin of the step: the attitude, and the direction n of H. As P H = L is constant, the attitude
/// follows from H and one angle, where twelve products of series would be needed for the quaternion:
///     P(t) = P_0 R(n, psi) M(H -> n),  dpsi/dt = (Omega.H + |H| Omega.n)/(|H| + H.n),
/// R being the turn about n by psi, and M the least one that takes the direction of H to n. A step does not reach the time when these are opposite,
/// a singularity of psi.
///
/// One order costs six products of series for H x Omega, three squares and a quotient. A momentum of zero has no direction: such a problem
/// fails at once (ode::Status::not_finite).
template <Real Real_>
class FullBatch {
 public:
  using Scalar = Real_;
  static constexpr int width = 6;
  static constexpr int carried = 7;
  static constexpr int size = 8;
  using Numbers = std::array<Scalar, width + carried>;
  using Scale = std::array<Scalar, width>;
  using Rows = Scalar[width + carried][size];

  /// dpsi/dt, and (|H| + H.n)/(2 |H|); and what stands before H and p, the squares and the products with p in the dividend, and before H in the
  /// divisor, both over 2 |H|.
  template <int Order>
  struct Work {
    alignas(64) Scalar rate[Order][size];
    alignas(64) Scalar part[Order][size];
    alignas(64) Scalar linear[4][size];
    alignas(64) Scalar weight[3][size];
    alignas(64) Scalar pull[3][size];
    alignas(64) Scalar near[3][size];
  };

  /// Eight unit spheres that turn about their first axes.
  FullBatch() noexcept {
    State<Scalar> start;
    start.momentum[0] = 1;
    for (int b = 0; b < size; ++b) set(b, Gyrostat<Scalar>{}, start);
  }

  /// The constants of problem b, and those that its steps keep.
  void set(int b, const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start) noexcept {
    set(b, gyrostat, start, gyrostat.free_axes());
  }
  /// free: the principal axes and moments of R.
  void set(int b, const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start,
           const PrincipalAxes<Scalar>& free) noexcept {
    const Vec3<Scalar> e = free.R_BP.transpose() * gyrostat.axis();
    const Vec3<Scalar> a = free.moments.cwiseInverse();
    const Scalar gaps[3] = {free.gaps[1] * a[1] * a[2], -free.gaps[2] * a[2] * a[0], free.gaps[0] * a[0] * a[1]};
    const auto at = static_cast<std::size_t>(b);
    q_BF_[at] = from_matrix<Scalar>(free.R_BP);
    angle_[at] = start.rotor_angle;
    const Quat<Scalar> q = normalised(start.attitude) * q_BF_[at];
    const Vec3<Scalar> H = rotate_once(conjugate(q_BF_[at]), start.momentum);
    const Scalar l = H.norm();
    const Vec3<Scalar> n = H / l, L = rotate_once(q, n);
    for (int i = 0; i < 3; ++i) {
      inverse_[i][b] = a[i];
      gap_[i][b] = gaps[i];
      pull_[i][b] = a[i] * e[i];
      direction_[i][b] = L[i];
      for (int j = 0; j < 3; ++j) axes_[3 * i + j][b] = free.R_BP(i, j);
    }
    quaternion_[0][b] = q_BF_[at].w, quaternion_[1][b] = -q_BF_[at].x;
    quaternion_[2][b] = -q_BF_[at].y, quaternion_[3][b] = -q_BF_[at].z;
    inverse_norm_[b] = 1 / l;
    rotor_inverse_[b] = 1 / gyrostat.axial_inertia() + e.dot(a.cwiseProduct(e));
    no_load_rate_[b] = gyrostat.no_load_rate();
    slope_[b] = gyrostat.slope();
    start_[at] = {H[0], H[1], H[2], start.axial_momentum, 0, 0, q.w, q.x, q.y, q.z, n[0], n[1], n[2]};
    const Scalar wheel = std::abs(gyrostat.target_momentum()) + std::abs(start.axial_momentum);
    const Scalar p = std::min(l, gyrostat.axial_inertia() / gyrostat.free_principal()[0] * l) + wheel;
    scale_[at] = {l, l, l, p, 0, 2};  // two radians are one of a quaternion
  }

  /// The numbers of problem b at t = 0, and what its steps measure errors against.
  const Numbers& start(int b) const noexcept { return start_[static_cast<std::size_t>(b)]; }
  const Scale& scale(int b) const noexcept { return scale_[static_cast<std::size_t>(b)]; }

  /// The state, in body axes, that numbers of problem b at t mean.
  State<Scalar> state(int b, Scalar t, const Numbers& x) const noexcept {
    const auto at = static_cast<std::size_t>(b);
    Pack y[width + carried];
    for (std::size_t i = 0; i < width + carried; ++i) y[i] = wide(x[i]);
    const Turned turned = turn(y, &y[width], wide(inverse_norm_[b]));
    const Quat<Scalar> q{turned.q[0][0], turned.q[1][0], turned.q[2][0], turned.q[3][0]};
    return {normalised(q * conjugate(q_BF_[at])), rotate<Scalar>(q_BF_[at], Vec3<Scalar>(x[0], x[1], x[2])), x[3],
            angle_[at] + (no_load_rate_[b] * t + x[4])};
  }

  /// The states of all, in body axes, each at its own t: (w, x, y, z | H1, H2, H3 | p | angle of the rotor).
  void states(const std::array<Scalar, size>& t, const Rows& x, Scalar (&to)[9][size]) const noexcept;

  template <int Order>
  void expand(const Scalar (&unit)[size], Scalar (&x)[Order + 1][width][size], Work<Order>& work) const noexcept {
    // the registers of one order side by side: while one waits for its newest terms the other works
    for (int k = 0; k < Order; ++k) {
      for (int first = 0; first < size; first += wide_size<Scalar>) extend(k, first, unit, x, work);
    }
  }

  /// The attitude and the direction of H where the step ends; |H| = |L| and P H = L.
  void settle(int first, Scalar (&x)[width][size], Scalar (&low)[width][size],
              Scalar (&held)[carried][size]) const noexcept;

 private:
  using Pack = Wide<Scalar>;

  struct Turned {
    Pack q[4];  ///< unit to a few roundings
    Pack m[3];  ///< the direction of H
  };
  /// The attitude of numbers and those held.
  static GYROSTAT_INLINE Turned turn(const Pack* x, const Pack* held, const Pack& inverse_norm) noexcept;

  static GYROSTAT_INLINE void multiply(const Pack (&a)[4], const Pack (&b)[4], Pack (&to)[4]) noexcept {
    to[0] = a[0] * b[0] - multiply_add(a[1], b[1], multiply_add(a[2], b[2], a[3] * b[3]));
    to[1] = multiply_add(a[0], b[1], multiply_add(a[1], b[0], a[2] * b[3] - a[3] * b[2]));
    to[2] = multiply_add(a[0], b[2], multiply_add(a[2], b[0], a[3] * b[1] - a[1] * b[3]));
    to[3] = multiply_add(a[0], b[3], multiply_add(a[3], b[0], a[1] * b[2] - a[2] * b[1]));
  }
  static GYROSTAT_INLINE Pack square_of(const Pack (&q)[4]) noexcept {
    return multiply_add(q[0], q[0], q[1] * q[1]) + multiply_add(q[2], q[2], q[3] * q[3]);
  }

  /// Order k + 1 of the problems first, first + 1, ... of one register.
  template <int Order>
  GYROSTAT_INLINE void extend(int k, int first, const Scalar (&unit)[size], Scalar (&x)[Order + 1][width][size],
                              Work<Order>& work) const noexcept;

  /// The same from the products of series of order k: of H for H x R^-1 H, of p and H, of H with itself, and of the quotient.
  template <int Order>
  GYROSTAT_INLINE void finish(int k, int first, const Scalar (&unit)[size], const Pack (&across)[3],
                              const Pack (&pull)[3], const Pack (&square)[3], const Pack& quotient,
                              Scalar (&x)[Order + 1][width][size], Work<Order>& work) const noexcept;

  alignas(64) Scalar inverse_[3][size];     ///< 1/R
  alignas(64) Scalar gap_[3][size];         ///< (a_3 - a_2, a_1 - a_3, a_2 - a_1), a = 1/R
  alignas(64) Scalar pull_[3][size];        ///< R^-1 e
  alignas(64) Scalar direction_[3][size];   ///< L/|L|, inertial axes
  alignas(64) Scalar axes_[9][size];        ///< principal axes of R to body axes, row by row
  alignas(64) Scalar quaternion_[4][size];  ///< the same, conjugate
  alignas(64) Scalar inverse_norm_[size];   ///< 1/|L|
  alignas(64) Scalar rotor_inverse_[size];  ///< 1/(lambda k)
  alignas(64) Scalar no_load_rate_[size];
  alignas(64) Scalar slope_[size];
  std::array<Quat<Scalar>, size> q_BF_;
  std::array<Scalar, size> angle_;
  std::array<Numbers, size> start_;
  std::array<Scale, size> scale_;
};

// Loops over components are unrolled by word: at -O2 GCC leaves them, and arrays of registers in memory (1.7 times the time).
template <Real Real_>
template <int Order>
GYROSTAT_INLINE void FullBatch<Real_>::extend(int k, int first, const Scalar (&units)[size],
                                              Scalar (&x)[Order + 1][width][size], Work<Order>& work) const noexcept {
  const Pack zero = wide(Scalar(0)), two = wide(Scalar(2));
  const auto row = [&](int j, int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&x[j][i][first]); };
  // products of two series: terms j and k - j at once, the newest last
  Pack across[3][2], pulled[3][2], square[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) across[i][0] = across[i][1] = pulled[i][0] = pulled[i][1] = square[i] = zero;
  const auto turning = [&](int j) GYROSTAT_INLINE_LAMBDA {
    const Pack h[3] = {row(j, 0), row(j, 1), row(j, 2)}, y[3] = {row(k - j, 0), row(k - j, 1), row(k - j, 2)};
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const int n = (i + 1) % 3, l = (i + 2) % 3;
      across[i][0] = multiply_add(h[n], y[l], across[i][0]);
      across[i][1] = multiply_add(y[n], h[l], across[i][1]);
      square[i] = multiply_add(h[i], y[i], square[i]);
    }
  };
  Pack quotient[2] = {zero, zero};
  const auto pulling = [&](int j) GYROSTAT_INLINE_LAMBDA {
    const Pack p = row(j, 3), r = row(k - j, 3);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      pulled[i][0] = multiply_add(p, row(k - j, i), pulled[i][0]);
      pulled[i][1] = multiply_add(r, row(j, i), pulled[i][1]);
    }
  };
  const auto dividing = [&](int j) GYROSTAT_INLINE_LAMBDA {
    quotient[0] = multiply_add(load_wide(&work.part[j][first]), load_wide(&work.rate[k - j][first]), quotient[0]);
    quotient[1] = multiply_add(load_wide(&work.part[k - j][first]), load_wide(&work.rate[j][first]), quotient[1]);
  };
  const int half = (k - 1) / 2;
  if constexpr (wide_size<Scalar> == 8) {
    for (int j = half; j >= 1; --j) {
      turning(j);
      pulling(j);
      dividing(j);
    }
  } else {  // with sixteen registers, one after the other
    for (int j = half; j >= 1; --j) turning(j);
    for (int j = half; j >= 1; --j) pulling(j), dividing(j);
  }
  Pack middle[3] = {zero, zero, zero};
  if (k % 2 == 0) {
    const Pack h[3] = {row(k / 2, 0), row(k / 2, 1), row(k / 2, 2)}, p = row(k / 2, 3);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      across[i][0] = multiply_add(h[(i + 1) % 3], h[(i + 2) % 3], across[i][0]);
      pulled[i][0] = multiply_add(p, h[i], pulled[i][0]);
      middle[i] = h[i] * h[i];
    }
    if (k > 0)
      quotient[0] = multiply_add(load_wide(&work.part[k / 2][first]), load_wide(&work.rate[k / 2][first]), quotient[0]);
  }
  if (k > 0) {
    turning(0);
    pulling(0);
  }

  Pack pull[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    across[i][0] = across[i][0] + across[i][1];
    square[i] = multiply_add(two, square[i], middle[i]);
    pull[i] = pulled[i][0] + pulled[i][1];
  }
  finish(k, first, units, {across[0][0], across[1][0], across[2][0]}, pull, square, quotient[0] + quotient[1], x, work);
}

template <Real Real_>
template <int Order>
GYROSTAT_INLINE void FullBatch<Real_>::finish(int k, int first, const Scalar (&units)[size], const Pack (&across)[3],
                                              const Pack (&pull)[3], const Pack (&square)[3], const Pack& quotient,
                                              Scalar (&x)[Order + 1][width][size], Work<Order>& work) const noexcept {
  const Pack zero = wide(Scalar(0));
  const auto row = [&](int j, int i) GYROSTAT_INLINE_LAMBDA { return load_wide(&x[j][i][first]); };
  const Pack unit = load_wide(&units[first]);
  // a quotient, which rounds to either side with the unit, where a reciprocal of k + 1 rounds to one
  const Pack share = unit / wide(static_cast<Scalar>(k + 1));
  const Pack H[3] = {row(k, 0), row(k, 1), row(k, 2)}, p = row(k, 3);
  Pack g[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) g[i] = load_wide(&pull_[i][first]);
  if (k == 0) {
    const Pack inverse = load_wide(&inverse_norm_[first]), c = wide(Scalar(0.5)) * inverse;
    Pack along = zero;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Pack weight = c * load_wide(&inverse_[i][first]);
      store(&work.weight[i][first], weight);
      store(&work.linear[i][first], weight * H[i]);
      store(&work.pull[i][first], c * g[i]);
      store(&work.near[i][first], c * inverse * H[i]);
      along = multiply_add(c * g[i], H[i], along);
    }
    store(&work.linear[3][first], along);
  }
  Pack rate = zero - load_wide(&work.linear[3][first]) * p;
  Pack rate_2 = zero - quotient;
  Pack part = zero;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const int n = (i + 1) % 3, l = (i + 2) % 3;
    const Pack turned = load_wide(&gap_[i][first]) * across[i];
    store(&x[k + 1][i][first], share * multiply_add(g[n], pull[l], turned - g[l] * pull[n]));
    rate = multiply_add(load_wide(&work.linear[i][first]), H[i], rate);
    rate_2 = multiply_add(load_wide(&work.weight[i][first]), square[i], rate_2);
    rate_2 = rate_2 - load_wide(&work.pull[i][first]) * pull[i];
    part = multiply_add(load_wide(&work.near[i][first]), H[i], part);
  }
  Pack excess = load_wide(&rotor_inverse_[first]) * p - multiply_add(g[0], H[0], multiply_add(g[1], H[1], g[2] * H[2]));
  if (k == 0) excess = excess - load_wide(&no_load_rate_[first]);
  const Pack advance = share * excess;
  store(&x[k + 1][3][first], zero - load_wide(&slope_[first]) * advance);
  store(&x[k + 1][4][first], advance);
  rate = rate + rate_2;
  if (k > 0) {
    store(&work.part[k][first], part);
    rate = rate - part * load_wide(&work.rate[0][first]);
  }
  store(&work.rate[k][first], rate);
  store(&x[k + 1][5][first], share * rate);
}

template <Real Real_>
GYROSTAT_INLINE auto FullBatch<Real_>::turn(const Pack* x, const Pack* held, const Pack& inverse_norm) noexcept
    -> Turned {
  const Pack one = wide(Scalar(1));
  const Pack *q = held, *n = held + 4;
  Turned made;
  Pack* m = made.m;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) m[i] = x[i] * inverse_norm;
  const Pack near = one + multiply_add(m[0], n[0], multiply_add(m[1], n[1], m[2] * n[2]));
  const Pack unit = inverse_square_root<Scalar>(near + near);
  const Pack back[4] = {unit * near, unit * (m[1] * n[2] - m[2] * n[1]), unit * (m[2] * n[0] - m[0] * n[2]),
                        unit * (m[0] * n[1] - m[1] * n[0])};
  const auto half = math::sine_cosine<Scalar>(wide(Scalar(0.5)) * x[5]);
  const Pack about[4] = {half.cosine, half.sine * n[0], half.sine * n[1], half.sine * n[2]};
  const Pack from[4] = {q[0], q[1], q[2], q[3]};
  Pack turned[4];
  multiply(about, back, turned);
  multiply(from, turned, made.q);
  return made;
}

template <Real Real_>
void FullBatch<Real_>::states(const std::array<Scalar, size>& t, const Rows& x, Scalar (&to)[9][size]) const noexcept {
  for (int first = 0; first < size; first += wide_size<Scalar>) {
    Pack y[width + carried];
#pragma GCC unroll 16
    for (int i = 0; i < width + carried; ++i) y[i] = load_wide(&x[i][first]);
    const Turned turned = turn(y, &y[width], load_wide(&inverse_norm_[first]));
    Pack frame[4], q[4];
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) frame[i] = load_wide(&quaternion_[i][first]);
    multiply(turned.q, frame, q);
    const Pack unit = inverse_square_root<Scalar>(square_of(q));
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) store(&to[i][first], q[i] * unit);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Pack sum = multiply_add(
          load_wide(&axes_[3 * i][first]), y[0],
          multiply_add(load_wide(&axes_[3 * i + 1][first]), y[1], load_wide(&axes_[3 * i + 2][first]) * y[2]));
      store(&to[4 + i][first], sum);
    }
    store(&to[7][first], y[3]);
    const Pack before = load_wide(&angle_[static_cast<std::size_t>(first)]);
    store(&to[8][first], before + multiply_add(load_wide(&no_load_rate_[first]),
                                               load_wide(&t[static_cast<std::size_t>(first)]), y[4]));
  }
}

template <Real Real_>
void FullBatch<Real_>::settle(int first, Scalar (&x)[width][size], Scalar (&low)[width][size],
                              Scalar (&held)[carried][size]) const noexcept {
  const Pack one = wide(Scalar(1)), half = wide(Scalar(0.5)), zero = wide(Scalar(0));
  const Pack inverse = load_wide(&inverse_norm_[first]);
  Pack y[width], before[carried];
#pragma GCC unroll 8
  for (int i = 0; i < width; ++i) y[i] = load_wide(&x[i][first]);
#pragma GCC unroll 8
  for (int i = 0; i < carried; ++i) before[i] = load_wide(&held[i][first]);

  Pack missing = one, along = zero;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Pack m = y[i] * inverse;
    missing = multiply_add(zero - m, m, missing);
    along = multiply_add(m, load_wide(&low[i][first]) * inverse, along);
  }
  const Pack stretch = half * missing - along;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Pack rest = multiply_add(stretch, y[i], load_wide(&low[i][first]));
    const Pack moved = y[i] + rest, part = moved - y[i];
    store(&low[i][first], (y[i] - (moved - part)) + (rest - part));
    store(&x[i][first], moved);
    y[i] = moved;
  }

  Turned turned = turn(y, before, inverse);
  // P m, and the least turn from there to L; q stays unit
  Pack(&q)[4] = turned.q;
  Pack(&m)[3] = turned.m;
  Pack twice[3], at[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Pack cross = q[1 + j] * m[k] - q[1 + k] * m[j];
    twice[i] = cross + cross;
  }
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    at[i] = multiply_add(q[0], twice[i], m[i] + (q[1 + j] * twice[k] - q[1 + k] * twice[j]));
  }
  Pack L[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) L[i] = load_wide(&direction_[i][first]);
  Pack change[4];
  change[0] = multiply_add(half, one - square_of(q), one);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    change[1 + i] = half * (at[j] * L[k] - at[k] * L[j]);
  }
  Pack next[4];
  multiply(change, q, next);
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) store(&held[i][first], next[i]);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) store(&held[4 + i][first], m[i]);
  store(&x[5][first], zero);
  store(&low[5][first], zero);
}

}  // namespace gyrostat::rotor
