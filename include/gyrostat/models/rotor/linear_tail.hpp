// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/models/rotor/gyrostat.hpp"
#include "gyrostat/models/rotor/modes.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::rotor {

/// Bounds of what the tail errs, in units of the state.
template <Real Scalar>
struct TailError {
  Scalar attitude = infinity<Scalar>;     ///< angle, rad
  Scalar momentum = infinity<Scalar>;     ///< of H, N m s
  Scalar rotor_rate = infinity<Scalar>;   ///< rad/s
  Scalar rotor_angle = infinity<Scalar>;  ///< rad

  constexpr TailError& operator+=(const TailError& by) noexcept {
    attitude += by.attitude, momentum += by.momentum, rotor_rate += by.rotor_rate, rotor_angle += by.rotor_angle;
    return *this;
  }
};

/// The motion near an asymptotically stable steady rotation to second order in the distance eps from it, in closed form: linear
/// modes, their products, and the phase about L with its drift. With y = (a, b, xi) of Linearisation,
///     y = y1 + y2,   y1' = A y1,   y2' = A y2 + Q(y1, y1),   y2(0) = 0,
///     P(t) = exp(psi [L/l]x) P0 R(m(0))^T R(m(t)),   dpsi/dt = psi_dot + (m + m0).q/(1 + m.m0),
/// R(m) the shortest turn from m to m0. Products of exponentials are integrated exactly. What is left out is of the third order: of the
/// size eps^3 |psi_dot|/rate in the attitude, where the linear solution alone errs by eps^2 |psi_dot|/rate (docs/rotor.md, section 6).
template <Real Scalar>
class LinearTail {
 public:
  /// From the state at t = 0 towards `steady`, with its stability. The momentum is not zero.
  LinearTail(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, const SteadyRotation<Scalar>& steady,
             const SteadyStability<Scalar>& stability) noexcept;

  /// eps: the length of (m - m0, xi) at the start; xi counts the rotor's share of the energy.
  Scalar distance() const noexcept { return distance_; }
  /// Of the slowest mode, 1/s.
  Scalar decay_rate() const noexcept { return -modes_.growth_rate(); }

  State<Scalar> at(Scalar t) const noexcept;

  /// Bounds for all times up to t >= 0: the misfit of the equations of motion along the tail, sampled, carried on by the modes;
  /// and rounding, of the data too. Infinite where eps is too large for the tail to have an estimate.
  TailError<Scalar> error(Scalar t) const noexcept;
  /// What errors of the start make at most of the state at any later time: of H, N m s, and of the rotor rate, rad/s. Errors of
  /// attitude and rotor angle are carried on as they are.
  TailError<Scalar> carried(Scalar momentum, Scalar rotor_rate) const noexcept;

 private:
  using Complex = math::Complex<Scalar>;
  using Vector = detail::Complex3<Scalar>;

  /// A product of two modes.
  struct Pair {
    Complex exponent;
    Complex turn;  // of dpsi/dt, once y has been integrated
    Vector modal;  // left Q
  };
  struct Point {
    Vec3<Scalar> first, second;  // y1, y2
    Scalar phase;                // psi - psi_dot t
  };

  /// Residuals of the tail in the equations of motion.
  struct Misfit {
    std::array<Scalar, 3> modal{};  // 1/s
    Scalar phase = 0;               // rad/s
    Scalar size = 0;                // of y
    bool small = false;
  };
  /// What the series leaves out.
  struct Truncation {
    Scalar phase = 0, tilt = 0, xi = 0, rate = 0;
    bool small = false;
  };

  Point point(Scalar t, bool with_phase) const noexcept;
  Misfit misfit(Scalar from, Scalar length) const noexcept;
  Truncation truncation(Scalar t) const noexcept;
  Vec3<Scalar> tilt(const Vec3<Scalar>& y) const noexcept { return y[0] * linear_.u + y[1] * linear_.v; }
  /// Bound of the curvature of dpsi/dt by y, 1/s.
  Scalar curve() const noexcept { return linear_.G.norm() + linear_.g.norm(); }

  Gyrostat<Scalar> gyrostat_;
  State<Scalar> start_;
  Linearisation<Scalar> linear_;
  Modes<Scalar> modes_;
  Scalar distance_;
  Scalar stiffness_;       // least of B on the tangent plane, 1/s
  Scalar separation_ = 0;  // relative change of S
  Scalar spin_by_norm_;    // dpsi_dot/dl, 1/(kg m^2)
  Scalar xi_0_;
  Vec3<Scalar> y0_;
  std::array<Complex, 3> amplitude_;
  std::array<Pair, 6> pairs_;
  Vec3<Scalar> turn_;          // linear part of dpsi/dt times A^-1
  Vec3<Scalar> normal_force_;  // of the part of d along m0 on y
  Quat<Scalar> base_;          // P0 R(m(0))^T
  Vec3<Scalar> axis_I_;
};

namespace detail {

/// The shortest turn from a to b, unit vectors.
template <Real Scalar>
Quat<Scalar> shortest_turn(const Vec3<Scalar>& a, const Vec3<Scalar>& b) noexcept {
  const Vec3<Scalar> c = cross<Scalar>(a, b);
  return normalised(Quat<Scalar>{1 + a.dot(b), c[0], c[1], c[2]});
}

}  // namespace detail

template <Real Scalar>
LinearTail<Scalar>::LinearTail(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start,
                               const SteadyRotation<Scalar>& steady, const SteadyStability<Scalar>& stability) noexcept
    : gyrostat_(gyrostat),
      start_(start),
      linear_(gyrostat, start.momentum.norm(), steady.direction.normalized(), gyrostat.no_load_rate()),
      modes_(linear_.matrix, {{{stability.eigenvalues[0].real(), stability.eigenvalues[0].imag()},
                               {stability.eigenvalues[1].real(), stability.eigenvalues[1].imag()},
                               {stability.eigenvalues[2].real(), stability.eigenvalues[2].imag()}}}) {
  const Scalar lambda = gyrostat.axial_inertia(), k = gyrostat.coupling();
  linear_.spin_rate = steady.spin_rate;
  if (!(modes_.condition() < Scalar(1e4L))) {
    // A double exponent: another motor, as near as its square root can resolve, has two.
    separation_ = std::sqrt(epsilon<Scalar>) / 64;
    const Scalar share = 1 - separation_;
    linear_.relaxation *= share;
    linear_.feed *= share;
    linear_.matrix.row(2) *= share;
    modes_ = Modes<Scalar>(linear_.matrix, linear_.exponents());
  }
  const Vec3<Scalar>& m = linear_.m;
  const Vec3<Scalar> direction = start.momentum / linear_.norm;
  const Scalar p = lambda * (k * gyrostat.no_load_rate() + linear_.norm * linear_.n.dot(m));
  xi_0_ = (start.axial_momentum - p) / (lambda * k * linear_.unit);
  y0_ = {linear_.u.dot(direction), linear_.v.dot(direction), xi_0_};
  distance_ = std::hypot((direction - m).norm(), xi_0_);
  axis_I_ = rotate(start.attitude, direction).normalized();
  base_ = start.attitude * conjugate(detail::shortest_turn(direction, m));

  const Vec3<Scalar> Ju = linear_.norm * (gyrostat.inverse_inertia() * linear_.u);
  const Vec3<Scalar> Jv = linear_.norm * (gyrostat.inverse_inertia() * linear_.v);
  const Scalar uu = linear_.u.dot(Ju) - linear_.spin_rate, vv = linear_.v.dot(Jv) - linear_.spin_rate;
  const Scalar uv = linear_.u.dot(Jv);
  stiffness_ = stability.determinant / ((uu + vv) / 2 + std::hypot((uu - vv) / 2, uv));
  // (4.1) by l, along m0 and across
  const Scalar mu = m.dot(Ju), mv = m.dot(Jv);
  spin_by_norm_ = m.dot(gyrostat.inverse_inertia() * m) -
                  (mu * mu * vv - 2 * mu * mv * uv + mv * mv * uu) / (stability.determinant * linear_.norm);

  const Vec3<Scalar> Gm = linear_.G * m, mGm = cross<Scalar>(m, Gm);
  normal_force_ = {linear_.u.dot(mGm), linear_.v.dot(mGm), linear_.feed * linear_.n.dot(m)};
  const Vec3<Scalar> rate(Gm.dot(linear_.u), Gm.dot(linear_.v), -m.dot(linear_.g));
  const Vec3<Scalar> c0 = linear_.matrix.col(0), c1 = linear_.matrix.col(1), c2 = linear_.matrix.col(2);
  turn_ = (rate[0] * cross<Scalar>(c1, c2) + rate[1] * cross<Scalar>(c2, c0) + rate[2] * cross<Scalar>(c0, c1)) /
          c0.dot(cross<Scalar>(c1, c2));

  std::array<Vector, 3> tilted, turning;
  for (std::size_t i = 0; i < 3; ++i) {
    amplitude_[i] = detail::complex_dot<Scalar>(y0_, modes_.left[i]);
    const Vector y = detail::complex_scaled<Scalar>(amplitude_[i], modes_.right[i]);
    for (std::size_t n = 0; n < 3; ++n) tilted[i][n] = linear_.u[int(n)] * y[0] + linear_.v[int(n)] * y[1];
    for (std::size_t n = 0; n < 3; ++n)
      turning[i][n] =
          detail::complex_dot<Scalar>(Vec3<Scalar>(linear_.G.row(int(n))), tilted[i]) - linear_.g[int(n)] * y[2];
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      const Scalar share = i == j ? Scalar(0.5) : Scalar(1);  // of the symmetric sum below
      Pair& pair = pairs_[at++];
      pair.exponent = modes_.exponent[i] + modes_.exponent[j];
      const Vector ij = detail::complex_cross<Scalar>(tilted[i], turning[j]),
                   ji = detail::complex_cross<Scalar>(tilted[j], turning[i]);
      const Vector N{share * (ij[0] + ji[0]), share * (ij[1] + ji[1]), share * (ij[2] + ji[2])};
      const Complex normal = -share * detail::complex_dot<Scalar>(tilted[i], tilted[j]);
      const Vector force{detail::complex_dot<Scalar>(linear_.u, N) + normal_force_[0] * normal,
                         detail::complex_dot<Scalar>(linear_.v, N) + normal_force_[1] * normal,
                         normal_force_[2] * normal};
      pair.turn = m.dot(Gm) * normal +
                  share / 2 *
                      (detail::complex_dot<Scalar>(tilted[i], turning[j]) +
                       detail::complex_dot<Scalar>(tilted[j], turning[i])) -
                  detail::complex_dot<Scalar>(turn_, force);
      for (std::size_t n = 0; n < 3; ++n) pair.modal[n] = detail::complex_dot<Scalar>(modes_.left[n], force);
    }
}

template <Real Scalar>
auto LinearTail<Scalar>::point(Scalar t, bool with_phase) const noexcept -> Point {
  Point p{Vec3<Scalar>(0, 0, 0), Vec3<Scalar>(0, 0, 0), 0};
  std::array<Complex, 3> grown;
  for (std::size_t i = 0; i < 3; ++i) {
    grown[i] = math::exponential(t * modes_.exponent[i]);
    detail::add_real<Scalar>(p.first, amplitude_[i] * grown[i], modes_.right[i]);
  }
  std::array<Complex, 3> second{};
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      const Pair& pair = pairs_[at++];
      const Complex both = grown[i] * grown[j];
      for (std::size_t n = 0; n < 3; ++n) {
        const Complex apart = pair.exponent - modes_.exponent[n];
        const Complex share = math::magnitude(apart) * t > Scalar(0.5)
                                  ? (both - grown[n]) * math::inverse(apart)
                                  : detail::exp_difference(pair.exponent, modes_.exponent[n], t);
        second[n] = second[n] + pair.modal[n] * share;
      }
      if (with_phase) p.phase += (pair.turn * detail::integral_of_exp(pair.exponent, t)).re;
    }
  for (std::size_t n = 0; n < 3; ++n) detail::add_real<Scalar>(p.second, second[n], modes_.right[n]);
  if (with_phase) p.phase += turn_.dot(p.first - y0_ + p.second);
  return p;
}

template <Real Scalar>
State<Scalar> LinearTail<Scalar>::at(Scalar t) const noexcept {
  const Point p = point(t, true);
  const Vec3<Scalar> y = p.first + p.second;
  const Scalar square = y[0] * y[0] + y[1] * y[1];
  const Vec3<Scalar> m = (tilt(y) + std::sqrt(std::max(1 - square, Scalar(0))) * linear_.m).normalized();
  const Scalar half = (linear_.spin_rate * t + p.phase) / 2;
  const Scalar c = std::cos(half), s = std::sin(half);
  State<Scalar> state;
  state.attitude = normalised(Quat<Scalar>{c, s * axis_I_[0], s * axis_I_[1], s * axis_I_[2]} * base_ *
                              detail::shortest_turn(m, linear_.m));
  state.momentum = linear_.norm * m;
  // exactly, xi changes by the integral of omega - omega*
  const Scalar change = y[2] - xi_0_;
  state.axial_momentum =
      start_.axial_momentum + gyrostat_.axial_inertia() * gyrostat_.coupling() * linear_.unit * change;
  state.rotor_angle = start_.rotor_angle + gyrostat_.no_load_rate() * t - linear_.unit / linear_.relaxation * change;
  return state;
}

/// Greatest misfits at samples of [from, from + length]; not `small` where the tilt is too large for the series.
template <Real Scalar>
auto LinearTail<Scalar>::misfit(Scalar from, Scalar length) const noexcept -> Misfit {
  constexpr int samples = 8;
  Misfit most;
  for (int i = 0; i < samples; ++i) {
    const Point p = point(from + length * Scalar(i) / samples, false);
    const Vec3<Scalar> y = p.first + p.second;
    const Vec3<Scalar> d1 = tilt(p.first), d_t = tilt(y);
    const Scalar square = d_t.squaredNorm(), square_1 = d1.squaredNorm();
    if (!(square < Scalar(0.5))) return most;
    const Scalar normal = -square / (1 + std::sqrt(1 - square)), normal_1 = -square_1 / 2;
    const Vec3<Scalar> d = d_t + normal * linear_.m;
    const Vec3<Scalar> q = linear_.tilt_rate(d, y[2]), q1 = linear_.tilt_rate(d1, p.first[2]);
    const Vec3<Scalar> change = cross<Scalar>(d, q) - cross<Scalar>(d1, q1);
    const Scalar more = normal - normal_1;
    const Vec3<Scalar> rest(linear_.u.dot(change) + more * normal_force_[0],
                            linear_.v.dot(change) + more * normal_force_[1], more * normal_force_[2]);
    for (std::size_t n = 0; n < 3; ++n) {
      most.modal[n] = std::max(most.modal[n], math::magnitude(detail::complex_dot<Scalar>(rest, modes_.left[n])));
    }
    const Scalar exact = (d + 2 * linear_.m).dot(q) / (2 + normal);
    const Scalar kept =
        linear_.m.dot(linear_.tilt_rate(Vec3<Scalar>(d_t + normal_1 * linear_.m), y[2])) + d1.dot(q1) / 2;
    most.phase = std::max(most.phase, std::abs(exact - kept));
    most.size = std::max(most.size, y.norm());
  }
  most.small = true;
  return most;
}

/// What the misfits grow to up to t; not `small` where first order in it does not suffice. Between two nodes the misfit is bounded
/// by its samples over one swing.
template <Real Scalar>
auto LinearTail<Scalar>::truncation(Scalar t) const noexcept -> Truncation {
  Truncation most;
  Scalar fastest = 0, swing = 0;  // 1/s
  std::array<Scalar, 3> decay, turn, excess;
  for (std::size_t i = 0; i < 3; ++i) {
    const Complex d = modes_.exponent[i];
    const Vector& v = modes_.right[i];
    fastest = std::max(fastest, math::magnitude(d));
    swing = std::max(swing, std::abs(d.im));
    decay[i] = -d.re;
    turn[i] = math::magnitude(detail::complex_dot<Scalar>(turn_, v));
    excess[i] = math::magnitude(linear_.unit * v[2] - linear_.rate_of_tilt * (linear_.n.dot(linear_.u) * v[0] +
                                                                              linear_.n.dot(linear_.v) * v[1]));
  }
  const Scalar end = std::min(t, 50 / decay_rate());
  std::array<Scalar, 3> off{}, sum{};
  Scalar phase = 0;
  for (Scalar s = 0; s < end;) {
    const Scalar h = std::min(end - s, std::max(Scalar(0.4) / fastest, Scalar(0.3) * s));
    const Misfit here = misfit(s, std::min(h, swing > 0 ? 2 * pi<Scalar> / swing : h));
    if (!here.small) return most;
    Scalar tilt_off = 0, xi_off = 0, rate_off = 0, turned = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const Scalar left = std::exp(-decay[n] * h);
      const Scalar push = Scalar(1.3L) * here.modal[n];
      off[n] = off[n] * left + push * (1 - left) / decay[n];
      sum[n] += push * h;
      const Vector& v = modes_.right[n];
      tilt_off += off[n] * std::hypot(math::magnitude(v[0]), math::magnitude(v[1]));
      xi_off += off[n] * math::magnitude(v[2]);
      rate_off += off[n] * excess[n];
      turned += turn[n] * (off[n] + sum[n]);
    }
    const Scalar together = std::hypot(tilt_off, xi_off);
    if (!(together <= Scalar(0.2) * here.size)) return most;
    phase += h * (Scalar(1.3L) * here.phase + curve() * together * (2 * here.size + together));
    most.phase = std::max(most.phase, phase + turned);
    most.tilt = std::max(most.tilt, tilt_off);
    most.xi = std::max(most.xi, xi_off);
    most.rate = std::max(most.rate,
                         rate_off + linear_.rate_of_tilt * std::abs(linear_.n.dot(linear_.m)) * here.size * tilt_off);
    s += h;
  }
  most.small = true;
  return most;
}

template <Real Scalar>
TailError<Scalar> LinearTail<Scalar>::error(Scalar t) const noexcept {
  TailError<Scalar> error;
  const Scalar slowest = decay_rate(), reach = modes_.condition();
  if (!(slowest > 0 && distance_ < Scalar(0.5) && reach < infinity<Scalar>)) return error;
  const Truncation most = truncation(t);
  if (!most.small) return error;

  Scalar fastest = 0;
  for (const Complex& d : modes_.exponent) fastest = std::max(fastest, math::magnitude(d));
  const Scalar j = 1 / gyrostat_.principal()[0], lambda = gyrostat_.axial_inertia();
  const Scalar l = linear_.norm, h = std::abs(gyrostat_.target_momentum());
  const Scalar fast = j * (l + h), ulps = 4 * epsilon<Scalar>;
  const Scalar data = ulps * (l + 2 * h + std::abs(start_.axial_momentum)) / l;  // of m and l
  const Scalar aim = (data + ulps) * (1 + fast / stiffness_);                    // of m0
  // the coupling is known to a rounding of the inertia, which it may be a small part of
  const Scalar blur = ulps * (reach + (1 - gyrostat_.coupling()) / gyrostat_.coupling());
  const Scalar modal = (blur + 32 * separation_) * distance_ * (2 + fastest / slowest);
  const Scalar spin = data * l * std::abs(spin_by_norm_) + ulps * fast;
  const Scalar rate_rounding = 2 * ulps *
                               (std::abs(gyrostat_.no_load_rate()) + fast + std::abs(start_.axial_momentum) / lambda +
                                (l + std::abs(start_.axial_momentum)) / gyrostat_.free_principal()[0]);
  constexpr Scalar safety = 2;  // of what the series leaves out; chosen, docs/errors.md has what was measured with it
  const Scalar tilt_all = safety * most.tilt + aim + modal + data;
  error.momentum = l * tilt_all;
  error.rotor_rate = safety * most.rate + linear_.unit * modal + rate_rounding;
  error.rotor_angle = safety * linear_.unit / linear_.relaxation * most.xi +
                      linear_.unit / linear_.relaxation * (modal + ulps * (distance_ + aim)) +
                      2 * ulps * (std::abs(gyrostat_.no_load_rate()) * t + std::abs(start_.rotor_angle)) +
                      rate_rounding * std::min(t, 1 / slowest);
  const Scalar turned = turn_.cwiseAbs().dot(y0_.cwiseAbs() + Vec3<Scalar>::Constant(data));
  error.attitude = safety * most.phase + 2 * tilt_all + t * (spin + ulps * std::abs(linear_.spin_rate)) + 4 * ulps +
                   blur * turned + 4 * ulps * reach * reach * distance_ * distance_ * fast / slowest;
  return error;
}

template <Real Scalar>
TailError<Scalar> LinearTail<Scalar>::carried(Scalar momentum, Scalar rotor_rate) const noexcept {
  const Scalar slowest = decay_rate();
  const Scalar tilt_off = momentum / linear_.norm;
  const Scalar off =
      std::hypot(tilt_off, (rotor_rate + linear_.rate_of_tilt * linear_.n.norm() * tilt_off) / linear_.unit);
  Scalar moved = 0, turned = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Scalar share = detail::complex_length<Scalar>(modes_.left[i]) * off;
    moved += share;
    turned += 2 * share * math::magnitude(detail::complex_dot<Scalar>(turn_, modes_.right[i]));
  }
  moved *= 2;  // with what the second order adds
  TailError<Scalar> error;
  error.momentum = linear_.norm * moved;
  error.rotor_rate = (linear_.unit + linear_.rate_of_tilt * linear_.n.norm()) * moved;
  error.rotor_angle = 2 * linear_.unit / linear_.relaxation * moved;
  error.attitude = 2 * moved + turned + curve() * moved * (distance_ + moved) / slowest;
  return error;
}

#ifdef GYROSTAT_COMPILED
extern template class LinearTail<double>;
#endif

}  // namespace gyrostat::rotor
