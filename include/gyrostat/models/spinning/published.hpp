// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "gyrostat/models/spinning/problem.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The closed forms of the paper on a thrusting, charged, spinning body with a rotor, with all their divisors
/// (docs/spinning.md, section 7). For the reproduction of its figures only. Complex: component 1 + i component 2.
namespace gyrostat::spinning::published {

enum class Reading : std::uint8_t {
  printed,    ///< literally; brackets that are never closed are closed, zeta3 and zeta4 of (64) are those of (23)
  corrected,  ///< without the misprints; the nutation is still that of D1 = D2, right where that or Lambda = 0 holds
  exact,      ///< with kappa for zeta: the linear motion, but for what the divisors lose
};

/// The motion at one time, by equation.
template <Real Scalar>
struct Values {
  using Complex = math::Complex<Scalar>;

  Complex rates;          ///< (22) p + i q, rad/s
  Complex tilt;           ///< (20) psi + i phi, rad
  Scalar spin_angle;      ///< (16) theta, rad
  Complex momentum;       ///< (33) G, N m s
  Complex circle;         ///< (35) G without rotor and charge; corrected, its balance (L5), N m s
  Complex velocity;       ///< (43), m/s
  Scalar axial_velocity;  ///< (47), m/s
  Complex position;       ///< (58), m
  Scalar axial_position;  ///< (63), m
};

/// The motion for M3 = 0. As printed, a prolate body (zeta1, zeta2 < 0) takes imaginary roots; about a middle axis the
/// values are NaN in every reading, and at nu = 0, r0 = 0 and r0 = +- nu too.
template <Real Scalar>
class Motion {
 public:
  Motion(const Problem<Scalar>& problem, Reading reading) noexcept
      : problem_(problem), start_(problem), printed_(reading == Reading::printed) {
    const auto& D = problem.inertia;
    const Scalar r0 = problem.spin();
    const Scalar zeta1 = (D[2] - D[1]) / D[0], zeta2 = (D[2] - D[0]) / D[1];
    const bool exact = reading == Reading::exact;
    const Scalar first = exact ? problem.kappa1(r0) : zeta1, second = exact ? problem.kappa2(r0) : zeta2;
    const Scalar size = std::sqrt(first * second);
    const Scalar zeta = printed_ ? size : std::copysign(size, first);
    const Scalar charged = problem.gyroscopic() / (zeta1 * D[0]);
    nu_ = exact ? zeta : zeta * (r0 + charged);
    misread_ = r0 - zeta * (r0 + zeta * charged);
    const Complex root1 = root(first), root2 = root(second);
    sum_ = (root1 + root2) / (2 * size);
    difference_ = (root1 - root2) / (2 * size);
    Pi1_ = start_.Pi.re * root2 + start_.Pi.im * math::turned(root1);
    const Complex A = problem.torque[0] / D[0] * root2 + problem.torque[1] / D[1] * math::turned(root1);
    centre_ = math::turned(A) / nu_;
  }

  /// nu, 1/s, of the sign of zeta r0 unless printed.
  Scalar nutation() const noexcept { return nu_; }

  Values<Scalar> at(Scalar t) const noexcept {
    using math::turned, math::unit, math::conjugate;
    const auto& s = start_;
    const auto& p = problem_;
    const Scalar r0 = p.spin(), a = r0 + nu_, b = r0 - nu_, square = t * t / 2;
    // int e^(i w t) and its integrals: each from the one before, which less its value for w = 0 is divided by i w
    const auto next = [](Complex last, Scalar still, Scalar w) noexcept {
      return turned(Complex{still, 0} - last) / w;
    };
    const auto once = [&](Scalar w) noexcept { return next(unit(w * t), 1, w); };
    const auto twice = [&](Scalar w) noexcept { return next(once(w), t, w); };
    const auto thrice = [&](Scalar w) noexcept { return next(twice(w), square, w); };

    Values<Scalar> y;
    y.rates = combined(unit(nu_ * t), unit(-nu_ * t), {1, 0}, conjugate(Pi1_));
    const Complex I_Gamma = combined(once(a), once(b), once(r0), conjugate(Pi1_));
    y.tilt = unit(-r0 * t) * (s.Gamma + I_Gamma);
    y.spin_angle = r0 * t + p.angles.theta;
    const Complex L = p.inertia[0] * Complex{y.rates.re, 0} + p.inertia[1] * Complex{0, y.rates.im};
    y.momentum = unit(y.spin_angle) * (L - p.axial_momentum() * turned(y.tilt));

    // (46), (61), (50), (51), (65), (66): what is integrated once more
    const Complex b_once = printed_ ? -next(unit(misread_ * t), 1, b) : once(b);
    const Complex b_twice = printed_ ? next(turned(unit(b * t)) / b, t, b) : twice(b);
    const Complex I_omega = combined(twice(a), next(b_once, t, b), twice(r0), conjugate(Pi1_));
    const Complex I_eta = combined(thrice(a), next(b_twice, square, b), thrice(r0), conjugate(Pi1_));
    Complex I3_omega, I3_eta;
    if (printed_) {
      y.circle = s.torque * once(r0);
      I3_omega = combined(next(-once(a), t, a), twice(b), twice(r0), conjugate(Pi1_));
      I3_eta = combined(thrice(a), next(next(-once(b), t, b), square, b), thrice(r0), Pi1_);
    } else {
      y.circle = s.heading * (s.momentum + s.torque * once(r0) - s.charge_momentum * turned(I_Gamma));
      // with the factor e^(-i r0 tau) that (50), (51) and their integrals forget
      const auto turned_back = [](Complex with, Complex without, Scalar w) noexcept {
        return turned(without - with) / w;
      };
      const Complex back = once(-r0), back2 = twice(-r0);
      I3_omega = combined(turned_back(once(nu_), back, a), turned_back(once(-nu_), back, b),
                          turned_back({t, 0}, back, r0), conjugate(Pi1_));
      I3_eta = combined(turned_back(twice(nu_), back2, a), turned_back(twice(-nu_), back2, b),
                        turned_back({square, 0}, back2, r0), conjugate(Pi1_));
    }
    const Complex f = s.acceleration, pull = s.axial_acceleration * turned(s.heading);
    const Complex v0{p.velocity[0], p.velocity[1]}, x0{p.position[0], p.position[1]};
    const Complex drift = turned(f) / r0;
    const Complex swing = (unit(r0 * t) - Complex{1, 0}) * f / (r0 * r0);
    y.velocity = v0 + s.heading * (f * once(r0)) - pull * (t * s.Gamma + I_omega);
    y.position =
        x0 + t * (v0 + s.heading * drift) + s.heading * (printed_ ? swing : -swing) - pull * (square * s.Gamma + I_eta);
    const auto along = [f](Complex I) noexcept { return f.re * -I.im + f.im * I.re; };  // Re(i f~ I)
    y.axial_velocity = p.velocity[2] + s.axial_acceleration * t + along(s.Gamma * once(-r0) + I3_omega);
    y.axial_position =
        p.position[2] + p.velocity[2] * t + s.axial_acceleration * square + along(s.Gamma * twice(-r0) + I3_eta);
    return y;
  }

 private:
  using Complex = math::Complex<Scalar>;

  Complex root(Scalar zeta) const noexcept {
    const Scalar size = std::sqrt(std::abs(zeta));
    return printed_ && zeta < 0 ? Complex{0, size} : Complex{size, 0};
  }

  /// (23) and those built like it: of Pi1 = Pi10 e^(i nu t) + (i A/nu)(1 - e^(i nu t)) and its conjugate, with what stands for
  /// e^(i nu t), for e^(-i nu t) and for 1.
  Complex combined(Complex forward, Complex backward, Complex still, Complex start) const noexcept {
    const Complex first = Pi1_ * forward + centre_ * (still - forward);
    const Complex second = start * backward + math::conjugate(centre_) * (still - backward);
    return sum_ * first + difference_ * second;
  }

  Problem<Scalar> problem_;
  LinearStart<Scalar> start_;
  bool printed_;
  Scalar nu_, misread_;  // misread_: the exponent of (46), zeta within zeta [...]
  Complex sum_, difference_, Pi1_, centre_;
};

/// (53), (54), for a start at rest: printed with D3 r0^2 and zeta D r0^2 for r0 X and r0 D kappa.
template <Real Scalar>
math::Complex<Scalar> secular_velocity_ratio(const Problem<Scalar>& problem, Reading reading) noexcept {
  Problem<Scalar> still = problem;
  still.angular_velocity = {0, 0, problem.spin()};
  still.angles = {0, 0, problem.angles.theta};
  if (reading == Reading::printed) {
    still.rotor_momentum = still.charge_momentum = 0;
    still.angles.theta = 0;
  }
  return spinning::secular_velocity_ratio(still);
}

/// What the text on figure 12 says of G, for a start at rest: a centre divided by D3 r0, and a root too far.
template <Real Scalar>
MomentumCircle<Scalar> momentum_circle(const Problem<Scalar>& problem, Reading reading) noexcept {
  if (reading != Reading::printed) return spinning::momentum_circle(problem);
  const Scalar r0 = problem.spin(), scale = problem.inertia[2] * r0 * r0;
  const math::Complex<Scalar> M{problem.torque[0], problem.torque[1]};
  return {math::turned(M) / scale, std::sqrt((M.re * M.re + M.im * M.im) / scale)};
}

/// (30), body to inertial. Printed, it is no rotation.
template <Real Scalar>
Mat3<Scalar> direction_cosines(const Angles<Scalar>& angles, Reading reading) noexcept {
  Mat3<Scalar> R = to_matrix(quaternion_from_312(angles.psi, angles.phi, angles.theta));
  if (reading == Reading::printed)
    R(1, 2) = std::cos(angles.theta) * (std::sin(angles.phi) - std::sin(angles.psi) * std::cos(angles.phi));
  return R;
}

}  // namespace gyrostat::spinning::published
