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

/// Tilt, rad, up to which orders of it tell of errors: beyond it sizes alone do, as if nothing swung or cancelled.
inline constexpr double small_tilt = 0.3;

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

/// What nutation adds to the spin angle over [0, T], half the integral of Im(Pi Gamma~): its greatest value, and that of the same modes if
/// none of their mean rates cancelled; from the modes where these are apart, else from g and P.
template <Real Scalar>
struct NutationPhase {
  Scalar net, gross;

  NutationPhase(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, const Amplitudes<Scalar>& size,
                Scalar T) noexcept {
    net = gross = size.tilt * size.rate * T / 2;
    const Scalar nu2 = problem.nutation_squared(), r0 = problem.spin();
    if (!(nu2 > 0)) return;
    const RateModes<Scalar> modes(start, nu2);
    const Scalar nu = modes.lambda.im;
    const Scalar turning[] = {r0, r0 + nu, r0 - nu};
    const math::Complex<Scalar> rates[] = {modes.constant, modes.up, modes.down};
    math::Complex<Scalar> still = start.Gamma;
    Scalar rate[3], tilt[3], steady = 0, all = 0, swings = 0;
    for (int j = 0; j < 3; ++j) {
      const auto of_tilt = rates[j] * math::inverse(math::Complex<Scalar>{0, turning[j]});
      still = still - of_tilt;
      rate[j] = magnitude(rates[j]);
      tilt[j] = magnitude(of_tilt);
      steady += rate[j] * rate[j] / turning[j];
      all += rate[j] * tilt[j];
    }
    const auto swing = [T](Scalar w) noexcept { return std::min(T, 2 / std::abs(w)); };
    for (int j = 0; j < 3; ++j) {
      swings += rate[j] * magnitude(still) * swing(turning[j]);
      for (int k = 0; k < 3; ++k)
        if (j != k) swings += rate[j] * tilt[k] * swing(turning[j] - turning[k]);
    }
    lower(net, (std::abs(steady) * T + swings) / 2);
    lower(gross, (all * T + swings) / 2);
  }
};

/// What the rates at the start make of errors where the spin is unstable, rad/s: third order of theirs and roundings, even where no mode of
/// the linear motion itself grows, as where the torque holds the body on its unstable axis. 0 where it is stable.
template <Real Scalar>
Scalar grown_error(const Problem<Scalar>& problem, const LinearStart<Scalar>& start, Scalar zeta, Scalar T) noexcept {
  const Scalar nu2 = problem.nutation_squared();
  if (!(nu2 < 0)) return 0;
  const Scalar mu = std::sqrt(-nu2), grown = std::exp(mu * T), once = std::min(T, 1 / mu);
  const Scalar sizes = magnitude(start.Pi) + (magnitude(start.b) + magnitude(start.d) * once) * once;
  const Scalar spin =
      std::abs(problem.inertia[0] - problem.inertia[1]) / (2 * problem.inertia[2]) * sizes * sizes * once;
  return sizes * (zeta * spin * once + 8 * epsilon<Scalar>)*grown;
}

/// By how much the linear motion errs in the transverse momentum at its start, which it takes to first order of the tilt, N m s.
template <Real Scalar>
Scalar momentum_left_out(const Problem<Scalar>& problem) noexcept {
  const auto less_sine = [](Scalar x) noexcept {
    const Scalar square = x * x;
    return square < Scalar(0.25L) ? x * square / 6 * (1 - square / 20) : x - std::sin(x);
  };
  const Scalar psi = problem.angles.psi, phi = problem.angles.phi, L3 = problem.axial_momentum();
  const Scalar G1 = problem.inertia[0] * problem.angular_velocity[0];
  const Scalar G2 = problem.inertia[1] * problem.angular_velocity[1];
  const Scalar less_psi = 2 * std::pow(std::sin(psi / 2), 2), less_phi = 2 * std::pow(std::sin(phi / 2), 2);
  return std::hypot(less_phi * G1 + less_sine(phi) * L3,
                    less_psi * G2 - std::sin(psi) * (std::sin(phi) * G1 + less_phi * L3) - less_sine(psi) * L3);
}

/// Greatest integral over [0, T] of an error of third order of the tilt that is 1 at most, and of what it makes of products with the tilt: it
/// swings with r0, nu, and with r0 less some nu, but for the cubes of what stands still.
template <Real Scalar>
Scalar third_order_swing(const Problem<Scalar>& problem, Scalar T) noexcept {
  const Divisors<Scalar> rates = divisors(problem);
  Scalar least = rates.least();
  if (problem.nutation_squared() > 0)
    for (const Scalar apart : {rates.spin - 2 * rates.nu, rates.spin - 3 * rates.nu, 2 * rates.spin - rates.nu})
      least = std::min(least, std::abs(apart));
  return std::min(T, 2 / least);
}

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
  Scalar swing = detail::third_order_swing(problem, T);

  LinearErrors<Scalar> error;
  error.size = size;
  const detail::NutationPhase<Scalar> nutation(problem, start, size, T);
  Scalar g = size.tilt, P = size.rate, rate = rho.rate, angle = rho.angle, net = nutation.net, gross = nutation.gross;
  const Scalar grown = detail::grown_error(problem, start, zeta, T);
  const auto third_order = [&]() noexcept {
    error.rates = skew * (P * zeta * rate * T + grown);
    error.tilt = (g * (2 * gross + angle) + g * g * g) / 2 + error.rates * answer;
  };
  third_order();
  if (!(g + error.tilt <= Scalar(small_tilt))) {
    net = gross = g * P * T;
    swing = T;
    third_order();
  }
  // the motion itself may be larger than the linear one by its error
  g += error.tilt;
  P += error.rates;
  const Scalar more = size.rate > 0 ? P / size.rate : Scalar(1);
  rate *= more * more;
  angle *= more * more;
  net *= more * more, gross *= more * more;
  third_order();

  // of the phase of the turning frame; and int e^(i theta) (this error), also by parts
  const Scalar phase = angle + net + g * g / 2;
  const Scalar turned = std::min(T * phase, (phase + T * (rate + g * P / 2)) / r0) + g * g * T / 2;
  const Scalar f = magnitude(start.acceleration), f3 = std::abs(start.axial_acceleration);
  const Scalar M = magnitude(start.torque), e = std::abs(start.charge_momentum);
  error.spin = Scalar(1.25L) * rate;
  error.theta = Scalar(1.25L) * (net + angle) + g * g / 2 + g * g * gross;
  error.attitude = std::hypot(error.theta, error.tilt);
  error.momentum =
      M * turned + e * (error.tilt + g * phase + g * g * g) + Scalar(1.25L) * detail::momentum_left_out(problem);
  error.axial_momentum = M * (swing * error.tilt + T * g * g * g / 2) + e * g * error.tilt;
  error.velocity = f * turned + f3 * (swing * error.tilt + T * g * g * g / 2);
  error.axial_velocity = f3 * g * g * T / 2 + f * (swing * error.tilt + T * g * g * g / 2);
  error.position = T * error.velocity / 2;
  error.axial_position = T * error.axial_velocity / 2;
  return error;
}

}  // namespace gyrostat::spinning
