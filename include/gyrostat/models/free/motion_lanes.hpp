// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/many.hpp"
#include "gyrostat/models/free/frame_lanes.hpp"
#include "gyrostat/models/free/kind.hpp"
#include "gyrostat/models/free/motion.hpp"
#include "gyrostat/models/free/problem.hpp"

namespace gyrostat::free {

/// Motion<double>, set up in double, of eight bodies side by side. Only where the motion is tame: two components or one, the sums of its
/// theta functions in trigonometric form, kp2 not small and k2 not tiny, moments apart, and which of the two it is beyond rounding. What is not is
/// left out, for Motion<double> to do. A lane comes to the same bits whatever stands beside it.
class MotionLanes {
 public:
  static constexpr int size = 8;
  using Row = double[size];
  using Many = math::Many;
  using Choice = math::Choice;

  /// States of the eight bodies, each at a time of its own; body axes, inertial axes as in Motion::at.
  struct States {
    alignas(64) Row angular_velocity[3];
    alignas(64) Row angular_momentum[3];
    alignas(64) Row attitude[4];  ///< w, x, y, z

    State<double> lane(int b) const noexcept {
      State<double> s;
      for (int i = 0; i < 3; ++i)
        s.angular_velocity[i] = angular_velocity[i][b], s.angular_momentum[i] = angular_momentum[i][b];
      s.attitude = {attitude[0][b], attitude[1][b], attitude[2][b], attitude[3][b]};
      return s;
    }

    /// The squares of the distances of each lane to that of others, or to one state, where they are greater than what is there: rates, momentum, attitude.
    void widen(const States& from, Row (&far)[3]) const noexcept;
    void widen(const State<double>& from, Row (&far)[3]) const noexcept;

    /// Takes a lane of others for one of these.
    void take(int to, const States& from, int lane) noexcept {
      for (int i = 0; i < 3; ++i) {
        angular_velocity[i][to] = from.angular_velocity[i][lane];
        angular_momentum[i][to] = from.angular_momentum[i][lane];
      }
      for (int i = 0; i < 4; ++i) attitude[i][to] = from.attitude[i][lane];
    }

   private:
    void squares(int first, const Many (&w)[3], const Many (&m)[3], const Many (&a)[4],
                 Many (&square)[3]) const noexcept;
  };

  /// Nothing is known of any lane until set.
  MotionLanes() = default;

  /// The body of the lanes first to last - 1; attitude: of the body axes, unit.
  void set(int first, int last, const PrincipalProblem<double>& body, const Quat<double>& attitude) noexcept {
    const auto put = [first, last](Row& row, double value) { std::fill(row + first, row + last, value); };
    for (int i = 0; i < 3; ++i) {
      put(moments_[i], body.moments[i]);
      put(l_[i], body.l[i]), put(G_[i], body.G[i]), put(M_[i], body.M[i]);
      for (int j = 0; j < 3; ++j) put(R_BP_[i][j], body.R_BP(i, j));
    }
    const Quat<double> c = conjugate(from_matrix(body.R_BP));
    const double from_body[4] = {c.w, c.x, c.y, c.z}, start[4] = {attitude.w, attitude.x, attitude.y, attitude.z};
    for (int i = 0; i < 4; ++i) put(c_[i], from_body[i]), put(start_attitude_[i], start[i]);
  }

  /// Sets all up. A bit, 2^b, for each lane whose motion is tame; what is told of the others means nothing.
  unsigned make() noexcept {
    tame_ = 0;
    for (int first = 0; first < size; first += Many::size) tame_ |= make(first) << first;
    return tame_;
  }
  bool tame(int b) const noexcept { return tame_ >> b & 1; }

  /// Of each lane at its own time.
  States at(const Row& t) const noexcept {
    States s;
    for (int first = 0; first < size; first += Many::size) at(first, Many::from(t + first), s);
    return s;
  }

  /// The same motion in all lanes; nothing where it is not tame.
  static std::optional<MotionLanes> of(const Motion<double>& motion) noexcept;
  /// The motion of a tame lane in all lanes, for at and look alone.
  MotionLanes spread(int b) const noexcept;

  /// States, and what Motion tells of them: cancellation, rate_terms, and what defect is without the start, not over `fastest`.
  struct Looks {
    States states;
    alignas(64) Row cancellation, rate_terms, defect;

    /// The greatest of eight times of one motion: |omega|, rad/s; |M x omega|, N m; |J^-1 (M x omega)|, rad/s^2; |omega - pace M|, rad/s; and of the
    /// rows above.
    struct Extent {
      double angular_velocity, flow, acceleration, relative, cancellation, rate_terms, defect;
    };
    Extent extent(const Mat3<double>& inverse_inertia, double pace) const noexcept;
  };
  Looks look(const Row& t) const noexcept {
    Looks seen;
    for (int first = 0; first < size; first += Many::size) look(first, Many::from(t + first), seen);
    return seen;
  }

  /// As those of Motion.
  Kind kind(int b) const noexcept {
    return side_[b] == 0 ? Kind::one_component : side_[b] > 0 ? Kind::about_largest : Kind::about_smallest;
  }
  const Row& period() const noexcept { return period_; }
  const Row& turn_per_period() const noexcept { return turn_; }
  const Row& modulus_squared() const noexcept { return k2_; }
  double phase_rate(int b) const noexcept { return 2 * pi<double> * phase_rate_[b]; }
  const Row& energy() const noexcept { return energy_; }
  const Row& angular_momentum_norm() const noexcept { return norm_; }

 private:
  static constexpr int powers = 8;  ///< of E, enough for every nome below exp(-pi)

  // compiled once each, so that all callers get the same bits
  GYROSTAT_NOINLINE inline unsigned make(int first) noexcept;
  GYROSTAT_NOINLINE inline void at(int first, const Many& t, States& to) const noexcept;
  GYROSTAT_NOINLINE inline void look(int first, const Many& t, Looks& to) const noexcept;

  struct C {
    Many re, im;
    GYROSTAT_INLINE friend C operator+(const C& a, const C& b) noexcept { return {a.re + b.re, a.im + b.im}; }
    GYROSTAT_INLINE friend C operator*(const C& a, const C& b) noexcept {
      return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
  };
  /// The sums of even and of odd powers of E, the latter times -i, and their slopes by the angle of E.
  struct Sums {
    C even, odd, even_slope, odd_slope;
  };
  template <bool slopes>
  Sums sums(int first, const math::ManyCircle& E) const noexcept;
  struct Spinor {
    C up, down;
  };
  /// That of the attitude before its phase and its start.
  Spinor spinor(int first, const C& a, const C& b) const noexcept;
  void to_body(int first, Many (&v)[3]) const noexcept;
  /// omega, M and attitude of sums and the phase of the spinor.
  void assemble(int first, const C& a, const C& b, const C& phase, States& to) const noexcept;

  /// The sums of even and of odd powers at E = 1, and their slopes.
  struct AtOne {
    Many even, odd, even_slope, odd_slope;
  };
  AtOne set_sums(int first, const detail::FrameLanes& frame) noexcept;
  void set_forms(int first, const detail::PencilLanes& pencil, const detail::FrameLanes& frame) noexcept;

  /// t rate + start less the nearest whole number.
  static Many fraction(const Many& rate, const Many& t, const Many& start) noexcept {
    const Many p = t * rate, rest = math::rounding_of(p, t, rate), n = math::nearest(p + start);
    const Many part = p - n, sum = part + start, back = sum - part;
    const Many low = ((part - (sum - back)) + (start - back)) + rest;
    return (sum - math::nearest(sum + low)) + low;
  }

  unsigned tame_ = 0;
  alignas(64) Row moments_[3], l_[3], G_[3], M_[3], R_BP_[3][3], c_[4], start_attitude_[4];
  alignas(64) Row side_, period_, turn_, k2_, energy_, norm_;
  alignas(64) Row rate_, start_, phase_rate_;      // turns of the argument a second, at time 0; of the spinor's phase
  alignas(64) Row x_[powers + 1], y_[powers + 1];  // of even powers (x + i y), of odd ones times -i
  alignas(64) Row forms_[4][7];                    // size, omega, M, in principal axes, by the products of the two sums
  alignas(64) Row spinor_[2][2][2];
  alignas(64) Row lay_[4];
};

unsigned MotionLanes::make(int first) noexcept {
  const auto row = [first](const Row& r) { return Many::from(r + first); };
  detail::ManyBodies body;
  for (int i = 0; i < 3; ++i)
    body.moments[i] = row(moments_[i]), body.l[i] = row(l_[i]), body.G[i] = row(G_[i]), body.M[i] = row(M_[i]);
  const detail::PencilLanes pencil(body);
  const detail::FrameLanes frame(pencil);
  const Many K = frame.integrals.K, R = pencil.R;
  const AtOne one = set_sums(first, frame);
  set_forms(first, pencil, frame);

  // Motion::set_regular
  const Many u_rate = frame.rate * R, window = 4 * K;
  const Many rate = u_rate / window, h = 0.5 * pi<double> / K;
  const Many even_psi = math::choose(frame.single, frame.psi[1], frame.psi[0]),
             odd_psi = math::choose(frame.single, frame.psi[0], frame.psi[1]);
  const Choice by_even = math::abs(one.odd) < math::abs(one.even);
  const Many psi = math::choose(by_even, even_psi, odd_psi);
  const Many turning = h * math::choose(by_even, one.even_slope / one.even, one.odd_slope / one.odd);
  const Many phase_rate = R * (psi - frame.rate * turning) * (0.5 / pi<double>);
  const Many period = window / u_rate, turns = 2 * (phase_rate * period);
  rate.to(rate_ + first);
  frame.start.to(start_ + first);
  phase_rate.to(phase_rate_ + first);
  period.to(period_ + first);
  (2 * pi<double> * (turns - math::nearest(turns))).to(turn_ + first);
  frame.k2.to(k2_ + first);
  R.to(norm_ + first);
  math::choose(frame.single, 0., frame.side).to(side_ + first);
  Many twice = 0;
  for (int i = 0; i < 3; ++i) twice += body.G[i] * body.G[i] * pencil.a[i];
  (0.5 * twice).to(energy_ + first);

  // the attitude at time 0 is the given one
  const Sums start = sums<false>(first, math::circle(frame.start));
  const auto [up, down] = spinor(first, start.even, start.odd);
  const Many length = math::inverse_sqrt(up.re * up.re + up.im * up.im + down.re * down.re + down.im * down.im);
  const Many p[4] = {length * up.re, length * down.im, -length * down.re, length * up.im};
  Many q[4];
  for (int i = 0; i < 4; ++i) q[i] = row(start_attitude_[i]);
  (q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3]).to(lay_[0] + first);
  (q[1] * p[0] - q[0] * p[1] - q[2] * p[3] + q[3] * p[2]).to(lay_[1] + first);
  (q[2] * p[0] - q[0] * p[2] - q[3] * p[1] + q[1] * p[3]).to(lay_[2] + first);
  (q[3] * p[0] - q[0] * p[3] - q[1] * p[2] + q[2] * p[1]).to(lay_[3] + first);
  const Many sum = rate + phase_rate + row(lay_[0]) + row(lay_[1]) + row(lay_[2]) + row(lay_[3]) + frame.start;
  return (frame.sound & (math::abs(sum) < 1e200) & (R > 1e-100) & (R < 1e100)).bits();
}

/// ThetaPair::trigonometric_sums, with the coefficients as products of powers of two exponentials.
inline MotionLanes::AtOne MotionLanes::set_sums(int first, const detail::FrameLanes& f) noexcept {
  const Many unit = -0.25 * pi<double> / f.integrals.K, eta = f.integrals.Fp;
  const Many A = math::exp(math::max(unit * (f.integrals.Kp - eta), -600.)),
             B = math::exp(math::max(unit * eta, -600.));
  const Many A2 = A * A, B2 = B * B, one = 1.;
  AtOne sum{1., 0., 0., 0.};
  Many x[powers + 1], y[powers + 1];
  x[0] = 1, y[0] = 0;
  // two components: A^(2 m^2) B^(2 (m^2 +- m)); one: A^(m^2) B^(m^2 +- 2 m), over A and times B where m is odd
  Many rest = 1, rest_step = math::choose(f.single, A, A2);  // A^.. m^2, and its step
  Many more = 1, less = 1;                                   // B^..
  const Many A_twice = rest_step * rest_step, B_unit = math::choose(f.single, B, B2);
  Many up_step = math::choose(f.single, B * B2, B2 * B2), down_step = math::choose(f.single, 1 / B, one);
  const Many B_twice = B_unit * B_unit, odd_factor = math::choose(f.single, B / A, one);
  for (int m = 1; m <= powers; ++m) {
    rest *= rest_step, rest_step *= A_twice;
    more *= up_step, up_step *= B_twice;
    less *= down_step, down_step *= B_twice;
    const Many factor = m % 2 ? rest * odd_factor : rest, up = factor * more, down = factor * less;
    const double sign = m / 2 % 2 ? -1 : 1;
    const Many along = f.delta * (up - down), both = up + down;
    if (m % 2) {
      x[m] = sign * along, y[m] = sign * both;
      sum.odd += x[m], sum.odd_slope += m * y[m];
    } else {
      const Many s = math::choose(f.single, 1., sign);
      x[m] = s * both, y[m] = s * along;
      sum.even += x[m], sum.even_slope += m * y[m];
    }
  }
  // A and B of ThetaPair::scale
  const Many odd = math::choose(f.single, math::sqrt(f.size[0]) / math::abs(sum.odd), 1.),
             even = math::choose(f.single, math::sqrt(f.size[1]) / math::abs(sum.even), 1.);
  for (int m = 0; m <= powers; ++m) {
    (x[m] * (m % 2 ? odd : even)).to(x_[m] + first);
    (y[m] * (m % 2 ? odd : even)).to(y_[m] + first);
  }
  return {sum.even * even, sum.odd * odd, sum.even_slope * even, sum.odd_slope * odd};
}

inline void MotionLanes::set_forms(int first, const detail::PencilLanes& pencil, const detail::FrameLanes& f) noexcept {
  using detail::Many4;
  const auto row = [first](const Row& r) { return Many::from(r + first); };
  const Many R = pencil.R;
  const Many4* basis[4] = {&f.plus, &f.minus, &f.xa, &f.xb};
  Many momentum[4][4], form[4][7];
  for (int k = 0; k < 4; ++k) {
    const Many4& x = *basis[k];
    const Many factor = k < 2 ? 1 : 2, scale = factor * R;
    for (int i = 0; i < 3; ++i) {
      momentum[k][i] = x.x[i] + pencil.d[i] * x.x[3];
      form[k][1 + i] = scale * (pencil.a[i] * x.x[i] - pencil.b[i] * x.x[3]);
      form[k][4 + i] = scale * momentum[k][i];
    }
    momentum[k][3] = x.x[3];
    form[k][0] = factor * x.x[3];
  }
  // of one component the odd sum is the first: its square and the even one's change places, and the area its sign
  for (int n = 0; n < 7; ++n) {
    math::choose(f.single, form[1][n], form[0][n]).to(forms_[0][n] + first);
    math::choose(f.single, form[0][n], form[1][n]).to(forms_[1][n] + first);
    form[2][n].to(forms_[2][n] + first);
    math::choose(f.single, -form[3][n], form[3][n]).to(forms_[3][n] + first);
  }
  const auto conj = [](const C& a) { return C{a.re, -a.im}; };
  const Many *N = momentum[0], *a = momentum[2], *b = momentum[3];
  const Many root = math::sqrt(0.5 * (N[3] + math::abs(N[2]))), across = 0.5 / root;
  const Choice north = N[2] > 0.;
  const C o[2] = {{math::choose(north, root, N[0] * across), math::choose(north, 0., -N[1] * across)},
                  {math::choose(north, N[0] * across, root), math::choose(north, N[1] * across, 0.)}};
  const C H[2][2] = {{{0.5 * (a[3] + a[2]), 0.5 * (b[3] + b[2])}, {0.5 * (a[0] + b[1]), 0.5 * (b[0] - a[1])}},
                     {{0.5 * (a[0] - b[1]), 0.5 * (a[1] + b[0])}, {0.5 * (a[3] - a[2]), 0.5 * (b[3] - b[2])}}};
  const Many inverse = 1 / (o[0].re * o[0].re + o[0].im * o[0].im + o[1].re * o[1].re + o[1].im * o[1].im);
  C iota[2];
  for (int j = 0; j < 2; ++j) {
    const C sum = conj(o[0]) * H[0][j] + conj(o[1]) * H[1][j];
    iota[j] = {inverse * sum.re, -inverse * sum.im};
  }
  const Many cw = row(c_[0]), cx = row(c_[1]), cy = row(c_[2]), cz = row(c_[3]);
  const C U[2][2] = {{{cw, cz}, {cy, cx}}, {{-cy, cx}, {cw, -cz}}};
  for (int i = 0; i < 2; ++i) {
    const C one = U[i][0] * o[0] + U[i][1] * o[1], two = U[i][0] * iota[0] + U[i][1] * iota[1];
    math::choose(f.single, two.re, one.re).to(spinor_[i][0][0] + first);
    math::choose(f.single, two.im, one.im).to(spinor_[i][0][1] + first);
    math::choose(f.single, one.re, two.re).to(spinor_[i][1][0] + first);
    math::choose(f.single, one.im, two.im).to(spinor_[i][1][1] + first);
  }
}

template <bool slopes>
GYROSTAT_INLINE MotionLanes::Sums MotionLanes::sums(int first, const math::ManyCircle& E) const noexcept {
  const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
  C power[powers + 1];
  power[1] = {E.c, E.s};
  C sum[2] = {{row(x_[0]), 0.}, {0., 0.}}, slope[2] = {{0., 0.}, {0., 0.}};  // of even and of odd powers
  for (int m = 1; m <= powers; ++m) {
    if (m > 1) power[m] = power[m / 2] * power[m - m / 2];
    const Many re = power[m].re, im = power[m].im, x = row(x_[m]), y = row(y_[m]), n = double(m);
    sum[m % 2] = sum[m % 2] + C{x * re, y * im};
    if constexpr (slopes) slope[m % 2] = slope[m % 2] + C{-n * x * im, n * y * re};
  }
  return {sum[0], {sum[1].im, -sum[1].re}, slope[0], {slope[1].im, -slope[1].re}};
}

GYROSTAT_INLINE MotionLanes::Spinor MotionLanes::spinor(int first, const C& a, const C& b) const noexcept {
  const auto c = [&](int i, int j) GYROSTAT_INLINE_LAMBDA {
    return C{Many::from(spinor_[i][j][0] + first), Many::from(spinor_[i][j][1] + first)};
  };
  return {c(0, 0) * a + c(0, 1) * b, c(1, 0) * a + c(1, 1) * b};
}

GYROSTAT_INLINE void MotionLanes::to_body(int first, Many (&v)[3]) const noexcept {
  const Many x = v[0], y = v[1], z = v[2];
  for (int i = 0; i < 3; ++i)
    v[i] =
        Many::from(R_BP_[i][0] + first) * x + Many::from(R_BP_[i][1] + first) * y + Many::from(R_BP_[i][2] + first) * z;
}

GYROSTAT_INLINE void MotionLanes::assemble(int first, const C& a, const C& b, const C& phase,
                                           States& to) const noexcept {
  const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
  const Many f[4] = {a.re * a.re + a.im * a.im, b.re * b.re + b.im * b.im, a.re * b.re + a.im * b.im,
                     a.re * b.im - a.im * b.re};
  const auto form = [&](int n) GYROSTAT_INLINE_LAMBDA {
    return row(forms_[0][n]) * f[0] + row(forms_[1][n]) * f[1] + row(forms_[2][n]) * f[2] + row(forms_[3][n]) * f[3];
  };
  const Many inverse = 1 / form(0);
  Many omega[3], M[3];
  for (int i = 0; i < 3; ++i) omega[i] = form(1 + i) * inverse, M[i] = form(4 + i) * inverse;
  to_body(first, omega);
  to_body(first, M);
  for (int i = 0; i < 3; ++i) omega[i].to(to.angular_velocity[i] + first), M[i].to(to.angular_momentum[i] + first);
  const auto [one, two] = spinor(first, a, b);
  const C up = one * phase, down = two * phase;
  const Many w = up.re, x = down.im, y = -down.re, z = up.im;
  const Many length = math::inverse_sqrt(w * w + x * x + y * y + z * z);
  const Many lw = row(lay_[0]), lx = row(lay_[1]), ly = row(lay_[2]), lz = row(lay_[3]);
  (length * (lw * w - lx * x - ly * y - lz * z)).to(to.attitude[0] + first);
  (length * (lw * x + lx * w + ly * z - lz * y)).to(to.attitude[1] + first);
  (length * (lw * y - lx * z + ly * w + lz * x)).to(to.attitude[2] + first);
  (length * (lw * z + lx * y - ly * x + lz * w)).to(to.attitude[3] + first);
}

/// Squares of how far states are from others: rates, momentum, and twice the vector part of a^-1 b of the attitudes.
GYROSTAT_INLINE void MotionLanes::States::squares(int first, const Many (&w)[3], const Many (&m)[3], const Many (&a)[4],
                                                  Many (&square)[3]) const noexcept {
  const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
  square[0] = square[1] = 0;
  for (int i = 0; i < 3; ++i) {
    const Many v = row(angular_velocity[i]) - w[i], n = row(angular_momentum[i]) - m[i];
    square[0] += v * v, square[1] += n * n;
  }
  const Many b[4] = {row(attitude[0]), row(attitude[1]), row(attitude[2]), row(attitude[3])};
  const Many p = a[0] * b[1] - a[1] * b[0] - a[2] * b[3] + a[3] * b[2],
             q = a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1],
             r = a[0] * b[3] - a[1] * b[2] + a[2] * b[1] - a[3] * b[0];
  square[2] = 4 * (p * p + q * q + r * r);
}

inline void MotionLanes::States::widen(const State<double>& from, Row (&far)[3]) const noexcept {
  const Vec3<double>&w = from.angular_velocity, &m = from.angular_momentum;
  const Quat<double>& q = from.attitude;
  for (int first = 0; first < size; first += Many::size) {
    Many square[3];
    squares(first, {w[0], w[1], w[2]}, {m[0], m[1], m[2]}, {q.w, q.x, q.y, q.z}, square);
    for (int n = 0; n < 3; ++n) math::max(square[n], Many::from(far[n] + first)).to(far[n] + first);
  }
}

inline void MotionLanes::States::widen(const States& from, Row (&far)[3]) const noexcept {
  for (int first = 0; first < size; first += Many::size) {
    const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
    const auto &w = from.angular_velocity, &m = from.angular_momentum;
    const auto& q = from.attitude;
    Many square[3];
    squares(first, {row(w[0]), row(w[1]), row(w[2])}, {row(m[0]), row(m[1]), row(m[2])},
            {row(q[0]), row(q[1]), row(q[2]), row(q[3])}, square);
    for (int n = 0; n < 3; ++n) math::max(square[n], row(far[n])).to(far[n] + first);
  }
}

void MotionLanes::at(int first, const Many& t, States& to) const noexcept {
  const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
  const auto phase = math::circle(fraction(row(phase_rate_), t, 0.));
  const Sums s = sums<false>(first, math::circle(fraction(row(rate_), t, row(start_))));
  assemble(first, s.even, s.odd, {phase.c, phase.s}, to);
}

void MotionLanes::look(int first, const Many& t, Looks& to) const noexcept {
  const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
  const auto phase = math::circle(fraction(row(phase_rate_), t, 0.));
  const Sums s = sums<true>(first, math::circle(fraction(row(rate_), t, row(start_))));
  const C &a = s.even, &b = s.odd, &da = s.even_slope, &db = s.odd_slope;
  assemble(first, a, b, {phase.c, phase.s}, to.states);

  const auto dot = [](const C& x, const C& y) GYROSTAT_INLINE_LAMBDA { return x.re * y.re + x.im * y.im; };
  const auto area = [](const C& x, const C& y) GYROSTAT_INLINE_LAMBDA { return x.re * y.im - x.im * y.re; };
  const Many f[4] = {dot(a, a), dot(b, b), dot(a, b), area(a, b)};
  const Many df[4] = {2 * dot(a, da), 2 * dot(b, db), dot(da, b) + dot(a, db), area(da, b) + area(a, db)};
  Many whole = 0, parts = 0, growth = 0;
  for (int j = 0; j < 4; ++j) {
    const Many factor = row(forms_[j][0]);
    whole += factor * f[j], parts += math::abs(factor * f[j]), growth += factor * df[j];
  }
  const Many inverse = 1 / whole, pace = 2 * pi<double> * row(rate_);
  (parts * math::abs(inverse)).to(to.cancellation + first);
  const Many product = math::sqrt(f[0] * f[1]), sizes[4] = {f[0], f[1], product, product};
  Many omega[3], M[3], change[3], terms = 0;
  for (int i = 0; i < 3; ++i) {
    omega[i] = row(to.states.angular_velocity[i]), M[i] = row(to.states.angular_momentum[i]);
    Many sum = 0, slope = 0;
    for (int j = 0; j < 4; ++j)
      sum += math::abs(row(forms_[j][1 + i])) * sizes[j], slope += row(forms_[j][4 + i]) * df[j];
    terms += sum * sum;
    change[i] = slope;
  }
  to_body(first, change);
  for (int i = 0; i < 3; ++i) change[i] = pace * (change[i] - M[i] * growth) * inverse;
  (math::sqrt(terms) * math::abs(inverse)).to(to.rate_terms + first);

  const C kappa{0., row(phase_rate_) / row(rate_)};
  const auto [up, down] = spinor(first, a, b);
  const auto [up_slope, down_slope] = spinor(first, da, db);
  const C dup = up_slope + kappa * up, ddown = down_slope + kappa * down;
  const Many v[3] = {down.im, -down.re, up.im}, dv[3] = {ddown.im, -ddown.re, dup.im};
  const Many turn = 2 * pace / (up.re * up.re + v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), per_R = 1 / row(norm_);
  Many of_momentum = 0, of_attitude = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Many flow = (change[i] - (M[j] * omega[k] - M[k] * omega[j])) * per_R;
    const Many turning = turn * (up.re * dv[i] - dup.re * v[i] - (v[j] * dv[k] - v[k] * dv[j])) - omega[i];
    of_momentum += flow * flow, of_attitude += turning * turning;
  }
  math::sqrt(math::max(of_momentum, of_attitude)).to(to.defect + first);
}

inline MotionLanes::Looks::Extent MotionLanes::Looks::extent(const Mat3<double>& inverse, double pace) const noexcept {
  Many most[7] = {0., 0., 0., 0., 0., 0., 0.};
  for (int first = 0; first < size; first += Many::size) {
    const auto row = [first](const Row& r) GYROSTAT_INLINE_LAMBDA { return Many::from(r + first); };
    const auto square = [](const Many(&v)[3])
                            GYROSTAT_INLINE_LAMBDA { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
    Many omega[3], M[3], flow[3], relative[3], turned[3];
    for (int i = 0; i < 3; ++i) omega[i] = row(states.angular_velocity[i]), M[i] = row(states.angular_momentum[i]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      flow[i] = M[j] * omega[k] - M[k] * omega[j];
      relative[i] = omega[i] - pace * M[i];
    }
    for (int i = 0; i < 3; ++i) turned[i] = inverse(i, 0) * flow[0] + inverse(i, 1) * flow[1] + inverse(i, 2) * flow[2];
    const Many seen[7] = {square(omega),     square(flow),    square(turned), square(relative),
                          row(cancellation), row(rate_terms), row(defect)};
    for (int n = 0; n < 7; ++n) most[n] = math::max(most[n], seen[n]);
  }
  double greatest[7] = {};
  for (int n = 0; n < 7; ++n)
    for (int i = 0; i < Many::size; ++i) greatest[n] = std::max(greatest[n], most[n][i]);
  return {std::sqrt(greatest[0]),
          std::sqrt(greatest[1]),
          std::sqrt(greatest[2]),
          std::sqrt(greatest[3]),
          greatest[4],
          greatest[5],
          greatest[6]};
}

inline MotionLanes MotionLanes::spread(int b) const noexcept {
  MotionLanes lanes;
  const auto put = [b](Row& to, const Row& from) {
    for (int first = 0; first < size; first += Many::size) Many(from[b]).to(to + first);
  };
  put(lanes.rate_, rate_), put(lanes.start_, start_), put(lanes.phase_rate_, phase_rate_), put(lanes.norm_, norm_);
  for (int m = 0; m <= powers; ++m) put(lanes.x_[m], x_[m]), put(lanes.y_[m], y_[m]);
  for (int k = 0; k < 4; ++k)
    for (int n = 0; n < 7; ++n) put(lanes.forms_[k][n], forms_[k][n]);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int part = 0; part < 2; ++part) put(lanes.spinor_[i][j][part], spinor_[i][j][part]);
  for (int i = 0; i < 4; ++i) put(lanes.lay_[i], lay_[i]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) put(lanes.R_BP_[i][j], R_BP_[i][j]);
  lanes.tame_ = (1u << size) - 1;
  return lanes;
}

inline std::optional<MotionLanes> MotionLanes::of(const Motion<double>& motion) noexcept {
  const auto& pair = motion.pair_;
  if (pair.hyperbolic || pair.powers > powers || motion.kind_ == Kind::steady || motion.precesses_) return std::nullopt;
  MotionLanes lanes;
  const auto put = [](Row& row, double value) { std::fill_n(row, size, value); };
  put(lanes.rate_, motion.rate_.high);
  put(lanes.start_, motion.start_.high);
  put(lanes.phase_rate_, motion.phase_rate_.high);
  put(lanes.norm_, motion.R_);
  for (int m = 0; m <= powers; ++m) put(lanes.x_[m], pair.x[m]), put(lanes.y_[m], pair.y[m]);
  for (int k = 0; k < 4; ++k) {
    const int from = pair.single && k < 2 ? 1 - k : k;
    const double sign = pair.single && k == 3 ? -1 : 1;
    put(lanes.forms_[k][0], sign * motion.size_[from]);
    for (int i = 0; i < 3; ++i) {
      put(lanes.forms_[k][1 + i], sign * motion.W_(i, from));
      put(lanes.forms_[k][4 + i], sign * motion.M_(i, from));
    }
  }
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const auto& c = motion.spinor_[i][pair.single ? 1 - j : j];
      put(lanes.spinor_[i][j][0], c.re), put(lanes.spinor_[i][j][1], c.im);
    }
  const double lay[4] = {motion.lay_.w, motion.lay_.x, motion.lay_.y, motion.lay_.z};
  for (int i = 0; i < 4; ++i) put(lanes.lay_[i], lay[i]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) put(lanes.R_BP_[i][j], i == j ? 1 : 0);
  lanes.tame_ = (1u << size) - 1;
  return lanes;
}

}  // namespace gyrostat::free
