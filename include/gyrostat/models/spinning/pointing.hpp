// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/problem.hpp"

/// Where a thrusting spinner points, how far it tilts and what its spin is near to, from its numbers alone: means and bounds
/// of the linear motion (docs/spinning.md, sections 3 and 5). Complex: component 1 + i component 2.
namespace gyrostat::spinning {

/// The rates that the closed form divides by, 1/s, all >= 0.
template <Real Scalar>
struct Divisors {
  Scalar nu;          ///< |nu|
  Scalar spin;        ///< |r0|
  Scalar sum;         ///< |r0 + nu| for nu > 0 and r0 > 0
  Scalar difference;  ///< |r0 - nu|, without cancellation: from r0^2 - nu^2 = X (r0 (D1 + D2) - X)/(D1 D2)

  Scalar least() const noexcept { return std::min({nu, spin, sum, difference}); }
};

/// Divisors of a problem, in the wider arithmetic of linear.hpp.
template <Real Scalar>
Divisors<Scalar> divisors(const Problem<Scalar>& problem) noexcept {
  using Wide = detail::Wide<Scalar>;
  const auto w = detail::problem_cast<Wide>(problem);
  const Wide r = w.spin(), X = w.effective_momentum(), nu2 = w.nutation_squared();
  const Wide nu = std::sqrt(std::abs(nu2)), spin = std::abs(r);
  Divisors<Scalar> d{static_cast<Scalar>(nu), static_cast<Scalar>(spin), 0, 0};
  if (nu2 < 0) {
    d.sum = d.difference = static_cast<Scalar>(std::hypot(r, nu));
  } else {
    const Wide sum = spin + nu;
    d.sum = static_cast<Scalar>(sum);
    const Wide apart = X / w.inertia[0] * ((r * (w.inertia[0] + w.inertia[1]) - X) / w.inertia[1]);
    d.difference = sum == 0 ? Scalar(0) : static_cast<Scalar>(std::abs(apart) / sum);
  }
  return d;
}

/// What makes the tilt grow.
struct SpinFlags {
  bool unstable;   ///< nu^2 <= 0: the rates grow, exponentially or, at 0, with t
  bool resonant;   ///< | |r0| - nu | is below a hundredth of |r0| + nu: the tilt grows over many turns
  bool compliant;  ///< |X| is below a hundredth of |r0| (D1 + D2): no gyroscopic stiffness
};

/// SpinFlags of a problem.
template <Real Scalar>
SpinFlags spin_flags(const Problem<Scalar>& problem) noexcept {
  const auto d = divisors(problem);
  const bool unstable = !(problem.nutation_squared() > 0);
  const Scalar size = std::abs(problem.spin()) * (problem.inertia[0] + problem.inertia[1]);
  return {unstable, !unstable && d.difference <= Scalar(0.01L) * d.sum,
          std::abs(problem.effective_momentum()) <= Scalar(0.01L) * size};
}

/// How far the torque pushes the mean direction of the spin axis, rad: |M|/|r0 X|. Infinite where r0 X = 0. A spin that is not stable
/// (spin_flags) has no mean direction, and this is but the number.
template <Real Scalar>
Scalar pointing_error(const Problem<Scalar>& problem) noexcept {
  const Scalar torque = std::hypot(problem.torque[0], problem.torque[1]);
  return torque == 0 ? Scalar(0) : torque / std::abs(problem.spin() * problem.effective_momentum());
}

/// Mean of e^(i theta)(psi + i phi), rad, where the spin is stable; the spin axis points to -i times it:
///     e^(i theta0) [Gamma0 + (i (D1 p0 + i D2 q0) - M/r0)/X].
template <Real Scalar>
math::Complex<Scalar> mean_tilt(const Problem<Scalar>& problem) noexcept {
  const auto &D = problem.inertia, &w = problem.angular_velocity, &M = problem.torque;
  const Scalar X = problem.effective_momentum(), r0 = problem.spin();
  const auto pushed = [r0](Scalar torque) noexcept { return torque == 0 ? Scalar(0) : torque / r0; };
  const math::Complex<Scalar> tilt{problem.angles.psi - (D[1] * w[1] + pushed(M[0])) / X,
                                   problem.angles.phi + (D[0] * w[0] - pushed(M[1])) / X};
  return math::unit(problem.angles.theta) * tilt;
}

/// Limit of (v1 + i v2)/v3 as t grows, where the spin is stable: the mean direction of the thrust. NaN without force.
template <Real Scalar>
math::Complex<Scalar> secular_velocity_ratio(const Problem<Scalar>& problem) noexcept {
  const auto &D = problem.inertia, &M = problem.torque, &f = problem.force;
  const Scalar r0 = problem.spin();
  const auto rest = [r0](Scalar torque, Scalar D_kappa) noexcept {
    return torque == 0 ? Scalar(0) : torque / (r0 * D_kappa);
  };
  const Scalar psi = rest(M[0], D[0] * problem.kappa1(r0)), phi = rest(M[1], D[1] * problem.kappa2(r0));
  return (-f[2] / (f[2] + f[1] * psi - f[0] * phi)) * math::turned(mean_tilt(problem));
}

/// G(t) = centre + radius e^(i phase(t)) - i e_H e^(i theta) (psi + i phi): without charge the momentum runs on a circle
/// whatever the body. Divided by L3 it is the direction of the momentum. NaN where r0 = 0.
template <Real Scalar>
struct MomentumCircle {
  math::Complex<Scalar> centre;  ///< N m s
  Scalar radius;                 ///< |M|/|r0|, N m s
};

/// MomentumCircle of a problem.
template <Real Scalar>
MomentumCircle<Scalar> momentum_circle(const Problem<Scalar>& problem) noexcept {
  const LinearStart<Scalar> s(problem);
  const auto pushed = s.torque / problem.spin();
  return {s.heading * (s.momentum + math::turned(s.charge_momentum * s.Gamma + pushed)), magnitude(pushed)};
}

/// Upper bounds of the linear motion over [0, T].
template <Real Scalar>
struct Amplitudes {
  Scalar tilt;  ///< g >= |psi + i phi|, rad
  Scalar rate;  ///< P >= |p + i q|, rad/s
};

/// The modes of the rates, p + i q = constant + up e^(lambda t) + down e^(-lambda t), lambda = i nu, or |nu| where unstable.
/// Infinite or NaN where nu = 0.
template <Real Scalar>
struct RateModes {
  math::Complex<Scalar> lambda, constant, up, down;

  RateModes(const LinearStart<Scalar>& start, Scalar nutation_squared) noexcept {
    const Scalar nu = std::sqrt(std::abs(nutation_squared));
    lambda = nutation_squared < 0 ? math::Complex<Scalar>{nu, 0} : math::Complex<Scalar>{0, nu};
    const auto first = start.b * math::inverse(lambda);
    const auto second = start.d / -nutation_squared;
    constant = start.Pi - second;
    up = (second + first) / Scalar(2);
    down = (second - first) / Scalar(2);
  }
};

namespace detail {

/// |int_0^t e^(z s) ds| for t in [0, T] at most.
template <Real Scalar>
Scalar greatest_integral(math::Complex<Scalar> z, Scalar T) noexcept {
  const Scalar growth = z.re > 0 ? std::exp(z.re * T) : Scalar(1);
  return std::min(T * growth, (1 + growth) / magnitude(z));
}

/// min that passes over NaN.
template <Real Scalar>
void lower(Scalar& bound, Scalar other) noexcept {
  if (other < bound) bound = other;
}

}  // namespace detail

/// Bounds that hold at resonance, with unstable and with vanishing nutation too, and grow with T, T > 0. Where the modes are
/// well apart, sums of their amplitudes, else of the greatest values of the functions of linear_functions.hpp.
template <Real Scalar>
Amplitudes<Scalar> amplitudes(const Problem<Scalar>& problem, Scalar T) noexcept {
  using math::Complex;
  const LinearStart<Scalar> s(problem);
  const Scalar nu2 = static_cast<Scalar>(detail::problem_cast<detail::Wide<Scalar>>(problem).nutation_squared());
  const Scalar nu = std::sqrt(std::abs(nu2)), spin = std::abs(problem.spin());
  const bool unstable = nu2 < 0;

  // greatest S, V, int |S| and int |V|
  const Scalar x = nu * T;
  Scalar S = T, V = T * T / 2, int_S = V, int_V = T * T * T / 6;
  if (unstable) {
    const Scalar half = x == 0 ? T / 2 : std::sinh(x / 2) / nu;
    S = x == 0 ? T : std::sinh(x) / nu;
    V = int_S = 2 * half * half;
    int_V *= std::cosh(x);
  } else {
    S = std::min(S, 1 / nu);
    V = std::min(V, 2 / (nu * nu));
    int_S = std::min(int_S, T / nu);
    int_V = std::min(int_V, 2 * T / (nu * nu));
  }
  const Scalar Pi = magnitude(s.Pi), Gamma = magnitude(s.Gamma), b = magnitude(s.b), d = magnitude(s.d);

  const RateModes<Scalar> modes(s, nu2);
  const Scalar constant = magnitude(modes.constant), up = magnitude(modes.up), down = magnitude(modes.down);
  const Scalar growth = unstable ? std::exp(x) : Scalar(1);
  const Scalar moved = unstable ? growth - 1 : std::min(x, Scalar(2));
  Scalar rate = Pi + b * S + d * V;
  detail::lower(rate, constant + up * growth + down);
  detail::lower(rate, Pi + up * moved + down * (unstable ? Scalar(1) : moved));

  const Complex<Scalar> turn{0, problem.spin()};
  const Complex<Scalar> plus = turn + modes.lambda, minus = turn - modes.lambda;
  const Scalar E = detail::greatest_integral(turn, T);
  const Scalar E_plus = detail::greatest_integral(plus, T), E_minus = detail::greatest_integral(minus, T);
  // by parts: e^(i r0 s) is integrated once
  Scalar J = int_S, K = int_V;
  detail::lower(J, (S + (unstable ? S : (E_plus + E_minus) / 2)) / spin);
  detail::lower(K, (V + J) / spin);
  Scalar tilt = Gamma + Pi * E + b * J + d * K;
  detail::lower(tilt, Gamma + rate * T);
  detail::lower(tilt, Gamma + constant * E + up * E_plus + down * E_minus);
  if (!unstable) {
    const auto rest = modes.constant * math::inverse(turn), with = modes.up * math::inverse(plus),
               against = modes.down * math::inverse(minus);
    detail::lower(tilt,
                  magnitude(s.Gamma - rest - with - against) + magnitude(rest) + magnitude(with) + magnitude(against));
  }
  return {tilt, rate};
}

}  // namespace gyrostat::spinning
