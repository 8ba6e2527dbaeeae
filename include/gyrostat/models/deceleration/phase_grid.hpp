// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/modulus.hpp"

namespace gyrostat::deceleration {

/// sn, cn, dn at the arguments K j/q, 0 <= j <= q, q = 1, 2, 4, ... 128: one quarter of a period, uniform in time. Built by
/// halving the argument (DLMF 22.6.21) and by reflection about K/2 (22.4), square roots and quotients of positive numbers only: a
/// few eps in each function, relative, at any modulus with kp2 > 0. No quarter period and no transcendental function is needed.
template <Real Scalar>
class PhaseGrid {
 public:
  static constexpr int deepest = 7;
  static constexpr int capacity = (1 << deepest) + 1;

  explicit PhaseGrid(math::Modulus<Scalar> modulus) noexcept : kp_(std::sqrt(modulus.kp2)) {
    sn[0] = 0, cn[0] = 1, dn[0] = 1;
    sn[1] = 1, cn[1] = 0, dn[1] = kp_;
  }

  /// Adds the odd multiples of K/2^(depth + 1). They stand behind what is there: at depth d the entries 2^(d-1) + 1 ... 2^d hold
  /// the odd multiples 1, 3, 5, ... of K/2^d; entry 0 is u = 0, entry 1 is u = K. False at the deepest grid.
  bool refine() noexcept {
    if (depth_ == deepest) return false;
    const int first = size();
    const int count = 1 << depth_;
    ++depth_;
    if (count == 1) {
      const Scalar s = 1 / std::sqrt(1 + kp_), r = std::sqrt(kp_);
      sn[2] = s, cn[2] = r * s, dn[2] = r;
      return true;
    }
    const int half = count / 2;
    for (int i = 0; i < half; ++i) {
      // the odd multiple i of the grid before, halved
      const int whole = first - half + i, low = first + i, high = first + count - 1 - i;
      const Scalar s = sn[whole], c = cn[whole], d = dn[whole];
      const Scalar on_c = 1 / (1 + c), on_d = 1 / (1 + d);
      const Scalar ds = s * std::sqrt(on_c * on_d), dc = std::sqrt((c + d) * on_d), dd = std::sqrt((c + d) * on_c);
      sn[low] = ds, cn[low] = dc, dn[low] = dd;
      const Scalar inverse = 1 / dd;  // K - u
      sn[high] = dc * inverse, cn[high] = kp_ * ds * inverse, dn[high] = kp_ * inverse;
    }
    return true;
  }

  int depth() const noexcept { return depth_; }
  /// Number of entries, 2^depth + 1.
  int size() const noexcept { return (1 << depth_) + 1; }

  /// Entry that holds u = K j/2^depth.
  int entry(int j) const noexcept {
    if (j == 0) return 0;
    int d = depth_;
    while (d > 0 && j % 2 == 0) j /= 2, --d;
    return d == 0 ? 1 : (1 << (d - 1)) + 1 + (j - 1) / 2;
  }

  Scalar sn[capacity], cn[capacity], dn[capacity];

 private:
  Scalar kp_;
  int depth_ = 0;
};

}  // namespace gyrostat::deceleration
