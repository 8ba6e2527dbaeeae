// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// What the linear motion leaves out to second order in the tilt (docs/spinning.md, section 6.1):
///     rho = r - r0 = ((D1 - D2)/D3) int p q,   z = r0 t + theta0 + psi0 phi0/2 + int rho + int (q psi - p phi)/2,
///     theta = z - psi phi/2,   v3: -(f3/2m) int |Gamma|^2,   and of the torque's and of the transverse force's impulse
///     int e^(iz) (M + M~ Gamma^2/4)(1 - |Gamma|^2/4).
namespace gyrostat::spinning {

namespace detail {

/// The integrals over a time that starts with a given linear motion y = (1, p, q, psi, phi). All are quadratic in y, Z to the phase
/// Z = turn + nutation less drift times the time: so of a time of any length they are a form of 15 coefficients each, and the form
/// of twice the time follows from that of the time. Nothing is divided by anything that could be small.
template <Real Scalar>
class TiltIntegrals {
 public:
  using Complex = math::Complex<Scalar>;
  static constexpr int level_cap = 30;

  /// Real and imaginary parts of the complex ones follow each other.
  enum Column : std::uint8_t {
    rho,
    turn,
    nutation,
    cosine,
    cosine_2,
    direct,
    mirrored = 7,
    direct_2 = 9,
    mirrored_2 = 11,
    columns = 16
  };

  /// Totals from 0 to t.
  struct Totals {
    Scalar time = 0;
    std::array<Scalar, columns> value{};
    Complex turned{1, 0};                   ///< e^(i (r0 + drift) t)
    Complex impulse, impulse_2;             ///< its integral, and the integral of that
    Complex plain{1, 0}, plain_1, plain_2;  ///< the same of e^(i r0 t)

    Scalar phase() const noexcept { return value[turn] + value[nutation]; }
    Complex pair(Column c) const noexcept { return {value[c], value[std::size_t(c) + 1]}; }
  };

  TiltIntegrals() = default;

  /// For times in [0, span].
  TiltIntegrals(const Problem<Scalar>& problem, Scalar span) noexcept
      : r0_(problem.spin()), kappa1_(problem.kappa1(r0_)), kappa2_(problem.kappa2(r0_)) {
    const Complex mu{problem.torque[0] / problem.inertia[0], problem.torque[1] / problem.inertia[1]};
    const auto& w = problem.angular_velocity;
    const Scalar moved = magnitude(Complex{w[0], w[1]}),
                 tilted = magnitude(Complex{problem.angles.psi, problem.angles.phi});
    rate_ = std::max({std::abs(r0_), std::abs(kappa1_), std::abs(kappa2_), 1 / span});
    const Scalar g = std::max({tilted, moved / rate_, magnitude(mu) / (rate_ * rate_)});
    tilt_ = g > 0 ? g : Scalar(1);
    mu_ = mu / (tilt_ * rate_);
    skew_ = (problem.inertia[0] - problem.inertia[1]) / problem.inertia[2] * (tilt_ * rate_) * (tilt_ * rate_);
    start_ = {1, w[0] / (tilt_ * rate_), w[1] / (tilt_ * rate_), problem.angles.psi / tilt_,
              problem.angles.phi / tilt_};
    first_ = 1 / (8 * rate_);
    levels_ = 1;
    while (levels_ < level_cap && std::ldexp(first_, levels_) <= span) ++levels_;
    fits_ = std::ldexp(first_, levels_) > span;
    span_ = span;
    if (!fits_) return;
    build();
    // the phase less its mean growth stays small for long
    drift_ = at(span).phase() / span;
    if (drift_ - drift_ == 0) build();
  }

  /// The span is not too long: rate span < 1e8 for the fastest rate of the motion.
  bool fits() const noexcept { return fits_; }
  Scalar drift() const noexcept { return drift_; }

  Totals at(Scalar t) const noexcept {
    Place now = before(t);
    const Scalar rest = t - now.totals.time;
    Level last;
    set_turns(last, rest);
    append(now.totals, last, local(rest, now.y));
    return now.totals;
  }

  /// visit(i, totals) with at(first + i step) for i = 0 to count - 1, step > 0. Costs some twenty calls of at() to begin, then a tenth of one each.
  template <class Visit>
  void along(Scalar first, Scalar step, std::size_t count, const Visit& visit) const noexcept {
    constexpr std::size_t anew = 256;  // rounding adds up no longer than over so many
    const Level by = level(step);
    Place now;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % anew == 0) {
        const Scalar t = first + Scalar(i) * step;
        now = before(t);
        advance(now, short_level(t - now.totals.time));
      } else {
        advance(now, by);
      }
      visit(i, now.totals);
    }
  }

 private:
  using Vector = std::array<Scalar, 5>;  ///< (1, p, q, psi, phi), the rates over tilt_ rate_, the angles over tilt_
  struct Place {
    Totals totals;
    Vector y;
  };
  using Monomials = std::array<Scalar, 15>;
  using Row = std::array<Scalar, columns>;
  static constexpr int order = 11;

  struct Level {
    Scalar time = 0;
    Scalar transition[5][5] = {};
    Row row[15] = {};          ///< of the monomials y_i y_j, i <= j
    Complex turned, one, two;  ///< e^(i w h), int e^(i w s), int int
    Complex ramp, ramp_2;      ///< int s e^(i w s), int int
    Complex plain, plain_1, plain_2;
  };

  /// At the last multiple of first_ up to t.
  GYROSTAT_INLINE Place before(Scalar t) const noexcept {
    Place now{{}, start_};
    const Scalar whole = std::floor(t / first_);
    const std::uint64_t left = whole > 0 ? static_cast<std::uint64_t>(whole) : 0;
    for (int k = levels_ - 1; k >= 0; --k)
      if (left >> k & 1) advance(now, level_[std::size_t(k)]);
    return now;
  }

  static GYROSTAT_INLINE void advance(Place& now, const Level& level) noexcept {
    append(now.totals, level, form(level, now.y));
    now.y = moved(level, now.y);
  }

  static Monomials monomials(const Vector& y) noexcept {
    Monomials m;
    std::size_t k = 0;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = i; j < 5; ++j) m[k++] = y[i] * y[j];
    return m;
  }

  /// A sum of multiples of rows in registers: in memory each addition waits for the one before it.
  struct RowSum {
    Lanes<Scalar> part[4] = {lanes(Scalar(0)), lanes(Scalar(0)), lanes(Scalar(0)), lanes(Scalar(0))};

    GYROSTAT_INLINE void add(Scalar share, const Row& row) noexcept {
      const Lanes<Scalar> by = lanes(share);
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) part[i] = multiply_add(by, load(row.data() + 4 * i), part[i]);
    }

    GYROSTAT_INLINE Row row() const noexcept {
      Row row;
#pragma GCC unroll 4
      for (int i = 0; i < 4; ++i) store(row.data() + 4 * i, part[i]);
      return row;
    }
  };

  static Row form(const Level& level, const Vector& y) noexcept {
    const Monomials m = monomials(y);
    RowSum sum;
    for (std::size_t k = 0; k < 15; ++k) sum.add(m[k], level.row[k]);
    return sum.row();
  }

  static Vector moved(const Level& level, const Vector& y) noexcept {
    Vector z{};
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j) z[i] += level.transition[i][j] * y[j];
    return z;
  }

  static void add(Row& to, Column c, Complex z) noexcept {
    to[c] += z.re;
    to[std::size_t(c) + 1] += z.im;
  }

  /// Adds to what was gathered until now, when e^(iw t) is `turned`, what a piece found for itself.
  static void join(Row& sum, Complex turned, const Level& h, const Row& piece) noexcept {
    const auto pair = [](const Row& r, Column c) noexcept { return Complex{r[c], r[std::size_t(c) + 1]}; };
    const Complex i_phase{0, sum[turn] + sum[nutation]}, i_rho{0, sum[rho]};
    const Complex direct_before = pair(sum, direct), mirrored_before = pair(sum, mirrored);
    add(sum, direct_2, h.time * direct_before + turned * (i_phase * h.two + i_rho * h.ramp_2 + pair(piece, direct_2)));
    add(sum, mirrored_2, h.time * mirrored_before + turned * pair(piece, mirrored_2));
    add(sum, direct, turned * (i_phase * h.one + i_rho * h.ramp + pair(piece, direct)));
    add(sum, mirrored, turned * pair(piece, mirrored));
    sum[cosine_2] += sum[cosine] * h.time + piece[cosine_2];
    sum[turn] += sum[rho] * h.time + piece[turn];
    for (const Column c : {rho, nutation, cosine}) sum[c] += piece[c];
  }

  static void append(Totals& now, const Level& h, const Row& piece) noexcept {
    join(now.value, now.turned, h, piece);
    now.impulse_2 = now.impulse_2 + h.time * now.impulse + now.turned * h.two;
    now.impulse = now.impulse + now.turned * h.one;
    now.turned = now.turned * h.turned;
    now.plain_2 = now.plain_2 + h.time * now.plain_1 + now.plain * h.plain_2;
    now.plain_1 = now.plain_1 + now.plain * h.plain_1;
    now.plain = now.plain * h.plain;
    now.time += h.time;
  }

  /// e^(i w h) and its integrals, w h <= 1/8.
  void set_turns(Level& level, Scalar h) const noexcept {
    level.time = h;
    const auto set = [h](Scalar w, Complex& zero, Complex& one, Complex& two, Complex* ramp, Complex* ramp_2) noexcept {
      zero = one = two = {0, 0};
      Complex term{1, 0};  // (i w h)^k/k!
      for (int k = 0; k <= order + 1; ++k) {
        const Scalar n = static_cast<Scalar>(k);
        zero = zero + term;
        one = one + (h / (n + 1)) * term;
        two = two + (h * h / ((n + 1) * (n + 2))) * term;
        if (ramp) {
          *ramp = *ramp + (h * h / (n + 2)) * term;
          *ramp_2 = *ramp_2 + (h * h * h / ((n + 2) * (n + 3))) * term;
        }
        term = (h * w / (n + 1)) * turned(term);
      }
    };
    set(r0_ + drift_, level.turned, level.one, level.two, &level.ramp, &level.ramp_2);
    set(r0_, level.plain, level.plain_1, level.plain_2, nullptr, nullptr);
  }

  /// Power series of y in s/h.
  struct Series {
    Scalar p[order + 1], q[order + 1], psi[order + 1], phi[order + 1];
  };
  Series series(Scalar h, const Vector& y) const noexcept {
    Series s;
    s.p[0] = y[1], s.q[0] = y[2], s.psi[0] = y[3], s.phi[0] = y[4];
    for (int k = 0; k < order; ++k) {
      const Scalar share = h / static_cast<Scalar>(k + 1), first = k == 0 ? y[0] : Scalar(0);
      s.p[k + 1] = share * (mu_.re * first - kappa1_ * s.q[k]);
      s.q[k + 1] = share * (mu_.im * first + kappa2_ * s.p[k]);
      s.psi[k + 1] = share * (rate_ * s.p[k] + r0_ * s.phi[k]);
      s.phi[k + 1] = share * (rate_ * s.q[k] - r0_ * s.psi[k]);
    }
    return s;
  }

  /// The integrals over a short time, rate h <= 1/8, by series.
  Row local(Scalar h, const Vector& y) const noexcept {
    const Series s = series(h, y);
    const Scalar square = tilt_ * tilt_;
    Complex twist[order + 1];                      // e^(i w s)
    Complex straight[order + 1], back[order + 1];  // i phase - |Gamma|^2/4, Gamma^2/4
    Scalar rate[order + 2] = {}, phase[order + 2] = {}, loss[order + 2] = {};
    Complex first[order + 2], second[order + 2];
    Row sum{};
    twist[0] = {1, 0};
    for (int k = 0; k <= order; ++k) {
      const Scalar share = h / static_cast<Scalar>(k + 1);
      Scalar pq = 0, precession = 0, psi2 = 0, phi2 = 0, psi_phi = 0;
      for (int j = 0; j <= k; ++j) {
        pq += s.p[j] * s.q[k - j];
        precession += s.q[j] * s.psi[k - j] - s.p[j] * s.phi[k - j];
        psi2 += s.psi[j] * s.psi[k - j];
        phi2 += s.phi[j] * s.phi[k - j];
        psi_phi += s.psi[j] * s.phi[k - j];
      }
      const Scalar half = square * (psi2 + phi2) / 2;
      straight[k] = {-half / 2, phase[k]};
      back[k] = (square / 4) * Complex{psi2 - phi2, 2 * psi_phi};
      Complex direct_rate, mirrored_rate;
      for (int j = 0; j <= k; ++j) {
        direct_rate = direct_rate + twist[j] * straight[k - j];
        mirrored_rate = mirrored_rate + twist[j] * back[k - j];
      }
      const Scalar turn_step = share * (rate[k] - (k == 0 ? drift_ * y[0] * y[0] : Scalar(0)));
      const Scalar nutation_step = share * square * rate_ * precession / 2;
      rate[k + 1] = share * skew_ * pq;
      phase[k + 1] = turn_step + nutation_step;
      loss[k + 1] = share * half;
      add(sum, direct_2, share * first[k]);
      add(sum, mirrored_2, share * second[k]);
      first[k + 1] = share * direct_rate;
      second[k + 1] = share * mirrored_rate;
      add(sum, direct, first[k + 1]);
      add(sum, mirrored, second[k + 1]);
      sum[rho] += rate[k + 1];
      sum[turn] += turn_step;
      sum[nutation] += nutation_step;
      sum[cosine_2] += share * loss[k];
      sum[cosine] += loss[k + 1];
      if (k < order) twist[k + 1] = (share * (r0_ + drift_)) * turned(twist[k]);
    }
    return sum;
  }

  /// Of a time up to first_.
  Level short_level(Scalar h) const noexcept {
    Level least;
    set_turns(least, h);
    // columns of the transition, and the forms by polarisation
    Row alone[5];
    std::size_t k = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      Vector e{};
      e[i] = 1;
      alone[i] = local(h, e);
      const Series s = series(h, e);
      const Scalar* const parts[] = {s.p, s.q, s.psi, s.phi};
      least.transition[0][i] = e[0];
      for (std::size_t n = 0; n < 4; ++n)
        for (int j = order; j >= 0; --j) least.transition[n + 1][i] += parts[n][j];
    }
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t j = i; j < 5; ++j, ++k) {
        if (i == j) {
          least.row[k] = alone[i];
          continue;
        }
        Vector e{};
        e[i] = e[j] = 1;
        least.row[k] = local(h, e);
        for (std::size_t c = 0; c < columns; ++c) least.row[k][c] -= alone[i][c] + alone[j][c];
      }
    }
    return least;
  }

  /// Of any time up to the span.
  Level level(Scalar t) const noexcept {
    const Scalar whole = std::floor(t / first_);
    Level made = short_level(t - whole * first_);
    const std::uint64_t left = whole > 0 ? static_cast<std::uint64_t>(whole) : 0;
    for (int k = 0; k < levels_; ++k)
      if (left >> k & 1) made = joined(made, level_[std::size_t(k)]);
    return made;
  }

  void build() noexcept {
    level_[0] = short_level(first_);
    for (std::size_t n = 1; n < std::size_t(levels_); ++n) level_[n] = joined(level_[n - 1], level_[n - 1]);
  }

  /// The level of one time and another behind it.
  static Level joined(const Level& a, const Level& b) noexcept {
    Level to;
    to.time = a.time + b.time;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        for (int k = 0; k < 5; ++k) to.transition[i][j] += b.transition[i][k] * a.transition[k][j];
    std::size_t m = 0;
    for (std::size_t c = 0; c < 5; ++c) {
      for (std::size_t d = c; d < 5; ++d, ++m) {
        // what the second part makes of y_c y_d
        RowSum second;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 5; ++i) {
          for (std::size_t j = i; j < 5; ++j, ++k) {
            const Scalar share =
                c == d ? a.transition[i][c] * a.transition[j][c]
                       : a.transition[i][c] * a.transition[j][d] + a.transition[i][d] * a.transition[j][c];
            if (share == 0) continue;  // the transition is block triangular
            second.add(share, b.row[k]);
          }
        }
        to.row[m] = a.row[m];
        join(to.row[m], a.turned, b, second.row());
      }
    }
    to.turned = a.turned * b.turned;
    to.one = a.one + a.turned * b.one;
    to.two = a.two + b.time * a.one + a.turned * b.two;
    to.ramp = a.ramp + a.turned * (b.ramp + a.time * b.one);
    to.ramp_2 = a.ramp_2 + b.time * a.ramp + a.turned * (b.ramp_2 + a.time * b.two);
    to.plain = a.plain * b.plain;
    to.plain_1 = a.plain_1 + a.plain * b.plain_1;
    to.plain_2 = a.plain_2 + b.time * a.plain_1 + a.plain * b.plain_2;
    return to;
  }

  Scalar r0_ = 0, kappa1_ = 0, kappa2_ = 0, rate_ = 1, tilt_ = 1, skew_ = 0, drift_ = 0, first_ = 1, span_ = 0;
  Complex mu_;
  Vector start_{};
  int levels_ = 0;
  bool fits_ = false;
  std::array<Level, level_cap> level_;
};

}  // namespace detail

/// The linear motion with its second-order corrections. r, theta, v3 and x3 err by the fourth power of the tilt instead of the
/// second; G by the fifth instead of the third, but for e_H times the error of the tilt; v and x by the third where a transverse force
/// acts. p and q are the linear ones, whose errors are of third order, and so are those of psi and phi; but the part of the tilt that stands
/// still in space does so for long: theirs do not grow with the turns of a symmetric body.
///
/// The integrals are built up by doubling their time (TiltIntegrals), at the same cost near resonance, with unstable and with no
/// spin. Construction: some 20 us for a span of 1000 rad; then about 1 us a time. No heap; the object takes some 70 kB.
template <Real Scalar>
class SecondOrder {
 public:
  /// For times in [0, span], span > 0.
  SecondOrder(const Problem<Scalar>& problem, Scalar span) noexcept
      : linear_(problem), integrals_(problem, span), span_(span) {
    const auto& a = problem.angles;
    const Quat<Scalar> q = quaternion_from_312(a.psi, a.phi, a.theta);
    Vec3<Scalar> H = problem.inertia.cwiseProduct(problem.angular_velocity);
    H[2] += problem.gyroscopic();
    const Vec3<Scalar> kept = rotate<Scalar>(q, H);
    kept_ = {kept[0], kept[1]};
    if (span > 0) {
      const detail::TiltModes<Scalar> modes(problem, LinearStart<Scalar>(problem));
      still_ = detail::StillTilt<Scalar>(modes, amplitudes(problem, span), span).still;
    }
    heading_ = math::unit(a.theta + a.psi * a.phi / 2);
    plain_heading_ = math::unit(a.theta);
  }

  /// No torque about axis 3, and no more turns than the integrals hold.
  bool applies() const noexcept { return linear_.applies() && integrals_.fits(); }

  const Linear<Scalar>& linear() const noexcept { return linear_; }

  /// What nutation and the change of the spin rate add to the spin angle at t, rad.
  Scalar phase(Scalar t) const noexcept { return integrals_.at(t).phase() + integrals_.drift() * t; }

  /// The corrections make the motion better: they turn the body by at most half a radian, and tilt stays below 0.3 rad.
  bool helps() const noexcept {
    return applies() && std::abs(phase(span_)) <= Scalar(0.5L) && std::abs(phase(span_ / 2)) <= Scalar(0.5L) &&
           amplitudes(linear_.problem(), span_).tilt <= Scalar(0.3L);
  }

  /// NaN outside [0, span].
  State<Scalar> at(Scalar t) const noexcept {
    const bool inside = t >= 0 && t <= span_ && integrals_.fits();
    State<Scalar> state = linear_.at(t);
    correct(t, integrals_.at(inside ? t : nan<Scalar>), state);
    return state;
  }

  /// Corrects states of the linear motion at first + i step, step > 0, all in [0, span], where the integrals fit: many at a fraction of at()'s cost.
  void correct(Scalar first, Scalar step, std::span<State<Scalar>> states) const noexcept {
    integrals_.along(first, step, states.size(),
                     [&](std::size_t i, const auto& now) { correct(first + Scalar(i) * step, now, states[i]); });
  }

 private:
  using Complex = math::Complex<Scalar>;
  using Integrals = detail::TiltIntegrals<Scalar>;

  /// What the angles psi + i phi exceed sin psi + i cos psi sin phi, the direction of axis 3 in space, by: third order.
  static Complex bend(Complex tilt) noexcept {
    const Scalar x2 = tilt.re * tilt.re;
    return {tilt.re * x2 / 6, tilt.im * (x2 / 2 + tilt.im * tilt.im / 6)};
  }

  /// The linear state at t, corrected.
  void correct(Scalar t, const typename Integrals::Totals& now, State<Scalar>& state) const noexcept {
    using math::conjugate;
    const Problem<Scalar>& p = linear_.problem();
    state.angular_velocity[2] = p.spin() + now.value[Integrals::rho];
    const auto& a = p.angles;
    auto& angles = state.angles;
    const Scalar added = integrals_.drift() * t + now.phase();
    const Complex back = math::unit(-added), turned_back = conjugate(now.plain) * (still_ * (back - Complex{1, 0}));
    const Complex tilt{angles.psi + turned_back.re, angles.phi + turned_back.im};
    const Complex bent = tilt + bend(tilt) - conjugate(now.plain) * (back * bend({a.psi, a.phi}));
    angles.psi = bent.re;
    angles.phi = bent.im;
    angles.theta = (p.spin() * t + a.theta) + (added - (angles.psi * angles.phi - a.psi * a.phi) / 2);
    state.attitude = quaternion_from_312(angles.psi, angles.phi, angles.theta);

    // int e^(iz) (1 - |Gamma|^2/4), int e^(iz) Gamma^2/4, and their integrals
    const Complex direct = heading_ * (now.impulse + now.pair(Integrals::direct));
    const Complex mirrored = heading_ * now.pair(Integrals::mirrored);
    const Complex M{p.torque[0], p.torque[1]};
    const Vec3<Scalar> axis = rotate<Scalar>(state.attitude, Vec3<Scalar>(0, 0, 1));
    const Complex G = kept_ + M * direct + conjugate(M) * mirrored + p.charge_momentum * Complex{axis[0], axis[1]};
    state.momentum_I[0] = G.re;
    state.momentum_I[1] = G.im;

    const Complex f{p.force[0] / p.mass, p.force[1] / p.mass};
    const Complex direct_2 = heading_ * (now.impulse_2 + now.pair(Integrals::direct_2));
    const Complex mirrored_2 = heading_ * now.pair(Integrals::mirrored_2);
    const Complex v = f * (direct - plain_heading_ * now.plain_1) + conjugate(f) * mirrored;
    const Complex x = f * (direct_2 - plain_heading_ * now.plain_2) + conjugate(f) * mirrored_2;
    const Scalar f3 = p.force[2] / p.mass;
    state.velocity += Vec3<Scalar>(v.re, v.im, -f3 * now.value[Integrals::cosine]);
    state.position += Vec3<Scalar>(x.re, x.im, -f3 * now.value[Integrals::cosine_2]);
  }

  Linear<Scalar> linear_;
  Integrals integrals_;
  Scalar span_;
  Complex kept_;                     ///< R (D1 p, D2 q, D3 r + Lambda) at t = 0, transverse, N m s
  Complex still_{};                  ///< the tilt that stands still in space, where it is turned back (StillTilt)
  Complex heading_, plain_heading_;  ///< e^(i (theta0 + psi0 phi0/2)), e^(i theta0)
};

/// The third order of the tilt, rad, where it is known: bounds over [0, T] of what the linear motion leaves out of the direction of axis 3 in space and of
/// that of space in the body, and of what SecondOrder leaves out of the angles, but for what the change of the spin rate makes of the nutation.
template <Real Scalar>
struct ThirdOrder {
  Scalar in_space = infinity<Scalar>, in_body = infinity<Scalar>, second = infinity<Scalar>;
};

/// Estimated greatest errors of SecondOrder over [0, T], made as those of the linear motion are, whose errors of the rates they take over.
/// That of the tilt is a bound for a symmetric body, or what is known of it, times 1.25, the others none, but wide. T > 0.
template <Real Scalar>
LinearErrors<Scalar> second_order_errors(const Problem<Scalar>& problem, Scalar T, Look look = Look::close,
                                         const ThirdOrder<Scalar>& known = {}) noexcept {
  LinearErrors<Scalar> first = linear_errors(problem, T, look);
  const LinearStart<Scalar> start(problem);
  const auto& D = problem.inertia;
  const Scalar r0 = std::abs(problem.spin());
  const Scalar g = first.size.tilt + first.tilt, P = first.size.rate + first.rates;
  const detail::SpinChange<Scalar> rho(problem, start, first.size.rate, T);

  const Scalar swing = g <= Scalar(small_tilt) ? detail::third_order_swing(problem, T) : T;
  const detail::TiltModes<Scalar> modes(problem, start);
  const detail::StillTilt<Scalar> turned_back(modes, first.size, T);
  const Scalar wider = g / first.size.tilt;
  const Scalar third = Scalar(1.25L) * std::min(turned_back.left * wider * wider * wider, known.second);
  const Scalar apart = third + g * rho.rate * swing;
  const Scalar of_spin_rate = first.of_rates + g * rho.rate * swing;
  first.in_space.lower(OverTime<Scalar>::roughly(T * (Scalar(1.25L) * known.in_space + of_spin_rate), T));
  first.in_body.lower(OverTime<Scalar>::roughly(T * (Scalar(1.25L) * known.in_body + of_spin_rate), T));

  LinearErrors<Scalar> error = first;
  error.of_spin_rate = of_spin_rate;
  detail::lower(error.tilt, apart + first.of_rates);
  const Scalar skewness = std::abs(D[0] - D[1]) / D[2];
  error.spin = skewness * P * first.rates * T;
  Scalar turning = P * error.tilt + g * first.rates;  // of the rate of the spin angle, twice
  if (modes.stable) {
    // the phase of nutation does not count in the mean, but what its frequency and the modes' sizes are off by
    const Scalar nu = std::sqrt(problem.nutation_squared()), once = std::min(T, 1 / nu);
    const Scalar answer = std::min(T, 2 / divisors(problem).least());
    detail::lower(error.spin, 2 * skewness * P * first.rates * once);
    detail::lower(turning, P * (apart + first.shift * (P * once + g) * answer) + g * P * first.shift * once);
  }
  const Scalar bent = std::min(first.tilt, Scalar(1.25L) * known.in_body + of_spin_rate);
  error.theta = (error.spin * T / 2 + (turning + g * g * g * P) * T / 2 + g * bent + g * g * g * g) / 4;
  error.tilt += g * error.theta;
  error.attitude = std::hypot(error.theta, error.tilt);

  // the phase of the turning frame: its error, and what its square leaves
  const detail::NutationPhase<Scalar> nutation(modes, first.size, T);
  const Scalar phase = rho.angle + nutation.net, left = error.theta + (phase * phase + g * g * phase) / 2;
  const Scalar rate = error.spin + (P * first.tilt + g * first.rates) / 2 + (phase + g * g) * (rho.rate + g * P / 2);
  // by parts, but for the product of the constant mode and what stands still: that adds up (1/4 of it, and 1/2 mirrored),
  // and what its phase has grown to counts half in the mean
  Scalar still = g * g;
  detail::lower(still, modes.tilted[0] * modes.tilted[1]);
  const Scalar adds_up = Scalar(0.375L) * still * phase * T;
  const Scalar turned = std::min(T * left, (left + swing * rate) / r0 + adds_up) + g * g * g * g * T / 8;
  const Scalar f = magnitude(start.acceleration), f3 = std::abs(start.axial_acceleration);
  const Scalar M = magnitude(start.torque), e = std::abs(start.charge_momentum);
  error.momentum = M * turned + e * (error.tilt + g * error.theta);
  error.axial_momentum = M * first.in_body.once + e * g * error.tilt;
  using Integral = OverTime<Scalar>;
  const Integral across = Integral::roughly(f * turned, T) + f3 * first.in_space;
  const Integral along =
      Integral::roughly(f3 * (swing * g * first.tilt + T * g * g * g * g) / 4, T) + f * first.in_body;
  error.velocity = across.once;
  error.axial_velocity = along.once;
  error.position = across.twice;
  error.axial_position = along.twice;
  return error;
}

}  // namespace gyrostat::spinning
