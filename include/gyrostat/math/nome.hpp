// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::math {

namespace detail {

/// Terms of the theta series that reach rounding at q <= exp(-pi), half a quarter period away from the origin.
template <Real Scalar>
inline constexpr int theta_terms = epsilon<Scalar> > Scalar(1e-17) ? 3 : epsilon<Scalar> > Scalar(1e-20) ? 4 : 6;

}  // namespace detail

/// Nome q = exp(-pi K'/K) of the smaller half of the moduli, 0 <= k2 <= 1/2 (a little more does no harm): q <= exp(-pi).
/// With l = (1 - sqrt k') / (2 (1 + sqrt k')), formed without the difference, q = l + 2 l^5 + 15 l^9 + ...
/// (DLMF 20.9.5, coefficients OEIS A002103); relative error 3 eps down to the smallest k2.
template <Real Scalar>
inline Scalar nome(Modulus<Scalar> m) noexcept {
  const Scalar kp = std::sqrt(m.kp2);
  const Scalar root = 1 + std::sqrt(kp);
  const Scalar l = m.k2 / (2 * (1 + kp) * (root * root));
  const Scalar l2 = l * l;
  const Scalar x = l2 * l2;
  if constexpr (epsilon<Scalar> > Scalar(1e-17)) {
    return l + l * (x * (2 + x * (15 + x * 150)));
  } else {
    return l + l * (x * (2 + x * (15 + x * (150 + x * (1707 + x * (20910 + x * (268616 + x * (3567400 +
                    x * Scalar(48555069)))))))));
  }
}

/// The theta constants of a nome q <= exp(-pi), with the factor 2 q^(1/4) taken out of theta_2:
/// two = theta_2(0)/(2 q^(1/4)), three = theta_3(0), four = theta_4(0), curvature = theta_4''(0)/(8 q).
template <Real Scalar>
struct ThetaConstants {
  Scalar two, three, four, curvature;

  static ThetaConstants of(Scalar q) noexcept {
    const Scalar q2 = q * q;
    const Scalar q3 = q2 * q;
    const Scalar q4 = q2 * q2;
    const Scalar q6 = q3 * q3;
    Scalar even = q4;              // sum of q^(n^2), n even
    Scalar odd = q + q6 * q3;      // the same, n odd
    Scalar two = q2 + q6 + q6 * q6;
    Scalar bend = 9 * (q4 * q4) - 4 * q3;
    if constexpr (detail::theta_terms<Scalar> > 3) {
      const Scalar q8 = q4 * q4;
      const Scalar q16 = q8 * q8;
      even += q16 + q16 * q16 * q4;
      odd += q16 * q8 * q;
      two += q16 * q4 + q16 * q8 * q6;
      bend += 25 * (q16 * q8) - 16 * (q8 * q4 * q3) - 36 * (q16 * q16 * q3);
    }
    return {1 + two, 1 + 2 * (even + odd), 1 + 2 * (even - odd), 1 + bend};
  }
};

/// The four theta functions at one argument z, and the sums of their derivatives, each without its trivial factor:
///   theta_1 = 2 q^(1/4) sin z one,   theta_2 = 2 q^(1/4) cos z two,   theta_3 = three,   theta_4 = four,
///   theta_2' = -2 q^(1/4) sin z slope_two,   theta_3' = -4 sin 2z slope_three,   theta_4' = 4 sin 2z slope_four.
/// With C = cosh 2y, sinh y and cosh y for sin z and cos z, the same sums serve the imaginary argument z = i y.
template <Real Scalar>
struct Thetas {
  Scalar one, two, three, four, slope_two, slope_three, slope_four;

  /// C = cos 2z, |z| <= pi/4; or C = cosh 2y, exp(2 |y|) <= q^(-1/2).
  static Thetas of(Scalar q, Scalar C) noexcept {
    const Scalar q2 = q * q;
    Scalar before = 1, cosine = C;             // cos 2(n-1)z, cos 2nz
    Scalar power = q, step = q2 * q;           // q^(n^2), q^(2n+1)
    Scalar between = q2, gap = q2 * q2;        // q^(n(n+1)), q^(2n+2)
    Scalar sine_ratio = 1, cosine_ratio = 1;   // sin (2n+1)z / sin z, cos (2n+1)z / cos z
    Scalar double_before = 0, double_ratio = 1;  // sin 2(n-1)z / sin 2z, sin 2nz / sin 2z
    Scalar sign = -1;
    Scalar one = 0, two = 0, even = 0, odd = 0, slope_two = 0, slope_even = 0, slope_odd = 0;
    for (int n = 1; n <= detail::theta_terms<Scalar>; ++n) {
      sine_ratio = 2 * cosine + sine_ratio;
      cosine_ratio = 2 * cosine - cosine_ratio;
      one += sign * (between * sine_ratio);
      two += between * cosine_ratio;
      slope_two += Scalar(2 * n + 1) * (between * sine_ratio);
      (sign < 0 ? odd : even) += power * cosine;
      (sign < 0 ? slope_odd : slope_even) += Scalar(n) * (power * double_ratio);
      const Scalar next = 2 * C * cosine - before;
      before = cosine;
      cosine = next;
      const Scalar double_next = 2 * C * double_ratio - double_before;
      double_before = double_ratio;
      double_ratio = double_next;
      power *= step;
      step *= q2;
      between *= gap;
      gap *= q2;
      sign = -sign;
    }
    return {1 + one,       1 + two,  1 + 2 * (even + odd), 1 + 2 * (even - odd),
            1 + slope_two, slope_odd + slope_even, slope_odd - slope_even};
  }
};

}  // namespace gyrostat::math
