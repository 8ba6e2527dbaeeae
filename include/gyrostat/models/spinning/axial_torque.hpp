// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The motion for small tilt under a torque about the spin axis, r = r0 + M3 t/D3 (docs/spinning.md, section 6.3).
namespace gyrostat::spinning {

/// Taylor recurrences of the linear equations with a spin rate that grows evenly,
///     p' = M1/D1 - kappa1(r) q,   q' = M2/D2 + kappa2(r) p,   Gamma' + i r Gamma = p + i q,   theta' = r,
/// to which r = 0 and the resonances are points like all others. A state is
///     (p, q, psi, phi | cos(theta), sin(theta), rho, Z | E, W | B, C, - | int E, int W | int B, -, -),
/// E = int e^(i theta), W = int e^(i theta) Gamma, B = int Gamma (each two numbers), C = int |Gamma|^2/2: the last four rows are quadratures
/// of which momentum, velocity and position are made; rho = ((D1 - D2)/D3) int p q, what the spin rate leaves out, and
/// Z = int rho + int Im(Pi Gamma~)/2, what the spin angle does, for the errors,
///     G = G0 + M E - i e_H [e^(i theta) Gamma] - i M3 W,   m v = m v0 + f E - i f3 W,   m v3 = m v30 + f3 t + Re(i f~ B).
template <Real Real_>
class AxialTorqueSystem {
 public:
  using Scalar = Real_;
  static constexpr int width = 24;
  using Numbers = std::array<Scalar, width>;

  template <int Order>
  struct Work {};

  explicit AxialTorqueSystem(const Problem<Scalar>& problem) noexcept
      : problem_(problem),
        spin_rate_(problem.torque[2] / problem.inertia[2]),
        stiffness_1_((problem.inertia[2] - problem.inertia[1]) / problem.inertia[0]),
        stiffness_2_((problem.inertia[2] - problem.inertia[0]) / problem.inertia[1]),
        skew_((problem.inertia[0] - problem.inertia[1]) / problem.inertia[2]) {
    const auto& a = problem.angles;
    const auto& w = problem.angular_velocity;
    start_ = {w[0], w[1], a.psi, a.phi, std::cos(a.theta), std::sin(a.theta)};
    const Quat<Scalar> q = quaternion_from_312(a.psi, a.phi, a.theta);
    Vec3<Scalar> H = problem.inertia.cwiseProduct(w);
    H[2] += problem.rotor_momentum;
    axial_momentum_ = rotate<Scalar>(q, H)[2];
  }

  /// r at t, rad/s.
  Scalar spin(Scalar t) const noexcept { return problem_.spin() + spin_rate_ * t; }
  /// theta at t, rad.
  Scalar theta(Scalar t) const noexcept { return problem_.angles.theta + t * (problem_.spin() + spin_rate_ * t / 2); }

  const Numbers& start() const noexcept { return start_; }

  /// What the steps measure errors against over [0, span]: the sizes that rates, tilt and their quadratures grow to from the start and
  /// the torque, at least.
  Numbers scale(Scalar span) const noexcept {
    const auto& p = problem_;
    const Scalar r = std::max(std::abs(p.spin()), std::abs(spin(span)));
    const Scalar stiff = std::max({std::abs(p.kappa1(p.spin())), std::abs(p.kappa2(p.spin())),
                                   std::abs(p.kappa1(spin(span))), std::abs(p.kappa2(spin(span)))});
    const Scalar rate = std::max({r, stiff, span > 0 ? 1 / span : Scalar(1)});
    const Scalar drive = std::hypot(p.torque[0] / p.inertia[0], p.torque[1] / p.inertia[1]);
    const Scalar pushed = std::max(std::hypot(start_[0], start_[1]), drive / rate);
    const Scalar tilted = std::max(std::hypot(start_[2], start_[3]), pushed / rate);
    // where nothing moves any scale will do, but zero would leave the component out
    const Scalar g = tilted > 0 ? tilted : Scalar(1), P = pushed > 0 ? pushed : g * rate;
    Numbers scale{P, P, g, g, 1, 1, 0, 0, 1 / rate, 1 / rate, g / rate, g / rate, g / rate, g / rate};
    return scale;
  }

  template <int Order>
  void expand(Scalar t, Scalar unit, Scalar (&x)[Order + 1][width], Work<Order>&) const noexcept {
    const Scalar r = spin(t) * unit, r_slope = spin_rate_ * unit * unit;
    const Scalar k1 = problem_.kappa1(spin(t)) * unit, k1_slope = stiffness_1_ * r_slope;
    const Scalar k2 = problem_.kappa2(spin(t)) * unit, k2_slope = stiffness_2_ * r_slope;
    const Scalar m1 = problem_.torque[0] / problem_.inertia[0], m2 = problem_.torque[1] / problem_.inertia[1];
    for (int k = 0; k < Order; ++k) {
      const Scalar share = Scalar(1) / static_cast<Scalar>(k + 1);
      const Scalar* const now = x[k];
      const Scalar* const before = k > 0 ? x[k - 1] : nullptr;
      const auto turned = [&](std::size_t i, Scalar factor, Scalar slope) noexcept {
        return factor * now[i] + (before != nullptr ? slope * before[i] : Scalar(0));
      };
      const auto first = [k](Scalar value) noexcept { return k == 0 ? value : Scalar(0); };
      Scalar* const next = x[k + 1];
      next[0] = share * (first(unit * m1) - turned(1, k1, k1_slope));
      next[1] = share * (first(unit * m2) + turned(0, k2, k2_slope));
      next[2] = share * (unit * now[0] + turned(3, r, r_slope));
      next[3] = share * (unit * now[1] - turned(2, r, r_slope));
      next[4] = -share * turned(5, r, r_slope);
      next[5] = share * turned(4, r, r_slope);
      Scalar re = 0, im = 0, square = 0, product = 0, nutation = 0;
      for (int j = 0; j <= k; ++j) {
        re += x[j][4] * x[k - j][2] - x[j][5] * x[k - j][3];
        im += x[j][4] * x[k - j][3] + x[j][5] * x[k - j][2];
        square += x[j][2] * x[k - j][2] + x[j][3] * x[k - j][3];
        product += x[j][0] * x[k - j][1];
        nutation += x[j][1] * x[k - j][2] - x[j][0] * x[k - j][3];
      }
      const Scalar step = share * unit;
      next[6] = step * skew_ * product;
      next[7] = step * (nutation / 2 + now[6]);
      next[8] = step * now[4], next[9] = step * now[5];
      next[10] = step * re, next[11] = step * im;
      next[12] = step * now[2], next[13] = step * now[3];
      next[14] = step * square / 2;
      next[15] = 0;
      for (int i = 0; i < 6; ++i) next[16 + i] = step * now[8 + i];
      next[22] = next[23] = 0;
    }
  }

  /// e^(i theta) anew.
  void project(Scalar t, Scalar* x, Scalar* low) const noexcept {
    x[4] = std::cos(theta(t)), x[5] = std::sin(theta(t));
    low[4] = low[5] = 0;
  }

  /// The state that numbers at t mean. G3 is right to second order in the tilt, as that of the linear motion is.
  State<Scalar> state(Scalar t, const Scalar* x) const noexcept {
    using math::turned;
    using Complex = math::Complex<Scalar>;
    const Problem<Scalar>& p = problem_;
    const Complex E{x[8], x[9]}, W{x[10], x[11]}, B{x[12], x[13]};
    const Complex M{p.torque[0], p.torque[1]}, f{p.force[0] / p.mass, p.force[1] / p.mass};
    const Scalar f3 = p.force[2] / p.mass;
    const auto across = [](Complex a, Complex b) noexcept { return a.im * b.re - a.re * b.im; };  // Re(i a~ b)

    State<Scalar> s;
    s.angular_velocity = {x[0], x[1], spin(t)};
    s.angles = {x[2], x[3], theta(t)};
    s.attitude = quaternion_from_312(x[2], x[3], s.angles.theta);
    const auto& a = p.angles;
    const Complex tilt = math::unit(s.angles.theta) * Complex{x[2], x[3]};
    const Complex tilt_0 = math::unit(a.theta) * Complex{a.psi, a.phi};
    const Complex linear_0 =
        math::unit(a.theta) * (Complex{p.inertia[0] * p.angular_velocity[0], p.inertia[1] * p.angular_velocity[1]} -
                               p.axial_momentum() * turned(Complex{a.psi, a.phi}));
    const Complex G = linear_0 + M * E - p.charge_momentum * turned(tilt - tilt_0) - p.torque[2] * turned(W);
    const Scalar bent = (x[2] * x[2] + x[3] * x[3] - a.psi * a.psi - a.phi * a.phi) / 2;
    s.momentum_I = {G.re, G.im, axial_momentum_ + p.torque[2] * (t - x[14]) + across(M, B) - p.charge_momentum * bent};
    const Complex v = f * E - f3 * turned(W);
    const Complex y = f * Complex{x[16], x[17]} - f3 * turned(Complex{x[18], x[19]});
    s.velocity = p.velocity + Vec3<Scalar>(v.re, v.im, f3 * t + across(f, B));
    s.position =
        p.position + t * p.velocity + Vec3<Scalar>(y.re, y.im, f3 * t * t / 2 + across(f, Complex{x[20], x[21]}));
    return s;
  }

 private:
  Problem<Scalar> problem_;
  Scalar spin_rate_, stiffness_1_, stiffness_2_;  ///< r', rad/s^2; the slopes of kappa over r
  Scalar skew_;                                   ///< (D1 - D2)/D3
  Scalar axial_momentum_;                         ///< G3 at t = 0, exact, N m s
  Numbers start_{};
};

/// Greatest magnitudes along a motion under an axial torque.
template <Real Scalar>
struct AxialSizes {
  Amplitudes<Scalar> size{0, 0};
  Scalar spin = 0;   ///< change of r to second order, rad/s
  Scalar phase = 0;  ///< what this and nutation add to the spin angle, rad
  Scalar gross = 0;  ///< half the integral of |Pi| |Gamma|, what nutation would add if nothing cancelled, rad
  Scalar rates = 0;  ///< third order and roundings of the rates, grown where the spin was unstable, rad/s
};

/// Estimated greatest errors of the linear motion under an axial torque over [0, T] against the full equations, as linear_errors has them
/// without one, from what was seen on the way. No bounds. T > 0.
template <Real Scalar>
LinearErrors<Scalar> axial_torque_errors(const Problem<Scalar>& problem, Scalar T,
                                         const AxialSizes<Scalar>& seen) noexcept {
  const auto& D = problem.inertia;
  const Scalar start = problem.spin(), end = start + problem.torque[2] / D[2] * T;
  const Scalar slowest = start * end > 0 ? std::min(std::abs(start), std::abs(end)) : Scalar(0);
  const Scalar kappa[] = {problem.kappa1(start), problem.kappa1(end), problem.kappa2(start), problem.kappa2(end)};
  Scalar steep = 0, flat = infinity<Scalar>;
  for (const Scalar k : kappa) {
    steep = std::max(steep, std::abs(k));
    flat = k * kappa[0] > 0 ? std::min(flat, std::abs(k)) : Scalar(0);
  }
  const Scalar zeta = problem.greatest_zeta();
  const Scalar skew = std::min(1 + steep * T, std::sqrt(steep / flat));

  LinearErrors<Scalar> error;
  error.size = seen.size;
  Scalar g = seen.size.tilt, P = seen.size.rate, rate = seen.spin, net = seen.phase, gross = seen.gross;
  Scalar rates = seen.rates;
  const auto third_order = [&]() noexcept {
    error.rates = Scalar(1.5L) * skew * rates;
    error.tilt = (g * (2 * gross + rate * T) + g * g * g) / 2 + error.rates * T;
  };
  third_order();
  if (!(g + error.tilt <= Scalar(small_tilt))) {
    rate = std::abs(D[0] - D[1]) / (2 * D[2]) * P * P * T;
    net = gross = g * P * T;
    rates = std::max(rates, P * zeta * rate * T);
    third_order();
  }
  // the motion itself may be larger than the linear one by its error
  g += error.tilt;
  P += error.rates;
  const Scalar more = seen.size.rate > 0 ? P / seen.size.rate : Scalar(1);
  rate *= more * more, net *= more * more, gross *= more * more, rates *= more * more * more;
  third_order();

  const Scalar phase = net + g * g / 2;
  Scalar turned = T * phase;
  if (slowest > 0) turned = std::min(turned, (phase + T * (rate + g * P / 2)) / slowest);
  turned += g * g * T / 2;
  const Scalar f = std::hypot(problem.force[0], problem.force[1]) / problem.mass;
  const Scalar f3 = std::abs(problem.force[2]) / problem.mass;
  const Scalar M = std::hypot(problem.torque[0], problem.torque[1]), M3 = std::abs(problem.torque[2]);
  const Scalar e = std::abs(problem.charge_momentum);
  error.spin = Scalar(1.25L) * rate;
  error.theta = Scalar(1.25L) * net + g * g / 2 + g * g * gross;
  error.attitude = std::hypot(error.theta, error.tilt);
  error.momentum = M * turned + (e + M3 * T) * (error.tilt + g * phase + g * g * g) +
                   Scalar(1.25L) * detail::momentum_left_out(problem);
  error.axial_momentum = (M * T + (M3 * T + e) * g) * error.tilt + M3 * T * g * g * g * g;
  error.velocity = f * turned + f3 * T * error.tilt;
  error.axial_velocity = f3 * g * g * T / 2 + f * T * error.tilt;
  error.position = T * error.velocity / 2;
  error.axial_position = T * error.axial_velocity / 2;
  return error;
}

}  // namespace gyrostat::spinning
