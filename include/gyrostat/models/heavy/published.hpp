// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Equations (35) to (39) and Tables 1 and 2 of Ismail 2021, "The periodic rotary motions of a rigid body in a new domain of angular
/// velocity", J. Egypt. Math. Soc. 29:2, as printed, for their reproduction only (docs/heavy.md, sections 9 and 11). The errors
/// are left in; the right forms are Series2 and Series.
namespace gyrostat::heavy::published {

/// What the small mu^-1 is: the paper says mu = c/r0; its equations of motion (1) hold with mu^-1 = c/r0 only.
enum class Reading : std::uint8_t {
  printed,     ///< mu^-1 = r0/c, and r0^-1 t in (38), (39)
  reciprocal,  ///< mu^-1 = c/r0, and r0 t
};

template <Real Scalar>
struct Data {
  Scalar a, b, k;   ///< A/C, B/C, N/c^2
  Vec3<Scalar> at;  ///< x0', y0', z0'
  Scalar G0;        ///< gamma_0''
  Scalar c;         ///< sqrt(M g l/C), rad/s
  Scalar r0;        ///< rad/s

  Scalar small(Reading reading) const noexcept { return reading == Reading::printed ? r0 / c : c / r0; }  ///< mu^-1
  Scalar A1() const noexcept { return (1 - b) / a; }
  Scalar B1() const noexcept { return (a - 1) / b; }
  Scalar C1() const noexcept { return b - a; }
  Scalar chi1() const noexcept {
    const Scalar omega2 = -A1() * B1();
    return (-at[2] * (1 / a - A1() / b) + k * G0 * (A1() - omega2)) / (1 - omega2);
  }
  Scalar chi2() const noexcept { return chi1() + at[2] / a - k * A1() * G0; }
};

/// p1, q1, r1, gamma, gamma', gamma''.
template <Real Scalar>
using Values = std::array<Scalar, 6>;

/// (35), with M3 = 1 of (29) and mu^-1 Gamma = gamma_0'' of (28).
template <Real Scalar>
Values<Scalar> motion(const Data<Scalar>& d, Reading reading, Scalar tau) noexcept {
  const Scalar e = d.small(reading), e2 = e * e, C1 = d.C1(), G0 = d.G0, k = d.k;
  const Scalar x = d.at[0] / (1 - d.a) * G0, y = d.at[1] / (1 - d.b) * G0, z = d.at[2] / (d.a + d.b - 1);
  const Scalar c = std::cos(tau), s = std::sin(tau), c2 = std::cos(2 * tau);
  return {e * (x + d.chi1() * c),
          e * (y + d.chi2() / d.A1() * s),
          1 - e2 / 4 * (k * C1 + 4 * d.at[0] * (1 - c) + d.at[1] * s - k * C1 * c2),
          c - G0 * G0 / 2 * c,
          -s + G0 * G0 / 2 * s,
          G0 + e2 * (x - C1 / 2 * (z + k * G0 / 2) - x * c + y * s + C1 / 4 * (2 * z + k * G0) * c2)};
}

/// alpha of (36), the period less 2 pi n, with M3 = 1.
template <Real Scalar>
Scalar period_correction(const Data<Scalar>& d, Reading reading, int n = 1) noexcept {
  const Scalar e = d.small(reading), G0 = d.G0, B1 = d.B1();
  return 2 * e * e * pi<Scalar> * Scalar(n) *
         (d.at[0] - d.at[2] * G0 - d.k / 2 * (G0 * G0 * (d.b * B1 - d.a * d.A1()) + B1 * G0 * (1 - G0) - d.C1() / 8));
}

/// The share of k in (35) and (36) by (37): the six values, and alpha.
template <Real Scalar>
struct FieldShare {
  Values<Scalar> values;
  Scalar period;
};
template <Real Scalar>
FieldShare<Scalar> field_share(const Data<Scalar>& d, Reading reading, Scalar tau, int n = 1) noexcept {
  const Scalar e = d.small(reading), e2 = e * e, A1 = d.A1(), B1 = d.B1(), C1 = d.C1(), G0 = d.G0, k = d.k;
  const Scalar omega2 = -A1 * B1, share = k * G0 * (A1 - omega2) / (1 - omega2), turned = 1 - std::cos(2 * tau);
  return {{e * share * std::cos(tau), e / A1 * (share - k * A1 * G0) * std::sin(tau), -e2 / 4 * k * C1 * turned, 0, 0,
           -e2 / 4 * C1 * k * G0 * turned},
          -e2 * pi<Scalar> * Scalar(n) * k * (G0 * G0 * (d.b * B1 - d.a * A1) - (d.b - d.a) / 2 + B1 * G0 * (1 - G0))};
}

/// theta - theta_0, psi - psi_0 and phi - phi_0 of (38), (39) at t, t_0 = 0: rad (of psi the printed last term is a rate, rad/s).
template <Real Scalar>
std::array<Scalar, 3> angles(const Data<Scalar>& d, Reading reading, Scalar t) noexcept {
  const Scalar e = d.small(reading), G0 = d.G0, rate = reading == Reading::printed ? 1 / d.r0 : d.r0;
  const Scalar x = d.at[0] / (1 - d.a) * G0, y = d.at[1] / (1 - d.b) * G0, mean = d.chi1() - d.chi2() / d.A1();
  const auto theta2 = [&](Scalar u) noexcept {
    const Scalar third = Scalar(0.667L);
    return y * std::sin(u) - x * std::cos(u) +
           d.C1() / 2 * (d.at[2] / (d.a + d.b - 1) - third * d.k * G0) * std::cos(2 * u);
  };
  const auto psi1 = [&](Scalar u) noexcept {
    return (d.chi1() + d.chi2() / d.A1()) / 4 + std::sin(2 * u) + y * std::cos(u) + x * std::sin(u);
  };
  const Scalar precession = d.c * d.c / d.r0 * mean / 2, u = rate * t, sine = std::sqrt((1 - G0) * (1 + G0));
  return {e * e / sine * (theta2(u) - theta2(0)), precession * t + e * d.c * (psi1(u) - psi1(0)),
          (rate - G0 * precession) * t};
}

/// A row of Tables 1 and 2: p2 over its first value, gamma2, and their derivatives (over tau, though printed as over t).
template <Real Scalar>
struct Row {
  Scalar t, p2, gamma2, p2_rate, gamma2_rate;
};

/// Table 1, "the analytical solutions": cos and -sin of 2 pi t/100, for p2 too: omega = 1, which the paper leaves out.
template <Real Scalar>
Row<Scalar> table_1(int i) noexcept {
  const Scalar u = 2 * pi<Scalar> * Scalar(i) / 10, c = std::cos(u), s = -std::sin(u);
  return {Scalar(10 * i), c, c, s, s};
}

/// Table 2, "the numerical solutions": the classical Runge-Kutta method on y'' = -omega^2 y from y = 1, y' = 0 with 20 steps a period
/// of gamma2, two to a row; omega = 1 for gamma2 and 0.996079, which fits its figures, for p2.
template <Real Scalar>
Row<Scalar> table_2(int i) noexcept {
  const auto oscillator = [i](Scalar omega) noexcept {
    const Scalar h = pi<Scalar> / 10, stiffness = omega * omega;
    std::array<Scalar, 2> y{1, 0};
    for (int step = 0; step < 2 * i; ++step) {
      const auto along = [&](const std::array<Scalar, 2>& k, Scalar by) noexcept {
        return std::array<Scalar, 2>{y[1] + by * k[1], -stiffness * (y[0] + by * k[0])};
      };
      const auto k1 = along({0, 0}, 0), k2 = along(k1, h / 2), k3 = along(k2, h / 2), k4 = along(k3, h);
      for (std::size_t j = 0; j < 2; ++j) y[j] += h / 6 * (k1[j] + 2 * (k2[j] + k3[j]) + k4[j]);
    }
    return y;
  };
  const auto p = oscillator(Scalar(0.996079L)), g = oscillator(Scalar(1));
  return {Scalar(10 * i), p[0], g[0], p[1], g[1]};
}

}  // namespace gyrostat::heavy::published
