// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <limits>

#include "gyrostat/core/level.hpp"

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gyrostat cannot be compiled with -ffast-math, -Ofast, -fassociative-math or -ffinite-math-only: numbers of twice the digits, NaN and infinities would be lost, and errors be stated wrongly. Leave these options out where a file includes gyrostat (-O3 -fno-math-errno -fno-trapping-math are all right)"
#endif
#if defined(__FLT_EVAL_METHOD__) && (__FLT_EVAL_METHOD__ == 1 || __FLT_EVAL_METHOD__ == 2)
#error "gyrostat needs arithmetic in the precision of the numbers themselves: compile with -msse2 -mfpmath=sse on 32-bit x86"
#endif

namespace gyrostat::inline GYROSTAT_LEVEL {

/// True of a class of numbers that stands for a floating-point type (core/double_double.hpp): with the operators, the limits of
/// std::numeric_limits, and the functions of <cmath> found by the type of their argument.
template <class T>
inline constexpr bool is_real_class = false;

/// The scalar of every model: float, double and long double are tested. Long double is there for truths and for what is made once of a
/// motion, not for hot paths: it has 64 bits on x86-64, 113 in software on 64-bit ARM.
template <class T>
concept Real = std::floating_point<T> || is_real_class<T>;

/// The relative accuracy that is worked to: the spacing of the numbers just above one, for a long double of more than 64 bits that of 64,
/// as the series go no further.
template <Real Scalar>
inline constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
template <>
inline constexpr long double epsilon<long double> = std::numeric_limits<long double>::digits > 64
                                                        ? 0x1p-63L
                                                        : std::numeric_limits<long double>::epsilon();

/// What comes back where no number is right.
template <Real Scalar>
inline constexpr Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();

/// What is larger than every number, or not bounded.
template <Real Scalar>
inline constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();

/// Half the circumference of the unit circle, to the last digit of the type.
template <Real Scalar>
inline constexpr Scalar pi = Scalar(3.141592653589793238462643383279502884L);

}  // namespace gyrostat::inline GYROSTAT_LEVEL
