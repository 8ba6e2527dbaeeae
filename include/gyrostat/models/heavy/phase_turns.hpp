// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/complex.hpp"

namespace gyrostat::heavy {

/// e^(iu), u = rate t, at many times, block by block: on an even grid one product a time instead of sine and cosine.
template <Real Scalar>
class PhaseTurns {
 public:
  static constexpr std::size_t block = 32;

  PhaseTurns(std::span<const Scalar> times, Scalar rate) noexcept : times_(times), rate_(rate) {
    tabled_ = times.size() >= 4 * block;
    if (!tabled_) return;
    step_ = (times.back() - times.front()) / static_cast<Scalar>(times.size() - 1);
    for (std::size_t k = 0; k < block; ++k) {
      const auto turn = math::unit(rate * (step_ * static_cast<Scalar>(k)));
      cosine_[k] = turn.re;
      sine_[k] = turn.im;
    }
  }

  /// Cosine and sine of u at times[first] ... , a whole block; behind the last time the numbers mean nothing.
  void write(std::size_t first, Scalar (&cosine)[block], Scalar (&sine)[block]) const noexcept {
    const std::size_t here = std::min(block, times_.size() - first);
    const Scalar start = times_[first];
    if (tabled_ && even(first, here)) {
      const auto base = math::unit(rate_ * start);
      for (std::size_t k = 0; k < block; ++k) {
        cosine[k] = base.re * cosine_[k] - base.im * sine_[k];
        sine[k] = base.re * sine_[k] + base.im * cosine_[k];
      }
      return;
    }
    for (std::size_t k = 0; k < block; ++k) {
      const auto turn = math::unit(rate_ * times_[first + std::min(k, here - 1)]);
      cosine[k] = turn.re;
      sine[k] = turn.im;
    }
  }

 private:
  /// The times lie on the grid but for their rounding, which the phase does not feel more than its own.
  bool even(std::size_t first, std::size_t here) const noexcept {
    const Scalar start = times_[first];
    bool fits = true;
    for (std::size_t k = 0; k < here; ++k) {
      const Scalar t = times_[first + k], off = std::abs(t - (start + step_ * static_cast<Scalar>(k)));
      fits = fits && off <= epsilon<Scalar> * (std::abs(t) + std::abs(start));
    }
    return fits;
  }

  std::span<const Scalar> times_;
  Scalar rate_, step_ = 0;
  bool tabled_;
  Scalar cosine_[block] = {}, sine_[block] = {};
};

}  // namespace gyrostat::heavy
