// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/vector.hpp"

/// What a heavy body's motion keeps (docs/heavy.md, section 2).
namespace gyrostat::heavy {

/// The integrals that every motion has.
template <Real Scalar>
struct Integrals {
  Scalar energy, vertical_momentum, down_squared;  ///< J, N m s, 1
};

template <Real Scalar>
Integrals<Scalar> integrals(const Problem<Scalar>& problem, const State<Scalar>& state) noexcept {
  return {problem.energy(state), problem.vertical_momentum(state), state.down.squaredNorm()};
}

/// A case with a fourth integral.
enum class FourthCase : std::uint8_t {
  none,
  euler,                ///< no weight, no gradient: |I w|^2
  lagrange,             ///< an axis of symmetry through the mass centre: the rate about it
  clebsch,              ///< no weight: |I w|^2 - N (B C d1^2 + C A d2^2 + A B d3^2) (Brun, Clebsch)
  kovalevskaya,         ///< A = B = 2 C, centre in the plane of symmetry, no gradient
  goryachev_chaplygin,  ///< A = B = 4 C, centre in the plane of symmetry, no gradient, sigma = 0
};

/// The fourth integral of a motion, where it has one: conditions are taken for met within 8 roundings of the moments, of the
/// centre's distance, and (sigma = 0) of |I w| |d|.
template <Real Scalar>
class FourthIntegral {
 public:
  FourthIntegral(const Problem<Scalar>& problem, const State<Scalar>& start) noexcept
      : inertia_(problem.inertia()), gradient_(problem.gradient()) {
    const Vec3<Scalar> m = problem.moment();
    const Vec3<Scalar>& I = inertia_;
    constexpr Scalar slack = 8 * epsilon<Scalar>;
    const auto equal = [](Scalar a, Scalar b) noexcept { return std::abs(a - b) <= slack * std::abs(b); };
    const Scalar weight = magnitude(m);
    if (weight == 0 && gradient_ == 0) {
      kind_ = FourthCase::euler;
      return;
    }
    if (equal(I[0], I[1]) && equal(I[1], I[2]) && equal(I[0], I[2])) {
      kind_ = FourthCase::lagrange;
      axis_ = weight > 0 ? Vec3<Scalar>(m / weight) : Vec3<Scalar>(0, 0, 1);
      return;
    }
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (!equal(I[i], I[j])) continue;
      if (std::hypot(m[i], m[j]) <= slack * weight) {
        kind_ = FourthCase::lagrange;
        axis_ = Vec3<Scalar>::Unit(k);
        return;
      }
      if (gradient_ != 0 || std::abs(m[k]) > slack * weight) continue;
      axis_ = Vec3<Scalar>::Unit(k);
      pull_ = m / I[k];
      const Scalar momentum = inertia_.cwiseProduct(start.angular_velocity).norm() * start.down.norm();
      if (equal(I[i], 2 * I[k])) {
        kind_ = FourthCase::kovalevskaya;
        return;
      }
      if (equal(I[i], 4 * I[k]) && std::abs(problem.vertical_momentum(start)) <= slack * momentum) {
        kind_ = FourthCase::goryachev_chaplygin;
        return;
      }
    }
    if (weight == 0) kind_ = FourthCase::clebsch;
  }

  FourthCase kind() const noexcept { return kind_; }

  /// Constant along the motion; NaN where there is none. Units: (N m s)^2 (euler, clebsch), rad/s, (rad/s)^4, (rad/s)^3.
  Scalar operator()(const State<Scalar>& s) const noexcept {
    const Vec3<Scalar>&w = s.angular_velocity, &d = s.down, &I = inertia_;
    switch (kind_) {
      case FourthCase::none: break;
      case FourthCase::euler: return I.cwiseProduct(w).squaredNorm();
      case FourthCase::lagrange: return axis_.dot(w);
      case FourthCase::clebsch:
        return I.cwiseProduct(w).squaredNorm() -
               gradient_ * Vec3<Scalar>(I[1] * I[2], I[2] * I[0], I[0] * I[1]).dot(d.cwiseAbs2());
      // with the rates and d across the axis as complex numbers: |w^2 + h d|^2, and r |w|^2 + Re(h~ w) d3
      case FourthCase::kovalevskaya: {
        const Complex rate = across(w), h = across(pull_), g = across(d);
        const Scalar re = rate.re * rate.re - rate.im * rate.im + h.re * g.re - h.im * g.im;
        const Scalar im = 2 * rate.re * rate.im + h.re * g.im + h.im * g.re;
        return re * re + im * im;
      }
      case FourthCase::goryachev_chaplygin: {
        const Complex rate = across(w), h = across(pull_);
        return axis_.dot(w) * (rate.re * rate.re + rate.im * rate.im) +
               (h.re * rate.re + h.im * rate.im) * axis_.dot(d);
      }
    }
    return nan<Scalar>;
  }

 private:
  struct Complex {
    Scalar re, im;
  };
  Complex across(const Vec3<Scalar>& v) const noexcept {
    const int k = axis_[0] == 1 ? 0 : axis_[1] == 1 ? 1 : 2;
    return {v[(k + 1) % 3], v[(k + 2) % 3]};
  }

  FourthCase kind_ = FourthCase::none;
  Vec3<Scalar> inertia_;
  Scalar gradient_;
  Vec3<Scalar> axis_{0, 0, 1};  ///< of symmetry, unit
  Vec3<Scalar> pull_{0, 0, 0};  ///< M g r_cm/C, 1/s^2
};

}  // namespace gyrostat::heavy
