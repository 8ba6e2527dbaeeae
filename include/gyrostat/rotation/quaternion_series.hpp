// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/quaternion_lanes.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The product q (0, o) of a quaternion and a rate o, both power series, order after order: the kinematics of a body, for Taylor steps. The
/// quaternion (w, x, y, z) stands in the rows of coefficients x, from column `at` on; o may have any factor.
///
/// Two orders are summed at once where they have terms in common, since loads are what a term costs.
template <Real Scalar, int Order>
struct QuaternionSeries {
  Scalar rate[Order + 1][4];  ///< the coefficients of o; the fourth number may be anything
  Lanes<Scalar> ahead[3];     ///< of the second of two orders, what the first has summed for it

  /// Coefficient 0.
  template <int width>
  GYROSTAT_INLINE Lanes<Scalar> begin(const Scalar (&x)[Order + 1][width], int at, const Lanes<Scalar>& o) noexcept {
    store(rate[0], o);
    const Lanes<Scalar> q = load(&x[0][at]);
    return times_units(shuffle<0, 0, 0, 0>(o) * q, shuffle<1, 1, 1, 1>(o) * q, shuffle<2, 2, 2, 2>(o) * q);
  }

  /// Coefficient k >= 1, once those before are made, from that of o and the quaternion's up to k. Index: an integral constant, so that
  /// everything unrolls, or an int.
  template <class Index, int width>
  GYROSTAT_INLINE Lanes<Scalar> extend(Index k, const Scalar (&x)[Order + 1][width], int at,
                                       const Lanes<Scalar>& o) noexcept {
    store(rate[k], o);
    Lanes<Scalar> s0 = lanes(Scalar(0)), s1 = s0, s2 = s0;
    const auto add = [&](int j, const Lanes<Scalar>& q, Lanes<Scalar>& sum_0, Lanes<Scalar>& sum_1,
                         Lanes<Scalar>& sum_2) GYROSTAT_INLINE_LAMBDA {
      sum_0 = multiply_add(lanes(rate[j][0]), q, sum_0);
      sum_1 = multiply_add(lanes(rate[j][1]), q, sum_1);
      sum_2 = multiply_add(lanes(rate[j][2]), q, sum_2);
    };
    if (k % 2 == 1) {
      Lanes<Scalar> next_0 = s0, next_1 = s0, next_2 = s0;
      count_down<Scalar>(k - 1, [&](int j) GYROSTAT_INLINE_LAMBDA {
        add(j, load(&x[k - j][at]), s0, s1, s2);
        if (j > 1) add(j, load(&x[k + 1 - j][at]), next_0, next_1, next_2);
      });
      ahead[0] = next_0, ahead[1] = next_1, ahead[2] = next_2;
    } else {
      s0 = ahead[0], s1 = ahead[1], s2 = ahead[2];
      if (k > 2) add(k - 1, load(&x[1][at]), s0, s1, s2);
      add(1, load(&x[k - 1][at]), s0, s1, s2);
    }
    // the newest last
    const Lanes<Scalar> first = load(&x[0][at]), last = load(&x[k][at]);
    s0 = multiply_add(lanes(rate[0][0]), last, multiply_add(shuffle<0, 0, 0, 0>(o), first, s0));
    s1 = multiply_add(lanes(rate[0][1]), last, multiply_add(shuffle<1, 1, 1, 1>(o), first, s1));
    s2 = multiply_add(lanes(rate[0][2]), last, multiply_add(shuffle<2, 2, 2, 2>(o), first, s2));
    return times_units(s0, s1, s2);
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
