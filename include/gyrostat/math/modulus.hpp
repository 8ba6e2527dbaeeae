// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// The modulus of an elliptic integral, carried as its square k2 = k^2 and the complement kp2 = 1 - k^2.
/// Each of the two has its own full relative accuracy, so nothing is lost near k = 0 nor near the separatrix k = 1.
/// Legal: both in [0, 1], k2 + kp2 = 1 to rounding. Every function of a Modulus answers NaN outside.
template <Real Scalar>
struct Modulus {
  Scalar k2 = 0;
  Scalar kp2 = 1;

  /// For a k2 that is known exactly; kp2 is then no better than the rounding of 1 - k2.
  static constexpr Modulus from_k2(Scalar k2) noexcept { return {k2, 1 - k2}; }

  /// For a kp2 that is known exactly.
  static constexpr Modulus from_kp2(Scalar kp2) noexcept { return {1 - kp2, kp2}; }

  /// k2 = p / (p + q) and kp2 = q / (p + q), with p, q >= 0 not both zero: the form in which a problem gives its
  /// modulus (two products without cancellation). Both zero or one infinite: NaN.
  static constexpr Modulus from_parts(Scalar p, Scalar q) noexcept {
    const Scalar sum = p + q;
    return {p / sum, q / sum};
  }

  /// The modulus with k2 and kp2 exchanged.
  constexpr Modulus complement() const noexcept { return {kp2, k2}; }

  /// Both squares lie in [0, 1]; false for NaN. Without branches, so that loops over it vectorise.
  constexpr bool legal() const noexcept { return (int(k2 >= 0) & int(k2 <= 1) & int(kp2 >= 0) & int(kp2 <= 1)) != 0; }
};

}  // namespace gyrostat::math
