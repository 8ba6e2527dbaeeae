// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// The least change that puts two functions right, to first order, is these multiples of their gradients, times the inverse of the norm's form.
template <Real Scalar>
struct Multipliers {
  Scalar first = 0, second = 0;
};

/// @param lacking_first, lacking_second  what the functions are to grow by
/// @param ff, fs, ss  products of their gradients in the inverse of the norm's form
/// Where the gradients are all but parallel the first function alone is put right, or the second, where the first is stationary.
template <Real Scalar>
constexpr Multipliers<Scalar> least_change(Scalar lacking_first, Scalar lacking_second, Scalar ff, Scalar fs,
                                           Scalar ss) noexcept {
  const Scalar determinant = ff * ss - fs * fs;
  if (64 * determinant > ff * ss)
    return {(lacking_first * ss - lacking_second * fs) / determinant,
            (lacking_second * ff - lacking_first * fs) / determinant};
  if (ff > 0) return {lacking_first / ff, 0};
  if (ss > 0) return {0, lacking_second / ss};
  return {};
}

}  // namespace gyrostat::math
