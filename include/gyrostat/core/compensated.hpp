// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// A number and what rounding left over of it: high + low, low far below high.
template <Real Scalar>
struct Sum {
  Scalar high, low;
};

/// high + low + term, exactly but for the rounding of low (Kahan and Babuska; |term| not above |high|).
template <Real Scalar>
GYROSTAT_INLINE Sum<Scalar> add(Sum<Scalar> sum, Scalar term) noexcept {
  const Scalar y = sum.low + term;
  const Scalar high = sum.high + y;
  const Scalar part = high - sum.high;
  return {high, (sum.high - (high - part)) + (y - part)};
}

/// The same in place: x + low becomes x + low + term.
template <Real Scalar>
GYROSTAT_INLINE void add_to(Scalar& x, Scalar& low, Scalar term) noexcept {
  const Sum<Scalar> sum = add(Sum<Scalar>{x, low}, term);
  x = sum.high;
  low = sum.low;
}

/// x + low becomes x + low + a b, of whatever sizes these are, exactly but for the rounding of low (Knuth 1969).
template <Real Scalar>
void add_product_to(Scalar& x, Scalar& low, Scalar a, Scalar b) noexcept {
  using std::fma;
  const Scalar product = a * b, lost = fma(a, b, -product);
  const Scalar sum = x + product, part = sum - x;
  const Scalar rest = (x - (sum - part)) + (product - part) + lost;
  x = sum;
  if (rest - rest == 0) low += rest;  // else the sum has overflown
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
