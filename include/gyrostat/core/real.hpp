// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <limits>

#include "gyrostat/core/level.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// True of a class of numbers that stands for a floating-point type (core/double_double.hpp): with the operators, the limits of
/// std::numeric_limits, and the functions of <cmath> found by the type of their argument.
template <class T>
inline constexpr bool is_real_class = false;

/// The scalar of every model: float, double and long double are tested.
template <class T>
concept Real = std::floating_point<T> || is_real_class<T>;

/// Spacing of the numbers just above one.
template <Real Scalar>
inline constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

/// What comes back where no number is right.
template <Real Scalar>
inline constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();

template <Real Scalar>
inline constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();

template <Real Scalar>
inline constexpr Scalar pi = Scalar(3.141592653589793238462643383279502884L);

}  // namespace gyrostat::inline GYROSTAT_LEVEL
