// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"

namespace gyrostat::spinning {

/// Estimated greatest errors of the linear motion over [0, T] against the full equations, in units of the quantities; of a pair,
/// of its norm.
template <Real Scalar>
struct LinearErrors {
  Scalar rates;             ///< (p, q)
  Scalar spin;              ///< r
  Scalar tilt;              ///< (psi, phi)
  Scalar theta;             ///< spin angle
  Scalar attitude;          ///< angle of the rotation between the two attitudes, rad
  Scalar momentum;          ///< (G1, G2)
  Scalar axial_momentum;    ///< G3
  Scalar velocity;          ///< (v1, v2)
  Scalar axial_velocity;    ///< v3
  Scalar position;          ///< (x1, x2)
  Scalar axial_position;    ///< x3
  Amplitudes<Scalar> size;  ///< g and P, of which the estimates are made
};

namespace detail {

/// Greatest values over [0, T] of the change of the spin rate to second order, rho = ((D1 - D2)/(2 D3)) Im int Pi^2, and of
/// its integral (docs/spinning.md, section 6.1).
template <Real Scalar>
struct SpinChange {
  Scalar rate, angle;

  SpinChange(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar P, Scalar T) noexcept {
    const Scalar factor = std::abs(problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2]);
    rate = P * P * T;
    angle = rate * T / 2;
    const Scalar nu2 = problem.nutation_squared();
    const RateModes<Scalar> m(start, nu2);
    if (nu2 < 0) {
      const Scalar mu = m.lambda.re, growth = std::exp(mu * T);
      const Scalar c = magnitude(m.constant), u = magnitude(m.up) * growth, d = magnitude(m.down);
      lower(rate, c * c * T + (2 * c * u + u * u / 2 + 2 * c * d + d * d / 2) / mu + 2 * magnitude(m.up) * d * T);
      lower(angle, c * c * T * T / 2 + (2 * c * u + u * u / 4) / (mu * mu) + (2 * c * d + d * d / 2) * T / mu +
                       magnitude(m.up) * d * T * T);
    } else {
      const Scalar nu = m.lambda.im;
      const Scalar steady = std::abs(2 * m.constant.re * m.constant.im + 2 * (m.up * m.down).im);
      const Scalar once = 2 * magnitude(m.constant * m.up - conjugate(m.constant * m.down));
      const Scalar twice = magnitude(m.up * m.up - conjugate(m.down * m.down));
      const auto single = [T](Scalar w) noexcept { return std::min(T, 2 / w); };
      const auto both = [T, single](Scalar w) noexcept { return std::min(T * T / 2, (T + single(w)) / w); };
      lower(rate, steady * T + once * single(nu) + twice * single(2 * nu));
      lower(angle, steady * T * T / 2 + once * both(nu) + twice * both(2 * nu));
    }
    rate *= factor;
    angle *= factor;
  }
};

}  // namespace detail

/// At the cost of a few dozen operations; no bounds, but wide (docs/spinning.md, section 5.1a). T > 0.
template <Real Scalar>
LinearErrors<Scalar> linear_errors(const Problem<Scalar>& problem, Scalar T) noexcept {
  const LinearStart<Scalar> start(problem);
  const Amplitudes<Scalar> size = amplitudes(problem, T);
  const detail::SpinChange<Scalar> rho(problem, start, size.rate, T);
  const auto& D = problem.inertia;
  const Scalar r0 = std::abs(problem.spin());
  const Scalar kappa1 = std::abs(problem.kappa1(problem.spin())), kappa2 = std::abs(problem.kappa2(problem.spin()));
  const Scalar steep = std::max(kappa1, kappa2), flat = std::min(kappa1, kappa2);
  const Scalar zeta = std::max(std::abs(D[2] - D[1]) / D[0], std::abs(D[2] - D[0]) / D[1]);
  // greatest ratio of the rates' ellipse, or what it grows to within T
  const Scalar skew = std::min(1 + steep * T, std::sqrt(steep / flat));
  const Scalar answer = std::min(T, 2 / divisors(problem).least());

  LinearErrors<Scalar> error;
  error.size = size;
  Scalar g = size.tilt, P = size.rate, rate = rho.rate, angle = rho.angle;
  const auto third_order = [&]() noexcept {
    error.rates = skew * P * zeta * rate * T;
    error.tilt = g * (g * P * T + angle) + g * g * g + error.rates * answer;
  };
  third_order();
  // the motion itself may be larger than the linear one by its error
  g += error.tilt;
  P += error.rates;
  const Scalar more = size.rate > 0 ? P / size.rate : Scalar(1);
  rate *= more * more;
  angle *= more * more;
  third_order();

  // of the phase of the turning frame; and int e^(i theta) (this error), also by parts
  const Scalar phase = angle + g * P * T / 2 + g * g / 2;
  const Scalar turned = std::min(T * phase, (phase + T * (rate + g * P / 2)) / r0) + g * g * T / 2;
  const Scalar f = magnitude(start.acceleration), f3 = std::abs(start.axial_acceleration);
  const Scalar M = magnitude(start.torque), e = std::abs(start.charge_momentum);
  error.spin = Scalar(1.25L) * rate;
  error.theta = (g * g * r0 + g * P) * T + Scalar(1.25L) * angle + g * g / 2;
  error.attitude = std::hypot(error.theta, error.tilt);
  error.momentum = M * turned + e * (error.tilt + g * phase) +
                   g * g * (std::abs(problem.axial_momentum()) * g + std::max(D[0], D[1]) * P);
  error.axial_momentum = (M * T + e * g) * error.tilt;
  error.velocity = f * turned + f3 * T * error.tilt;
  error.axial_velocity = f3 * g * g * T / 2 + f * T * error.tilt;
  error.position = T * error.velocity;
  error.axial_position = T * error.axial_velocity;
  return error;
}

}  // namespace gyrostat::spinning
