// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

namespace gyrostat::heavy {

namespace detail {

/// cos and sin of 2 pi j k/64, harmonic j, node k.
template <Real Scalar>
struct Harmonics {
  static constexpr int nodes = 64, count = 32;
  alignas(64) Scalar c[count][nodes], s[count][nodes];

  constexpr Harmonics() noexcept : c{}, s{} {
    constexpr long double quarter[] = {0.0L,
                                       0.0980171403295606019941955638886418459L,
                                       0.195090322016128267848284868477022241L,
                                       0.290284677254462367636192375817395275L,
                                       0.382683432365089771728459984030398867L,
                                       0.471396736825997648556387625905254378L,
                                       0.555570233019602224742830813948532874L,
                                       0.634393284163645498215171613225493371L,
                                       0.707106781186547524400844362104849039L,
                                       0.773010453362736960810906609758469801L,
                                       0.831469612302545237078788377617905757L,
                                       0.88192126434835502971275686366038835L,
                                       0.923879532511286756128183189396788287L,
                                       0.956940335732208864935797886980269969L,
                                       0.980785280403230449126182236134239037L,
                                       0.995184726672196886244836953109479922L,
                                       1.0L};
    Scalar sine[nodes] = {};
    for (int k = 0; k < nodes; ++k) {
      const int half = k % 32, at = half <= 16 ? half : 32 - half;
      sine[k] = static_cast<Scalar>(k < 32 ? quarter[at] : -quarter[at]);
    }
    for (int j = 0; j < count; ++j) {
      for (int k = 0; k < nodes; ++k) {
        s[j][k] = sine[j * k % nodes];
        c[j][k] = sine[(j * k + 16) % nodes];
      }
    }
  }
};

template <Real Scalar>
inline constexpr Harmonics<Scalar> harmonics_table{};

}  // namespace detail

/// The forced motion of a fast spin as a series in eps^2 with Fourier sums as coefficients (Lindstedt; docs/heavy.md, section 3). All
/// unknowns are 2 pi periodic in u = Omega r0 t. Term n of each carries its eps^(2n), for the loads carry theirs; its harmonics end
/// at 2n + 1. Products are taken at 64 nodes, which hold them without aliasing up to the last order. Divisors: 1 - a, 1 - b,
/// a + b - 1, no others. About 120 kB (double): for the time of a construction only.
template <Real Scalar>
class Lindstedt {
 public:
  static constexpr int most = 15;  ///< the last order in eps^2
  static constexpr int nodes = detail::Harmonics<Scalar>::nodes;
  static constexpr int harmonics = detail::Harmonics<Scalar>::count;
  /// p/r0, q/r0, r/r0, down, psi'/r0.
  enum Unknown : int { P, Q, R, g1, g2, g3, turn, unknowns };

  /// c_0 + sum_j (c_j cos ju + s_j sin ju).
  struct Wave {
    alignas(64) Scalar c[harmonics], s[harmonics];
  };
  /// The largest of one term over the motion.
  struct Size {
    Scalar rates = 0;  ///< of (p, q, r)/r0
    Scalar down = 0;
    Scalar phase = 0;  ///< of Omega
    Scalar drift = 0;  ///< of the mean of psi'/r0
    Scalar swing = 0;  ///< of psi less its mean growth, a bound
  };

  explicit Lindstedt(const Scaled<Scalar>& scaled) noexcept : s_(scaled) {
    for (auto& unknown : wave_) unknown[0] = Wave{};
    wave_[R][0].c[0] = 1;
    wave_[g1][0].c[1] = s_.M3;
    wave_[g2][0].s[1] = -s_.M3;
    wave_[g3][0].c[0] = s_.G0;
    for (int i = 0; i < unknowns; ++i) synthesise(i, 0);
    rate_[0] = 1;
    size_[0].rates = size_[0].down = size_[0].phase = 1;
  }

  int order() const noexcept { return order_; }
  const Scaled<Scalar>& scaled() const noexcept { return s_; }
  const Wave& wave(Unknown unknown, int n) const noexcept {
    return wave_[static_cast<std::size_t>(unknown)][static_cast<std::size_t>(n)];
  }
  /// Term n of Omega.
  Scalar rate(int n) const noexcept { return rate_[static_cast<std::size_t>(n)]; }
  const Size& size(int n) const noexcept { return size_[static_cast<std::size_t>(n)]; }
  /// The largest mean of a source that must have none: some eps times the terms, else the terms are wrong.
  Scalar imbalance() const noexcept { return imbalance_; }

  /// The worst ratio of one term to the one before, of the last three, of rates and down; 1 or more: they do not fall. 0 where there are
  /// none above rounding.
  Scalar fall() const noexcept { return fall(&Size::rates, &Size::down, 0); }

  /// The last term is below rounding, and not by chance: what follows is rounding, which 1/M3 may let grow.
  bool spent() const noexcept {
    const auto term = [&](int n) noexcept { return size(n).rates + size(n).down; };
    return order_ >= 2 && term(order_) < epsilon<Scalar> / 2 && term(order_ - 1) < std::sqrt(epsilon<Scalar>);
  }

  /// What a sum of the terms 0..kept leaves out: the terms known beyond it, and a geometric tail from the largest of the last three
  /// with the ratio of fall(), with margins 1.1 and 4: the ratio may still grow. Infinite where the terms do not fall. Those of psi
  /// have a ratio of their own: near the vertical they alone do not fall. Those of Omega come great and small in turn, with margin 6: of
  /// 470 000 remainders of random bodies 30 were too small with 4, 11 with 6.
  Size remainder(int kept) const noexcept {
    Size left;
    const Scalar moving = fall(), turning = std::fmax(moving, fall(&Size::drift, &Size::swing, 1));
    const auto estimate = [&](Scalar Size::* part, Scalar ratio, Scalar margin = 4) noexcept {
      Scalar sum = 0, envelope = 0, power = 1;
      for (int n = kept + 1; n <= order_; ++n) sum += size(n).*part;
      for (int n = order_; n > std::max(order_ - 3, 0); --n, power *= ratio)
        envelope = std::fmax(envelope, size(n).*part * power);
      left.*part = ratio < 1 ? Scalar(1.1L) * sum + margin * envelope * ratio / (1 - ratio) : infinity<Scalar>;
    };
    estimate(&Size::rates, moving);
    estimate(&Size::down, moving);
    estimate(&Size::phase, moving, 6);
    estimate(&Size::drift, turning);
    estimate(&Size::swing, turning);
    // means of p and q come with parity: two orders on they return by the torque over the divisors 1 - a, 1 - b, unseen in between
    if (order_ >= 2) {
      const Scalar divisor = std::fmin(s_.load[0] == 0 ? infinity<Scalar> : std::abs(s_.off_a),
                                       s_.load[1] == 0 ? infinity<Scalar> : std::abs(s_.off_b));
      const Scalar last = std::fmax(mean(order_), mean(order_ - 1)), ratio = s_.torque() * s_.torque() / divisor;
      const Scalar tail = last == 0 ? Scalar(0) : ratio < 1 ? 4 * last * ratio / (1 - ratio) : infinity<Scalar>;
      for (const auto part : {&Size::rates, &Size::down, &Size::phase, &Size::drift, &Size::swing}) left.*part += tail;
      // and quicken the turn by half their square, at the sum of their orders: twice that
      for (int n = 1; n <= order_; ++n)
        for (int m = order_ + 1 - n; m <= order_; ++m) left.phase += mean(n) * mean(m);
    }
    return left;
  }

  /// The next order. False, and nothing changed that counts, where it is past the last, or not finite because a divisor vanishes.
  bool advance() noexcept {
    if (order_ == most) return false;
    const int n = order_ + 1;
    const Scalar x = s_.load[0], y = s_.load[1], z = s_.load[2], k = s_.gradient, A1 = s_.A1, B1 = s_.B1;
    Nodes Sp{}, Sq{}, Sr{}, S3{}, S1{}, S2{}, turned{};
    add(y / s_.a, g3, n - 1, Sp);
    add(-z / s_.a, g2, n - 1, Sp);
    add(k * A1, g2, g3, n - 1, 0, n - 1, Sp);
    add(-A1, Q, R, n, 1, n - 1, Sp);
    add(z / s_.b, g1, n - 1, Sq);
    add(-x / s_.b, g3, n - 1, Sq);
    add(k * B1, g3, g1, n - 1, 0, n - 1, Sq);
    add(-B1, P, R, n, 1, n - 1, Sq);
    oscillate(source(Sp, P, n), source(Sq, Q, n), n);

    add(x, g2, n - 1, Sr);
    add(-y, g1, n - 1, Sr);
    add(k * s_.C1, g1, g2, n - 1, 0, n - 1, Sr);
    add(-s_.C1, P, Q, n, 1, n - 1, Sr);
    integrate(source(Sr, R, n), R, n);

    add(1, Q, g1, n, 1, n, S3);
    add(-1, P, g2, n, 1, n, S3);
    integrate(source(S3, g3, n), g3, n);

    add(1, R, g2, n, 1, n, S1);
    add(-1, Q, g3, n, 1, n, S1);
    add(1, P, g3, n, 1, n, S2);
    add(-1, R, g1, n, 1, n, S2);
    revolve(source(S1, g1, n), source(S2, g2, n), n);

    // psi' (1 - g3^2) = p g1 + q g2, with 1 - g3^2 = M3^2 - (terms of g3^2)
    add(1, P, g1, n, 1, n, turned);
    add(1, Q, g2, n, 1, n, turned);
    for (int m = 1; m < n; ++m) {
      for (int i = 0; i <= m; ++i) {
        const Nodes &u = at(g3, i), &v = at(g3, m - i), &w = at(turn, n - m);
        for (int j = 0; j < nodes; ++j) turned.v[j] += u.v[j] * v.v[j] * w.v[j];
      }
    }
    for (Scalar& value : turned.v) value /= s_.M3 * s_.M3;
    at(turn, n) = turned;
    analyse(turned, n, edit(turn, n));

    measure(n);
    const Size& now = size_[static_cast<std::size_t>(n)];
    if (!(now.rates + now.down + now.phase < infinity<Scalar>)) return false;
    order_ = n;
    return true;
  }

 private:
  struct Nodes {
    alignas(64) Scalar v[nodes];
  };

  /// Of p and q in term n.
  Scalar mean(int n) const noexcept { return std::abs(wave(P, n).c[0]) + std::abs(wave(Q, n).c[0]); }
  Scalar fall(Scalar Size::* one, Scalar Size::* other, int first) const noexcept {
    Scalar worst = 0;
    for (int n = order_; n > std::max(order_ - 3, first); --n) {
      const Scalar here = size(n).*one + size(n).*other, before = size(n - 1).*one + size(n - 1).*other;
      if (!(here < epsilon<Scalar> / 2)) worst = std::fmax(worst, here / before);
    }
    return worst;
  }

  Nodes& at(int unknown, int n) noexcept {
    return values_[static_cast<std::size_t>(unknown)][static_cast<std::size_t>(n)];
  }
  Wave& edit(int unknown, int n) noexcept {
    return wave_[static_cast<std::size_t>(unknown)][static_cast<std::size_t>(n)];
  }
  /// One more than the last harmonic of order n.
  static int end(int n) noexcept { return std::min(2 * n + 2, harmonics); }

  void add(Scalar factor, int unknown, int n, Nodes& sum) noexcept {
    const Nodes& f = at(unknown, n);
    for (int j = 0; j < nodes; ++j) sum.v[j] += factor * f.v[j];
  }
  /// sum_(i = first..last) f_i g_(n-i).
  void add(Scalar factor, int f, int g, int n, int first, int last, Nodes& sum) noexcept {
    if (factor == 0 || last < first) return;
    Nodes product{};
    for (int i = first; i <= last; ++i) {
      const Nodes &u = at(f, i), &v = at(g, n - i);
      for (int j = 0; j < nodes; ++j) product.v[j] += u.v[j] * v.v[j];
    }
    for (int j = 0; j < nodes; ++j) sum.v[j] += factor * product.v[j];
  }

  static void analyse(const Nodes& f, int n, Wave& wave) noexcept {
    const auto& table = detail::harmonics_table<Scalar>;
    wave = Wave{};
    for (int j = 0; j < end(n); ++j) {
      Lanes<Scalar> c = lanes(Scalar(0)), s = c;
      for (int i = 0; i < nodes; i += 4) {
        const Lanes<Scalar> value = load(f.v + i);
        c = multiply_add(value, load(table.c[j] + i), c);
        s = multiply_add(value, load(table.s[j] + i), s);
      }
      const Scalar weight = Scalar(j == 0 ? 1 : 2) / nodes;
      wave.c[j] = weight * sum(c)[0];
      wave.s[j] = j == 0 ? Scalar(0) : weight * sum(s)[0];
    }
  }
  void synthesise(int unknown, int n) noexcept {
    const auto& table = detail::harmonics_table<Scalar>;
    const Wave& wave = edit(unknown, n);
    Nodes sum{};
    for (int j = 0; j < end(n); ++j) {
      const Scalar c = wave.c[j], s = wave.s[j];
      for (int i = 0; i < nodes; ++i) sum.v[i] += c * table.c[j][i] + s * table.s[j][i];
    }
    at(unknown, n) = sum;
  }

  /// The harmonics of S - sum_(m = 1..n-1) Omega_m f_(n-m)'.
  Wave source(const Nodes& S, int unknown, int n) noexcept {
    Wave wave;
    analyse(S, n, wave);
    for (int m = 1; m < n; ++m) {
      const Scalar rate = rate_[static_cast<std::size_t>(m)];
      const Wave& f = edit(unknown, n - m);
      for (int j = 1; j < end(n - m); ++j) {
        wave.c[j] -= rate * Scalar(j) * f.s[j];
        wave.s[j] += rate * Scalar(j) * f.c[j];
      }
    }
    return wave;
  }

  /// p' + A1 q = Sp, q' + B1 p = Sq. A mean that a mirror symmetry forbids (x' = 0: of p; y' = 0: of q) is left out.
  void oscillate(const Wave& Sp, const Wave& Sq, int n) noexcept {
    using detail::ratio_or_zero;
    const Scalar A1 = s_.A1, B1 = s_.B1;
    Wave &p = edit(P, n), &q = edit(Q, n);
    p = q = Wave{};
    p.c[0] = s_.load[0] == 0 ? Scalar(0) : ratio_or_zero(Sq.c[0], B1);
    q.c[0] = s_.load[1] == 0 ? Scalar(0) : ratio_or_zero(Sp.c[0], A1);
    for (int j = 1; j < end(n); ++j) {
      const Scalar harmonic = Scalar(j);
      const Scalar divisor =
          j == 1 ? -s_.flatness / (s_.a * s_.b) : s_.nutation_squared() - harmonic * harmonic;  // omega^2 - j^2
      p.c[j] = ratio_or_zero(harmonic * Sp.s[j] - A1 * Sq.c[j], divisor);
      p.s[j] = ratio_or_zero(-harmonic * Sp.c[j] - A1 * Sq.s[j], divisor);
      q.c[j] = ratio_or_zero(harmonic * Sq.s[j] - B1 * Sp.c[j], divisor);
      q.s[j] = ratio_or_zero(-harmonic * Sq.c[j] - B1 * Sp.s[j], divisor);
    }
    synthesise(P, n);
    synthesise(Q, n);
  }

  /// f' = S with f(0) = 0.
  void integrate(const Wave& S, int unknown, int n) noexcept {
    Wave& f = edit(unknown, n);
    f = Wave{};
    imbalance_ = std::fmax(imbalance_, std::abs(S.c[0]));
    Scalar start = 0;
    for (int j = 1; j < end(n); ++j) {
      f.c[j] = -S.s[j] / Scalar(j);
      f.s[j] = S.c[j] / Scalar(j);
      start += f.c[j];
    }
    f.c[0] = -start;
    synthesise(unknown, n);
  }

  /// w' + i w = S1 + i S2 - Omega_n w_0' for w = g1 + i g2, w(0) = 0: harmonic -1 fixes Omega_n.
  void revolve(const Wave& S1, const Wave& S2, int n) noexcept {
    Wave &f1 = edit(g1, n), &f2 = edit(g2, n);
    f1 = f2 = Wave{};
    // of S, harmonic j: up = (c1 + s2)/2 + i (c2 - s1)/2, and -j: down = (c1 - s2)/2 + i (c2 + s1)/2
    rate_[static_cast<std::size_t>(n)] = -(S1.s[1] + S2.c[1]) / (2 * s_.M3);
    imbalance_ = std::fmax(imbalance_, std::abs(S1.c[1] - S2.s[1]) / 2);
    Scalar start_re = S2.c[0], start_im = -S1.c[0];  // mean: S/i
    f1.c[0] = start_re;
    f2.c[0] = start_im;
    for (int j = 1; j < end(n); ++j) {
      const Scalar up_divisor = Scalar(j + 1), down_divisor = Scalar(1 - j);
      // S/(i d) = (Im S - i Re S)/d
      const Scalar up_re = (S2.c[j] - S1.s[j]) / (2 * up_divisor), up_im = -(S1.c[j] + S2.s[j]) / (2 * up_divisor);
      const Scalar down_re = j == 1 ? Scalar(0) : (S2.c[j] + S1.s[j]) / (2 * down_divisor);
      const Scalar down_im = j == 1 ? Scalar(0) : -(S1.c[j] - S2.s[j]) / (2 * down_divisor);
      accumulate(f1, f2, j, up_re, up_im, down_re, down_im);
      start_re += up_re + down_re;
      start_im += up_im + down_im;
    }
    accumulate(f1, f2, 1, Scalar(0), Scalar(0), -start_re, -start_im);
    synthesise(g1, n);
    synthesise(g2, n);
  }
  /// Adds up e^(iju) + down e^(-iju) to f1 + i f2.
  static void accumulate(Wave& f1, Wave& f2, int j, Scalar up_re, Scalar up_im, Scalar down_re,
                         Scalar down_im) noexcept {
    f1.c[j] += up_re + down_re;
    f1.s[j] += down_im - up_im;
    f2.c[j] += up_im + down_im;
    f2.s[j] += up_re - down_re;
  }

  void measure(int n) noexcept {
    Size& size = size_[static_cast<std::size_t>(n)];
    size = Size{};
    const Nodes &p = at(P, n), &q = at(Q, n), &r = at(R, n), &d1 = at(g1, n), &d2 = at(g2, n), &d3 = at(g3, n);
    Scalar rates = 0, down = 0, all = 0;
    for (int j = 0; j < nodes; ++j) {
      const Scalar w = p.v[j] * p.v[j] + q.v[j] * q.v[j] + r.v[j] * r.v[j];
      const Scalar d = d1.v[j] * d1.v[j] + d2.v[j] * d2.v[j] + d3.v[j] * d3.v[j];
      rates = std::max(rates, w);
      down = std::max(down, d);
      all += w + d;
    }
    size.rates = std::sqrt(rates) + 0 * all;  // NaN does not pass a comparison
    size.down = std::sqrt(down) + 0 * all;
    size.phase = std::abs(rate_[static_cast<std::size_t>(n)]);
    const Wave& turned = edit(turn, n);
    size.drift = std::abs(turned.c[0]);
    for (int j = 1; j < end(n); ++j) size.swing += std::hypot(turned.c[j], turned.s[j]) / Scalar(j);
    size.swing *= 2;
  }

  Scaled<Scalar> s_;
  int order_ = 0;
  Scalar imbalance_ = 0;
  std::array<Scalar, most + 1> rate_{};
  std::array<Size, most + 1> size_{};
  std::array<std::array<Wave, most + 1>, unknowns> wave_;
  std::array<std::array<Nodes, most + 1>, unknowns> values_;
};

#ifdef GYROSTAT_COMPILED
extern template class Lindstedt<double>;
#endif

}  // namespace gyrostat::heavy
