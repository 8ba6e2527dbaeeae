// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"

/// What the monodromy of a periodic motion says of small changes of its start (docs/heavy.md, section 4).
namespace gyrostat::heavy {

enum class OrbitStability : std::uint8_t {
  stable,    ///< both multipliers on the unit circle, away from +-1
  unstable,  ///< both real: one change of the start grows
  undecided  ///< the trace is too near +-2 to say
};

/// The two multipliers of a periodic motion that are not one, lambda and 1/lambda. The other four are one for every motion (energy,
/// vertical momentum, |down|, phase) and form Jordan blocks, so that eigenvalues of the matrix itself would keep half the digits.
template <Real Scalar>
struct Multipliers {
  math::Complex<Scalar> first{1, 0}, second{1, 0};  ///< |first| >= |second|; conjugates on the unit circle, first above
  Scalar turns =
      0;  ///< angle of the first over 2 pi, in [0, 1/2]; 1/2 where both are negative, 0 where both are positive
};

/// @param trace_minus_4 trace of the monodromy - 4 = lambda + 1/lambda. NaN gives NaN.
template <Real Scalar>
Multipliers<Scalar> multipliers(Scalar trace_minus_4) noexcept {
  const Scalar size = std::abs(trace_minus_4), product = (size - 2) * (size + 2);
  Multipliers<Scalar> m;
  if (product <= 0) {
    m.first = {trace_minus_4 / 2, std::sqrt(-product) / 2};
    m.second = math::conjugate(m.first);
    m.turns = std::atan2(m.first.im, m.first.re) / (2 * pi<Scalar>);
    return m;
  }
  const Scalar greater = (size + std::sqrt(product)) / 2;
  m.first = {std::copysign(greater, trace_minus_4), 0};
  m.second = {1 / m.first.re, 0};
  m.turns = trace_minus_4 < 0 ? Scalar(0.5L) : 0 * greater;
  return m;
}

/// Undecided within 1e-7 of +-2, or within the error of the trace where that is larger or not a number.
template <Real Scalar>
OrbitStability orbit_stability(Scalar trace_minus_4, Scalar error) noexcept {
  const Scalar beyond = std::abs(trace_minus_4) - 2, doubt = std::max(error, Scalar(1e-7L));
  if (beyond > doubt && error == error) return OrbitStability::unstable;
  return beyond < -doubt && error == error ? OrbitStability::stable : OrbitStability::undecided;
}

}  // namespace gyrostat::heavy
