// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/core/times.hpp"
#include "gyrostat/math/chebyshev_panel.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"

/// The full equations by sweeps of quadratures that start from the linear motion (docs/spinning.md, section 6.2).
namespace gyrostat::spinning {

/// Greatest distances of two motions over the times, in units of the columns; of vectors, of their norm.
template <Real Scalar>
struct SweepErrors {
  Scalar angular_velocity = 0;
  Scalar angles = 0;
  Scalar attitude = 0;
  Scalar momentum = 0;
  Scalar velocity = 0;
  Scalar position = 0;

  void add(const State<Scalar>& a, const State<Scalar>& b) noexcept {
    const auto raise = [](Scalar& most, Scalar value) noexcept {
      if (!(value <= most)) most = most == most ? value : most;
    };
    const auto angle = [](const Angles<Scalar>& x) noexcept { return Vec3<Scalar>(x.psi, x.phi, x.theta); };
    raise(angular_velocity, (a.angular_velocity - b.angular_velocity).norm());
    raise(angles, (angle(a.angles) - angle(b.angles)).norm());
    raise(momentum, (a.momentum_I - b.momentum_I).norm());
    raise(velocity, (a.velocity - b.velocity).norm());
    raise(position, (a.position - b.position).norm());
    const Quat<Scalar> d = conjugate(a.attitude) * b.attitude;
    raise(attitude, 2 * std::atan2(std::hypot(d.x, d.y, d.z), std::abs(d.w)));
  }
  std::array<Scalar, 6> all() const noexcept {
    return {angular_velocity, angles, attitude, momentum, velocity, position};
  }
};

/// How many sweeps, over how many panels at most.
template <Real Scalar>
struct PicardOptions {
  int sweeps = 2;                       ///< 2 to 8
  std::uint64_t panel_cap = 1'000'000;  ///< of about half a turn each
};

/// What the sweeps say of their error, and of that of the linear motion.
template <Real Scalar>
struct PicardAnswer {
  SweepErrors<Scalar> linear;  ///< estimated error of the linear motion, |sweep 1 - linear| + 3 |sweep 2 - sweep 1|
  SweepErrors<Scalar>
      error;  ///< of the states, |last sweep - the one before| once to twice, by 128 of the greatest ratio of two sweeps
  SweepErrors<Scalar> size;  ///< greatest norms of the columns; attitude: 1
  bool converges = true;    ///< false: a sweep moved a column by more than half of what the sweep before did; no answer
  std::uint64_t nodes = 0;  ///< times sweeps: values of the motion computed
};

/// The motion at the given times (s from the start, increasing, the first >= 0) after some sweeps. Each raises the order of the error
/// in the tilt by two: of the rates, the tilt and the momentum from 3, of theta, r and v3 from 2.
///
/// A sweep takes rates and tilt of the last one and integrates, in a frame that turns with the body,
///     rho = ((D1 - D2)/D3) int p q,   Pi = e^(Bt) [Pi0 + int e^(-Bs) (mu + rho Z Pi)],   B Pi = -kappa1 q + i kappa2 p,   Z = dB/dr,
///     u = e^(-i Th) [u0 + int e^(i Th) sqrt(1 - |u|^2) Pi],   Th = int r,   z = z0 + Th + int Im(Pi w~),   w = u/(1 + c),
/// v and x from w and z. The quadratures run over panels of three radians of r0 + 2 nu, each through all sweeps before the next,
/// so that nothing is stored: no heap. A sweep over a panel costs some 3 us, so a turn ten times what the series of the full
/// equations take: what the sweeps give is an estimate by other means, and one of the linear motion.
///
/// Errors: not_increasing, not_finite, out_of_domain (spans of other lengths, sweeps), not_applicable (a torque about axis 3),
/// step_limit (more panels than the cap), no_convergence (tilt beyond a right angle).
template <Real Scalar>
Result<PicardAnswer<Scalar>> picard_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                           std::span<State<Scalar>> states,
                                           const PicardOptions<Scalar>& options = {}) noexcept;

namespace detail {

template <Real Scalar>
class PicardSweeps {
 public:
  using Complex = math::Complex<Scalar>;
  using Panel = math::ChebyshevPanel<Scalar>;
  using Values = typename Panel::Values;
  static constexpr std::size_t size = Panel::size;
  static constexpr int sweep_cap = 8;

  PicardSweeps(const Problem<Scalar>& problem, int sweeps, Scalar end, Scalar panels) noexcept
      : problem_(problem), linear_(problem), sweeps_(sweeps), length_(end / panels) {
    const auto& D = problem.inertia;
    const Scalar r0 = problem.spin();
    mu_ = {problem.torque[0] / D[0], problem.torque[1] / D[1]};
    skew_ = (D[0] - D[1]) / D[2];
    stiffness_ = {problem.kappa1(r0), problem.kappa2(r0)};
    by_spin_ = {(D[2] - D[1]) / D[0], (D[2] - D[0]) / D[1]};
    const Scalar square = stiffness_.re * stiffness_.im, nu = std::sqrt(std::abs(square));
    for (std::size_t k = 0; k < size; ++k) {
      const Scalar s = length_ * panel_.node(k), x = nu * s;
      cosine_[k] = square < 0 ? std::cosh(x) : std::cos(x);
      sine_[k] = x == 0 ? s : (square < 0 ? std::sinh(x) : std::sin(x)) / nu;
    }
    force_ = {problem.force[0] / problem.mass, problem.force[1] / problem.mass};
    thrust_ = problem.force[2] / problem.mass;

    const auto& a = problem.angles;
    std::array<Scalar, columns> start{};
    start[p] = problem.angular_velocity[0], start[q] = problem.angular_velocity[1];
    const Complex u{std::sin(a.psi), std::cos(a.psi) * std::sin(a.phi)};
    start[u1] = u.re, start[u2] = u.im;
    start[z] = a.theta + twist(u, std::cos(a.psi) * std::cos(a.phi));
    for (const int i : {0, 1, 2}) start[v1 + std::size_t(i)] = problem.velocity[i];
    for (const int i : {0, 1, 2}) start[x1 + std::size_t(i)] = problem.position[i];
    for (int n = 0; n <= sweeps; ++n) at_start_[n] = start;
    small_ = {1, start[p], start[q], a.psi, a.phi};
    map_linear();
  }

  /// The next panel through all sweeps; false if the tilt reaches a right angle.
  bool advance() noexcept {
    for (std::size_t c = 0; c < 4; ++c) {
      Values sum{};
      for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t k = 0; k < size; ++k) sum[k] += small_[i] * map_[i][c][k];
      value_[0][small_columns[c]] = sum;
    }
    bool upright = true;
    for (int n = 1; n <= sweeps_; ++n) upright = sweep(value_[n - 1], value_[n], at_start_[n]) && upright;
    return upright;
  }
  /// To be called before the next advance.
  void leave() noexcept {
    for (int n = 1; n <= sweeps_; ++n)
      for (std::size_t c = 0; c < columns; ++c) at_start_[n][c] = value_[n][c][size - 1];
    for (std::size_t c = 0; c < 4; ++c) small_[c + 1] = value_[0][small_columns[c]][size - 1];
    ++done_;
  }

  Scalar start() const noexcept { return length_ * static_cast<Scalar>(done_); }
  Scalar end() const noexcept { return length_ * static_cast<Scalar>(done_ + 1); }
  std::uint64_t done() const noexcept { return done_; }

  /// After a sweep; sweep 0 is the linear motion. t within the panel.
  State<Scalar> state(int n, Scalar t) const noexcept {
    if (n == 0) return linear_.at(t);
    const Values weights = panel_.weights(std::clamp((t - start()) / length_, Scalar(0), Scalar(1)));
    std::array<Scalar, columns> x{};
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t k = 0; k < size; ++k) x[c] += weights[k] * value_[n][c][k];
    const Complex u{x[u1], x[u2]};
    const Scalar c = std::sqrt(1 - (u.re * u.re + u.im * u.im));
    State<Scalar> s;
    s.angular_velocity = {x[p], x[q], problem_.spin() + x[rho]};
    s.angles = {std::atan2(u.re, std::hypot(u.im, c)), std::atan2(u.im, c), heading(t, x[z]) - twist(u, c)};
    s.attitude = quaternion_from_312(s.angles.psi, s.angles.phi, s.angles.theta);
    s.momentum_I = inertial_momentum(problem_, s.angular_velocity, s.attitude);
    s.velocity = {x[v1], x[v2], x[v3]};
    s.position = {x[x1], x[x2], x[x3]};
    return s;
  }

 private:
  /// z: less r0 t, which would lose digits in sums over many panels.
  enum : std::size_t { p, q, rho, u1, u2, z, v1, v2, v3, x1, x2, x3, columns };
  using Columns = std::array<Values, columns>;

  Scalar heading(Scalar t, Scalar rest) const noexcept { return problem_.spin() * t + rest; }

  /// z - theta: atan2(Im w^2, 1 - Re w^2).
  static Scalar twist(Complex u, Scalar c) noexcept {
    const Complex w = u / (1 + c);
    const Complex square = w * w;
    return std::atan2(square.im, 1 - square.re);
  }

  /// What a turn at the rate of the stiffnesses k makes of F.
  static Complex pushed(Complex k, Complex F) noexcept { return {-k.re * F.im, k.im * F.re}; }

  /// The linear motion over a panel from each of (1, p, q, psi, phi) at its start.
  void map_linear() noexcept {
    for (std::size_t i = 0; i < 5; ++i) {
      const auto is = [i](std::size_t n) noexcept { return i == n ? Scalar(1) : Scalar(0); };
      Values re, im;
      for (std::size_t k = 0; k < size; ++k) {
        const Complex F = is(0) * mu_;
        const Complex back = cosine_[k] * F - sine_[k] * pushed(stiffness_, F);
        re[k] = back.re, im[k] = back.im;
      }
      re = panel_.integrated(re, length_, is(1)), im = panel_.integrated(im, length_, is(2));
      std::array<Complex, size> spin;
      for (std::size_t k = 0; k < size; ++k) {
        const Complex y{re[k], im[k]}, Pi = cosine_[k] * y + sine_[k] * pushed(stiffness_, y);
        map_[i][0][k] = Pi.re, map_[i][1][k] = Pi.im;
        spin[k] = math::unit(problem_.spin() * (length_ * panel_.node(k)));
        const Complex rate = spin[k] * Pi;
        re[k] = rate.re, im[k] = rate.im;
      }
      re = panel_.integrated(re, length_, is(3)), im = panel_.integrated(im, length_, is(4));
      for (std::size_t k = 0; k < size; ++k) {
        const Complex Gamma = conjugate(spin[k]) * Complex{re[k], im[k]};
        map_[i][2][k] = Gamma.re, map_[i][3][k] = Gamma.im;
      }
    }
  }

  bool sweep(const Columns& old, Columns& now, const std::array<Scalar, columns>& from) const noexcept {
    Values re, im;
    const auto integrated = [&](const Values& f, Scalar start) noexcept {
      return panel_.integrated(f, length_, start);
    };

    for (std::size_t k = 0; k < size; ++k) re[k] = skew_ * (old[p][k] * old[q][k]);
    now[rho] = integrated(re, from[rho]);
    Values turn = integrated(now[rho], 0);
    for (std::size_t k = 0; k < size; ++k) turn[k] += problem_.spin() * (length_ * panel_.node(k));

    for (std::size_t k = 0; k < size; ++k) {
      const Complex F = mu_ + now[rho][k] * pushed(by_spin_, {old[p][k], old[q][k]});
      const Complex back = cosine_[k] * F - sine_[k] * pushed(stiffness_, F);
      re[k] = back.re, im[k] = back.im;
    }
    re = integrated(re, from[p]), im = integrated(im, from[q]);
    for (std::size_t k = 0; k < size; ++k) {
      const Complex y{re[k], im[k]};
      const Complex Pi = cosine_[k] * y + sine_[k] * pushed(stiffness_, y);
      now[p][k] = Pi.re, now[q][k] = Pi.im;
    }

    bool upright = true;
    std::array<Complex, size> spin;
    for (std::size_t k = 0; k < size; ++k) {
      spin[k] = math::unit(turn[k]);
      const Scalar square = 1 - (old[u1][k] * old[u1][k] + old[u2][k] * old[u2][k]);
      upright = upright && square > 0;
      const Complex rate = std::sqrt(square) * (spin[k] * Complex{now[p][k], now[q][k]});
      re[k] = rate.re, im[k] = rate.im;
    }
    re = integrated(re, from[u1]), im = integrated(im, from[u2]);
    std::array<Complex, size> w;
    for (std::size_t k = 0; k < size; ++k) {
      const Complex u = conjugate(spin[k]) * Complex{re[k], im[k]};
      now[u1][k] = u.re, now[u2][k] = u.im;
      const Scalar square = 1 - (u.re * u.re + u.im * u.im);
      upright = upright && square > 0;
      w[k] = u / (1 + std::sqrt(square));
      turn[k] += from[z] - problem_.spin() * (length_ * panel_.node(k));
      re[k] = now[q][k] * w[k].re - now[p][k] * w[k].im;
    }
    now[z] = integrated(re, 0);
    Values axial;
    for (std::size_t k = 0; k < size; ++k) {
      now[z][k] += turn[k];
      const Scalar square = w[k].re * w[k].re + w[k].im * w[k].im, share = 1 / (1 + square);
      const Complex pull = force_ + conjugate(force_) * (w[k] * w[k]) - (2 * thrust_) * turned(w[k]);
      const Complex a = share * (math::unit(heading(start() + length_ * panel_.node(k), now[z][k])) * pull);
      re[k] = a.re, im[k] = a.im;
      axial[k] = share * (thrust_ * (1 - square) + 2 * (w[k].re * force_.im - w[k].im * force_.re));
    }
    now[v1] = integrated(re, from[v1]);
    now[v2] = integrated(im, from[v2]);
    now[v3] = integrated(axial, from[v3]);
    for (const std::size_t i : {0U, 1U, 2U}) now[x1 + i] = integrated(now[v1 + i], from[x1 + i]);
    return upright;
  }

  Problem<Scalar> problem_;
  Linear<Scalar> linear_;
  Panel panel_;
  int sweeps_;
  Scalar length_;
  Complex mu_, force_;
  Complex stiffness_, by_spin_;  ///< kappa1 + i kappa2 at r0, 1/s; and its change with the spin
  Scalar thrust_ = 0, skew_ = 0;
  Values cosine_{}, sine_{};  ///< cos(nu s) and sin(nu s)/nu at the nodes
  static constexpr std::size_t small_columns[] = {p, q, u1, u2};
  std::array<Scalar, 5> small_{};  ///< (1, p, q, psi, phi) of the linear motion at the panel's start
  Values map_[5][4]{};             ///< what each of them adds to (p, q, psi, phi) at the nodes
  std::uint64_t done_ = 0;
  std::array<Scalar, columns> at_start_[sweep_cap + 1]{};
  Columns value_[sweep_cap + 1]{};
};

/// The errors of an answer by what each sweep moved, from the first on, and by what rounding makes of columns of the sizes `size`, and the motion of that:
/// what an unstable spin lets grow, `grown` times.
template <Real Scalar>
void judge_sweeps(PicardAnswer<Scalar>& answer, std::span<const SweepErrors<Scalar>> moved,
                  const std::array<Scalar, 6>& size, Scalar rounding, Scalar grown) noexcept {
  const auto combine = [&](Scalar a, const SweepErrors<Scalar>& x, Scalar b, const SweepErrors<Scalar>& y,
                           Scalar c) noexcept {
    const auto first = x.all(), second = y.all();
    const auto one = [&](std::size_t i) noexcept { return a * first[i] + b * second[i] + c * size[i]; };
    return SweepErrors<Scalar>{one(0), one(1), one(2), one(3), one(4), one(5)};
  };
  const SweepErrors<Scalar>& last = moved.back();
  const auto now = last.all(), before = moved[moved.size() - 2].all();
  Scalar ratio = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const bool moves = !(now[i] <= 4 * rounding * size[i]);
    if (moves && !(now[i] <= before[i] / 2)) answer.converges = false;
    if (moves) ratio = std::max(ratio, now[i] / before[i]);
  }
  answer.linear = combine(1, moved[1], 3, moved[2], rounding);
  answer.error = combine(std::clamp(128 * ratio, Scalar(1), Scalar(2)), last, 0, last, 4 * rounding * grown);
}

/// Keeps the state at time t of the last sweep, its size, and what each sweep moved there.
template <Real Scalar>
State<Scalar> settled(const PicardSweeps<Scalar>& sweeps, Scalar t, std::span<SweepErrors<Scalar>> moved,
                      SweepErrors<Scalar>& size) noexcept {
  State<Scalar> state = sweeps.state(0, t);
  for (std::size_t n = 1; n < moved.size(); ++n) {
    const State<Scalar> now = sweeps.state(static_cast<int>(n), t);
    moved[n].add(now, state);
    state = now;
  }
  const Scalar one = size.attitude;
  const Vec3<Scalar> none = Vec3<Scalar>::Zero();
  size.add(state, State<Scalar>{none, {}, state.attitude, none, none, none});
  size.attitude = one;
  return state;
}

}  // namespace detail

template <Real Scalar>
Result<PicardAnswer<Scalar>> picard_motion(const Problem<Scalar>& problem, std::span<const Scalar> times,
                                           std::span<State<Scalar>> states,
                                           const PicardOptions<Scalar>& options) noexcept {
  constexpr Scalar eps = epsilon<Scalar>;
  const int last = options.sweeps;
  if (states.size() != times.size() || last < 2 || last > detail::PicardSweeps<Scalar>::sweep_cap)
    return Errc::out_of_domain;
  if (const Errc wrong = check_span(times); wrong != Errc::ok) return wrong;
  const Scalar nu = std::sqrt(std::abs(problem.nutation_squared()));
  const Scalar rate = std::abs(problem.spin()) + 2 * nu;
  if (!(rate < infinity<Scalar>)) return Errc::not_finite;
  if (problem.torque[2] != 0) return Errc::not_applicable;

  PicardAnswer<Scalar> answer;
  answer.size.attitude = 1;
  SweepErrors<Scalar> all[detail::PicardSweeps<Scalar>::sweep_cap + 1]{};
  const std::span<SweepErrors<Scalar>> moved(all, static_cast<std::size_t>(last) + 1);  // by each sweep
  const Scalar end = times.empty() ? Scalar(0) : times.back();
  // three radians a panel are exact to double rounding
  const Scalar reach = eps < Scalar(1e-18L) ? Scalar(1.5L) : Scalar(3);
  const Scalar panels = std::ceil(std::max(Scalar(1), end * rate / reach));
  if (!(panels <= static_cast<Scalar>(options.panel_cap))) return Errc::step_limit;

  detail::PicardSweeps<Scalar> sweeps(problem, last, end > 0 ? end : Scalar(1), panels);
  std::size_t next = 0;
  while (next < times.size()) {
    if (!sweeps.advance()) return Errc::no_convergence;
    const bool final = !(static_cast<Scalar>(sweeps.done() + 1) < panels);
    for (; next < times.size() && (times[next] <= sweeps.end() || final); ++next)
      states[next] = detail::settled<Scalar>(sweeps, times[next], moved, answer.size);
    sweeps.leave();
  }
  answer.nodes = sweeps.done() * detail::PicardSweeps<Scalar>::size * static_cast<std::uint64_t>(last);

  // of every panel, and of the phases; the stiffnesses and the momentum are differences of terms that may nearly cancel
  const auto& D = problem.inertia;
  const Scalar kept = std::abs(problem.rotor_momentum) + std::abs(problem.charge_momentum);
  const Scalar stiffest = (kept + D[2] * std::abs(problem.spin())) / std::min(D[0], D[1]);
  const Scalar rounding = eps * (16 + 4 * std::sqrt(panels) + (rate + stiffest) * end / 4);
  auto size = answer.size.all();
  size[2] += std::abs(problem.angles.theta);
  size[3] += kept + D.maxCoeff() * answer.size.angular_velocity;
  // at most so much that nothing is known: of what is zero nothing grows
  const Scalar grown = std::min(std::exp(std::sqrt(std::max(-problem.nutation_squared(), Scalar(0))) * end), 1 / eps);
  detail::judge_sweeps<Scalar>(answer, moved, size, rounding, grown);
  return answer;
}

}  // namespace gyrostat::spinning
