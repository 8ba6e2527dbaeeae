// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

namespace gyrostat::heavy {

/// Whether a sleeping top stays upright.
enum class SleepVerdict : std::uint8_t { stable, unstable, undecided };

/// A top that spins about the vertical, its axis of symmetry up or down: small tilts z (complex, in axes that turn with
/// C r/(2 A)) obey z'' = -frequency^2 z (docs/heavy.md, section 7).
template <Real Scalar>
struct SleepingTop {
  Scalar threshold;         ///< least |r| of a stable sleep, rad/s; 0 where it is stable at any spin
  Scalar frequency_square;  ///< (C r/(2 A))^2 - (N (C - A) - s W)/A, 1/s^2
  SleepVerdict verdict;     ///< undecided within rounding of the threshold

  Scalar growth_rate() const noexcept { return std::sqrt(std::max(-frequency_square, Scalar(0))); }  ///< of a tilt, 1/s
  /// By how much a stable top enlarges a tilt at rest: 1/sqrt(1 - (threshold/r)^2); infinite at the threshold and
  /// below. One that is stable at any spin swings no farther.
  Scalar amplification(Scalar spin) const noexcept {
    if (threshold == 0 && frequency_square > 0) return 1;
    const Scalar room = (std::abs(spin) - threshold) * (std::abs(spin) + threshold);
    return room > 0 ? std::max(std::abs(spin) / std::sqrt(room), Scalar(1)) : infinity<Scalar>;
  }
};

/// @param axis_down the axis of symmetry, third of the top's frame, points down (g3 = 1), else up   @param spin r,
/// rad/s
template <Real Scalar>
SleepingTop<Scalar> sleeping_top(const SymmetricTop<Scalar>& top, bool axis_down, Scalar spin) noexcept {
  const Scalar side = axis_down ? 1 : -1, A = top.across;
  const Scalar upset = top.gradient * (top.along - A) - side * top.weight;  // N m/rad
  const Scalar stiffness = top.along * spin / (2 * A);
  const Scalar square = stiffness * stiffness - upset / A;
  const Scalar size = stiffness * stiffness + (std::abs(top.gradient * (top.along - A)) + std::abs(top.weight)) / A;
  const bool near = std::abs(square) <= 16 * epsilon<Scalar> * size;
  return {upset > 0 ? 2 * std::sqrt(A * upset) / top.along : Scalar(0), square,
          near         ? SleepVerdict::undecided
          : square > 0 ? SleepVerdict::stable
                       : SleepVerdict::unstable};
}

}  // namespace gyrostat::heavy
