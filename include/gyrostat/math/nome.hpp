// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/associate.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::math {

namespace detail {

/// Terms of the theta series that reach rounding at q <= exp(-pi), half a quarter period away from the origin.
template <Real Scalar>
inline constexpr int theta_terms = epsilon<Scalar> > Scalar(1e-17)   ? 3
                                   : epsilon<Scalar> > Scalar(1e-20) ? 4
                                                                     : 6;

}  // namespace detail

/// Nome q = exp(-pi K'/K) of the smaller half of the moduli, 0 <= k2 <= 1/2: q <= exp(-pi). Relative error 3 eps down to
/// the smallest k2. For double a fitted polynomial of k2; otherwise with l = (1 - sqrt k') / (2 (1 + sqrt k')), formed
/// without the difference, q = l + 2 l^5 + 15 l^9 + ... (DLMF 20.9.5, coefficients OEIS A002103).
template <Real Scalar>
GYROSTAT_FLATTEN Scalar nome(Modulus<Scalar> m) noexcept {
  if constexpr (std::same_as<Scalar, double>) {
    return m.k2 * detail::polynomial(detail::nome_over_k2, detail::Powers::of(m.k2));
  } else {
    using std::sqrt;
    const Scalar kp = sqrt(m.kp2);
    const Scalar root = 1 + sqrt(kp);
    const Scalar l = m.k2 / (2 * (1 + kp) * (root * root));
    const Scalar l2 = l * l;
    const Scalar x = l2 * l2;
    return l +
           l * (x *
                (2 + x * (15 +
                          x * (150 + x * (1707 + x * (20910 + x * (268616 + x * (3567400 + x * Scalar(48555069)))))))));
  }
}

/// The theta constants of a nome q <= exp(-pi), with the factor 2 q^(1/4) taken out of theta_2:
/// two = theta_2(0)/(2 q^(1/4)), three = theta_3(0), four = theta_4(0), curvature = theta_4''(0)/(8 q).
template <Real Scalar>
struct ThetaConstants {
  Scalar two, three, four, curvature;

  GYROSTAT_FLATTEN static ThetaConstants of(Scalar q) noexcept {
    const Scalar q2 = q * q;
    const Scalar q3 = q2 * q;
    const Scalar q4 = q2 * q2;
    const Scalar q6 = q3 * q3;
    Scalar even = q4;          // sum of q^(n^2), n even
    Scalar odd = q + q6 * q3;  // the same, n odd
    Scalar two = q2 + q6 + q6 * q6;
    Scalar bend = 9 * (q4 * q4) - 4 * q3;
    if constexpr (detail::theta_terms < Scalar >> 3) {
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
  GYROSTAT_FLATTEN static Thetas of(Scalar q, Scalar C) noexcept {
    const Scalar q2 = q * q;
    const Scalar q4 = q2 * q2;
    const Scalar C2 = 2 * C;         // 2 cos 2z
    const Scalar C4 = C2 * C2 - 2;   // 2 cos 4z
    const Scalar C6 = C2 * C4 - C2;  // 2 cos 6z
    const Scalar s3 = C2 + 1;        // sin 3z / sin z, 5z, 7z
    const Scalar s5 = C4 + s3;
    const Scalar s7 = C6 + s5;
    const Scalar c3 = C2 - 1;  // cos 3z / cos z, 5z, 7z
    const Scalar c5 = C4 - c3;
    const Scalar c7 = C6 - c5;
    const Scalar q6 = q4 * q2;
    const Scalar q9 = q4 * q4 * q;
    const Scalar q12 = q6 * q6;
    Scalar even = q4 * C4;          // 2 sum of q^(n^2) cos 2nz, n even
    Scalar odd = q * C2 + q9 * C6;  // the same, n odd
    Scalar one = q6 * s5 - (q2 * s3 + q12 * s7);
    Scalar two = q2 * c3 + q6 * c5 + q12 * c7;
    Scalar slope_two = 3 * (q2 * s3) + 5 * (q6 * s5) + 7 * (q12 * s7);
    Scalar slope_odd = q + 3 * (q9 * (C2 * C2 - 1));  // sum of n q^(n^2) sin 2nz / sin 2z, n odd
    Scalar slope_even = 2 * (q4 * C2);
    if constexpr (detail::theta_terms < Scalar >> 3) {
      Scalar before = C4, cosine = C6;  // 2 cos 2(n-1)z, 2 cos 2nz
      Scalar sine_ratio = s7, cosine_ratio = c7;
      Scalar double_before = C2, double_ratio = C2 * C2 - 1;  // sin 2(n-1)z / sin 2z, sin 2nz / sin 2z
      Scalar power = 0, between = q12, step = q2 * q;         // q^(n^2), q^(n(n+1)), q^n
      for (int n = 4; n <= detail::theta_terms<Scalar>; ++n) {
        step *= q;
        power = between * step;
        between = power * step;
        const Scalar next = C2 * cosine - before;
        before = cosine;
        cosine = next;
        const Scalar double_next = C2 * double_ratio - double_before;
        double_before = double_ratio;
        double_ratio = double_next;
        sine_ratio = cosine + sine_ratio;
        cosine_ratio = cosine - cosine_ratio;
        one += n % 2 ? -between * sine_ratio : between * sine_ratio;
        two += between * cosine_ratio;
        slope_two += Scalar(2 * n + 1) * (between * sine_ratio);
        (n % 2 ? odd : even) += power * cosine;
        (n % 2 ? slope_odd : slope_even) += Scalar(n) * (power * double_ratio);
      }
    }
    return {1 + one,
            1 + two,
            1 + (even + odd),
            1 + (even - odd),
            1 + slope_two,
            slope_odd + slope_even,
            slope_odd - slope_even};
  }
};

}  // namespace gyrostat::math
