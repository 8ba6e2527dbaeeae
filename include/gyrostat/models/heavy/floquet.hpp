// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/scaled.hpp"

namespace gyrostat::heavy {

enum class FastStability : std::uint8_t {
  stable,     ///< to first order: a free nutation neither grows nor decays
  unstable,   ///< a free nutation grows
  undecided,  ///< next to a boundary, within the error of the exponent
};

/// Does a free nutation grow on the forced motion of a fast spin (docs/heavy.md, section 3)? Of its six multipliers over a period four
/// are one; the other two are exp(+-2 pi i nu), with
///     nu^2 = omega^2 + G0 (z' W1 + k G0 W2) + k W3 M3^2 (times eps^2) + O(eps^4),
/// and a tongue of parametric resonance at nu = 1/2 of half width |kr| eps^2, in which they are negative.
template <Real Scalar>
struct Floquet {
  Scalar squared = 0;        ///< nu^2; negative: they are real and positive
  Scalar squared_error = 0;  ///< of nu^2
  Scalar nu_error = 0;       ///< of nu
  Scalar tongue = 0;         ///< |kr| eps^2, over nu
  Scalar trace_minus_4 = 2;  ///< the sum of the two, 2 cos(2 pi nu) outside of the tongue
  Scalar growth = 0;         ///< ln of the larger one in size, 0 where they lie on the circle
  bool alone = false;        ///< neither comes to one within the error of nu: no other such motion is near
  FastStability verdict = FastStability::undecided;

  /// nu as the tongue draws it towards 1/2, and 1/2 inside; NaN where it is imaginary.
  Scalar exponent() const noexcept {
    const Scalar off = std::sqrt(squared) - Scalar(0.5L);
    const Scalar left = (std::abs(off) - tongue) * (std::abs(off) + tongue);
    return left < 0 ? Scalar(0.5L) : Scalar(0.5L) + std::copysign(std::sqrt(left), off);
  }
  /// The square of the largest |p| of the second family of periodic motions, which a rational omega = m/n gives the n-th turn to,
  /// (rad/s)^2, to first order: negative where there is none. NaN or infinite where a = 1 or a + b = 2.
  Scalar second_family_squared() const noexcept { return second_family_; }

  /// The most that a free nutation may grow in a period, ln, as far as the errors of the exponent and of its resonances allow; NaN or infinite
  /// where they are not known.
  Scalar most_growth() const noexcept {
    const Scalar below = std::sqrt(std::fmax(squared_error - squared, Scalar(0)));
    return 2 * pi<Scalar> * (below + tongue + nu_error);
  }

  explicit Floquet(const Scaled<Scalar>& s) noexcept {
    const Scalar a = s.a, b = s.b, x = s.load[0], y = s.load[1], z = s.load[2], k = s.gradient;
    const Scalar omega2 = s.nutation_squared();
    const Scalar W1 = (3 * (a + b) - 2 * (2 * a * b + 1)) / (a * b), W2 = -2 * omega2 * s.flatness;
    const Scalar W3 = omega2 * (a + b) / 2;
    squared = omega2 + s.G0 * (z * W1 + k * s.G0 * W2) + k * W3 * s.M3 * s.M3;
    // of omega = 1/2, where 1/(2 (1 - b)) = 2 (1 - a)/(a b): this has no pole elsewhere
    tongue = s.M3 / 2 * std::hypot(x * (Scalar(1.5L) - 1 / b), y * (2 * s.off_a - b) / (a * b));
    second_family_ = (squared - omega2) / (-s.off_a * (a + b - 2) / (2 * b)) * s.spin * s.spin;
    const FirstOrder<Scalar> first(s);
    const Scalar size = std::abs(first.chi) + std::abs(first.kap) + std::abs(first.X) + std::abs(first.Y) + s.torque();
    // twice the largest of 13000 random bodies, off the tongue
    const Scalar divided = std::abs(detail::ratio_or_zero(x, s.off_a)) + std::abs(detail::ratio_or_zero(y, s.off_b));
    // of slim bodies the shift is many times the rest; and down sways the gradient's torque twice a turn, which resonates at nu = 1
    const Scalar shift = squared - omega2, swayed = shift * shift * (1 + 1 / std::abs(1 - squared));
    squared_error = std::fmax(2 * size * (size + Scalar(0.3L) * divided), 4 * swayed);

    const Scalar nu = std::sqrt(std::fmax(squared, Scalar(0)));
    nu_error = squared_error / (nu + std::sqrt(squared_error));
    const Scalar off = nu - Scalar(0.5L), detuned = std::abs(off);
    const Scalar circle = 2 * pi<Scalar>;
    if (squared <= 0) {
      growth = circle * std::sqrt(-squared);
      trace_minus_4 = 2 * std::cosh(growth);
    } else if (detuned < tongue) {
      growth = circle * std::sqrt((tongue - detuned) * (tongue + detuned));
      trace_minus_4 = -2 * std::cosh(growth);
    } else {
      trace_minus_4 = -2 * std::cos(circle * std::sqrt((detuned - tongue) * (detuned + tongue)));
    }
    const bool known = squared_error < infinity<Scalar>;
    alone = known && std::abs(squared) > squared_error && std::abs(nu - 1) > nu_error;
    if (known && (squared < -squared_error || detuned + nu_error < tongue)) {
      verdict = FastStability::unstable;
    } else if (known && squared > squared_error && std::abs(nu - 1) > nu_error && detuned > tongue + nu_error) {
      verdict = FastStability::stable;
    }
  }

 private:
  Scalar second_family_ = 0;
};

}  // namespace gyrostat::heavy
