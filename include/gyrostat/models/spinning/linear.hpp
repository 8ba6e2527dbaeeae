// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/linear_functions.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"

namespace gyrostat::spinning {

/// The constants of the linear motion. Complex: component 1 + i component 2.
template <Real Scalar>
struct LinearStart {
  using Complex = math::Complex<Scalar>;

  Complex Pi, b, d;           ///< p + i q at t = 0 and its first and second rate, rad/s^(1..3)
  Complex Gamma;              ///< psi + i phi at t = 0, rad
  Complex heading;            ///< e^(i theta0)
  Complex torque;             ///< M, N m
  Complex momentum;           ///< e^(-i theta0) G at t = 0, N m s
  Complex acceleration;       ///< f/m, m/s^2
  Scalar axial_acceleration;  ///< f3/m, m/s^2
  Scalar axial_momentum;      ///< of R (D1 p, D2 q, D3 r + lambda3) along inertial axis 3 at t = 0, exact, N m s
  Scalar charge_momentum;     ///< e_H, N m s

  explicit LinearStart(const Problem<Scalar>& problem) noexcept {
    using Wide = detail::Wide<Scalar>;
    const auto w = detail::problem_cast<Wide>(problem);
    const auto narrow = [](Wide re, Wide im) noexcept {
      return Complex{static_cast<Scalar>(re), static_cast<Scalar>(im)};
    };
    const Wide p = w.angular_velocity[0], q = w.angular_velocity[1], L3 = w.axial_momentum();
    const Wide kappa1 = w.kappa1(w.spin()), kappa2 = w.kappa2(w.spin());
    const Wide p_rate = w.torque[0] / w.inertia[0] - kappa1 * q, q_rate = w.torque[1] / w.inertia[1] + kappa2 * p;
    Pi = narrow(p, q);
    b = narrow(p_rate, q_rate);
    d = narrow(-kappa1 * q_rate, kappa2 * p_rate);
    const Wide psi = w.angles.psi, phi = w.angles.phi;
    Gamma = narrow(psi, phi);
    heading = narrow(std::cos(w.angles.theta), std::sin(w.angles.theta));
    torque = narrow(w.torque[0], w.torque[1]);
    momentum = narrow(w.inertia[0] * p + L3 * phi, w.inertia[1] * q - L3 * psi);
    acceleration = narrow(w.force[0] / w.mass, w.force[1] / w.mass);
    axial_acceleration = static_cast<Scalar>(w.force[2] / w.mass);
    axial_momentum = static_cast<Scalar>(std::sin(psi) * w.inertia[1] * q +
                                         std::cos(psi) * (std::cos(phi) * L3 - std::sin(phi) * w.inertia[0] * p));
    charge_momentum = problem.charge_momentum;
  }
};

/// The exact motion for small tilt and constant spin, any D1, D2, D3, any sign of the spin and of the stiffnesses
/// (docs/spinning.md, section 3):
///     r = r0,   p' = M1/D1 - kappa1 q,   q' = M2/D2 + kappa2 p,   Gamma' + i r0 Gamma = p + i q,   theta' = r0,
///     G' = e^(i theta)(M - i e_H (p + i q)),   m v' = e^(i theta)(f - i f3 Gamma),   m v3' = f3 - phi f1 + psi f2,   x' = v.
/// The attitude is the rotation of the three angles, whatever their size. The momentum along inertial axis 3 obeys the same
/// balance to second order in the tilt, G3 = G3(0) + Re(i M~ int Gamma) - e_H (|Gamma|^2 - |Gamma0|^2)/2, for a constant L3
/// would be the least accurate of all columns. Nothing is divided by nu, r0 or r0 +- nu: resonances, a sphere, zero spin and
/// unstable spin are points like all others. Relative error: some eps of the phases (|r0| + |nu|) t.
template <Real Scalar>
class Linear {
 public:
  explicit Linear(const Problem<Scalar>& problem) noexcept
      : problem_(problem),
        start_(problem),
        functions_(problem),
        pushed_(problem.force[0] != 0 || problem.force[1] != 0 || problem.torque[0] != 0 || problem.torque[1] != 0) {}

  /// The spin is constant to first order: no torque about axis 3.
  bool applies() const noexcept { return problem_.torque[2] == 0; }

  const Problem<Scalar>& problem() const noexcept { return problem_; }

  /// At any t of either sign; at t = 0 the start itself.
  State<Scalar> at(Scalar t) const noexcept {
    using math::conjugate, math::turned;
    const auto& s = start_;
    const LinearValues<Scalar> f = functions_.at(t, pushed_);
    const Complex Pi = s.Pi + f.S * s.b + f.V * s.d;
    // int e^(i r0 s) Pi ds, its integral, and the integral of that
    Complex I[4];
    for (int k = 1; k <= 3; ++k) I[k] = s.Pi * f.E[k] + s.b * f.J[k] + s.d * f.K[k];
    const Complex Gamma = conjugate(f.spin) * (s.Gamma + I[1]);
    const Scalar half_t2 = t * t / 2;
    const Complex pull = s.axial_acceleration * turned(s.heading);
    const Complex v = s.heading * (s.acceleration * f.E[1]) - pull * (t * s.Gamma + I[2]);
    const Complex x = s.heading * (s.acceleration * f.E[2]) - pull * (half_t2 * s.Gamma + I[3]);
    const Complex G = s.heading * (s.momentum + s.torque * f.E[1] - s.charge_momentum * turned(I[1]));
    Scalar G3 = s.axial_momentum - s.charge_momentum * (squared(Gamma) - squared(s.Gamma)) / 2;
    Scalar v3 = s.axial_acceleration * t, x3 = s.axial_acceleration * half_t2;
    if (pushed_) {
      // int Gamma and its integral
      Complex B[3];
      for (int k = 1; k <= 2; ++k)
        B[k] = s.Gamma * conjugate(f.E[k]) + s.Pi * conjugate(f.E[k + 1]) + s.b * f.H[k] + s.d * f.H[k + 1];
      G3 += across(s.torque, B[1]);
      v3 += across(s.acceleration, B[1]);
      x3 += across(s.acceleration, B[2]);
    }
    const auto& p = problem_;
    State<Scalar> state;
    state.angular_velocity = {Pi.re, Pi.im, p.spin()};
    state.angles = {Gamma.re, Gamma.im, p.spin() * t + p.angles.theta};
    state.attitude = quaternion_from_312(state.angles.psi, state.angles.phi, state.angles.theta);
    state.momentum_I = {G.re, G.im, G3};
    state.velocity = {p.velocity[0] + v.re, p.velocity[1] + v.im, p.velocity[2] + v3};
    state.position = {p.position[0] + p.velocity[0] * t + x.re, p.position[1] + p.velocity[1] * t + x.im,
                      p.position[2] + p.velocity[2] * t + x3};
    return state;
  }

  /// states[i] at times[i], in any order; as many as both spans hold.
  void at(std::span<const Scalar> times, std::span<State<Scalar>> states) const noexcept {
    for (std::size_t i = 0; i < times.size() && i < states.size(); ++i) states[i] = at(times[i]);
  }

 private:
  using Complex = math::Complex<Scalar>;

  static Scalar squared(Complex a) noexcept { return a.re * a.re + a.im * a.im; }
  /// Re(i a~ b): along inertial axis 3, to first order, of a body vector a under the tilt b.
  static Scalar across(Complex a, Complex b) noexcept { return a.im * b.re - a.re * b.im; }

  Problem<Scalar> problem_;
  LinearStart<Scalar> start_;
  LinearFunctions<Scalar> functions_;
  bool pushed_;  ///< a transverse force or torque acts: int Gamma is needed
};

}  // namespace gyrostat::spinning
