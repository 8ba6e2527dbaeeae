// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/wide.hpp"

/// Two Lanes side by side, worked on at once: one register where the machine has eight doubles in one, else two.
namespace gyrostat::inline GYROSTAT_LEVEL {

namespace detail {

/// Two Lanes where no register holds both.
template <Real Scalar>
struct TwoLanes {
  Lanes<Scalar> first, second;

  GYROSTAT_INLINE friend TwoLanes operator+(const TwoLanes& a, const TwoLanes& b) noexcept {
    return {a.first + b.first, a.second + b.second};
  }
  GYROSTAT_INLINE friend TwoLanes operator-(const TwoLanes& a, const TwoLanes& b) noexcept {
    return {a.first - b.first, a.second - b.second};
  }
  GYROSTAT_INLINE friend TwoLanes operator*(const TwoLanes& a, const TwoLanes& b) noexcept {
    return {a.first * b.first, a.second * b.second};
  }
  GYROSTAT_INLINE friend TwoLanes operator/(const TwoLanes& a, const TwoLanes& b) noexcept {
    return {a.first / b.first, a.second / b.second};
  }
};

template <Real Scalar>
GYROSTAT_INLINE TwoLanes<Scalar> multiply_add(const TwoLanes<Scalar>& a, const TwoLanes<Scalar>& b,
                                              const TwoLanes<Scalar>& c) noexcept {
  return {multiply_add(a.first, b.first, c.first), multiply_add(a.second, b.second, c.second)};
}

}  // namespace detail

/// With +, -, *, multiply_add, and the functions below.
template <Real Scalar>
using LanePair = std::conditional_t<wide_size<Scalar> == 8, Wide<Scalar>, detail::TwoLanes<Scalar>>;

template <Real Scalar>
inline constexpr bool one_register = wide_size<Scalar> == 8;

template <Real Scalar>
GYROSTAT_INLINE LanePair<Scalar> lane_pair(const Lanes<Scalar>& first, const Lanes<Scalar>& second) noexcept {
  if constexpr (one_register<Scalar>) {
    return {__builtin_shufflevector(first.v, second.v, 0, 1, 2, 3, 4, 5, 6, 7)};
  } else {
    return {first, second};
  }
}

/// The same number everywhere.
template <Real Scalar>
GYROSTAT_INLINE LanePair<Scalar> lane_pair(Scalar a) noexcept {
  if constexpr (one_register<Scalar>) {
    return wide(a);
  } else {
    return {lanes(a), lanes(a)};
  }
}

template <Real Scalar>
GYROSTAT_INLINE LanePair<Scalar> load_pair(const Scalar* from) noexcept {
  if constexpr (one_register<Scalar>) {
    return load_wide(from);
  } else {
    return {load(from), load(from + 4)};
  }
}

template <Real Scalar>
GYROSTAT_INLINE void store_pair(Scalar* to, const LanePair<Scalar>& a) noexcept {
  if constexpr (one_register<Scalar>) {
    store(to, a);
  } else {
    store(to, a.first);
    store(to + 4, a.second);
  }
}

template <Real Scalar, class Index>
  requires(!std::is_same_v<LanePair<Scalar>, Lanes<Scalar>>)
GYROSTAT_INLINE LanePair<Scalar> over_next(const LanePair<Scalar>& v, Index k) noexcept {
  return over_next<Scalar>(v, k, [](Scalar x) GYROSTAT_INLINE_LAMBDA { return lane_pair(x); });
}

/// Lanes (i, j, k, l) of each half.
template <int i, int j, int k, int l, Real Scalar>
GYROSTAT_INLINE LanePair<Scalar> shuffle_halves(const LanePair<Scalar>& a) noexcept {
  if constexpr (one_register<Scalar>) {
    return {__builtin_shufflevector(a.v, a.v, i, j, k, l, 4 + i, 4 + j, 4 + k, 4 + l)};
  } else {
    return {shuffle<i, j, k, l>(a.first), shuffle<i, j, k, l>(a.second)};
  }
}

/// The second half before the first.
template <Real Scalar>
GYROSTAT_INLINE LanePair<Scalar> exchanged(const LanePair<Scalar>& a) noexcept {
  if constexpr (one_register<Scalar>) {
    return {__builtin_shufflevector(a.v, a.v, 4, 5, 6, 7, 0, 1, 2, 3)};
  } else {
    return {a.second, a.first};
  }
}

/// The first half of a and the second of b.
template <Real Scalar>
GYROSTAT_INLINE LanePair<Scalar> halves(const LanePair<Scalar>& a, const LanePair<Scalar>& b) noexcept {
  if constexpr (one_register<Scalar>) {
    return {__builtin_shufflevector(a.v, b.v, 0, 1, 2, 3, 12, 13, 14, 15)};
  } else {
    return {a.first, b.second};
  }
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
