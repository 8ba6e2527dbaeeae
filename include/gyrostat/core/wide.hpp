// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>
#include <type_traits>

#include "gyrostat/core/lanes.hpp"
#include "gyrostat/core/real.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

#if defined(__GNUC__) && defined(__AVX512F__)
/// Eight doubles in one register of a machine that has such: 64-byte vectors cost dearly where the compiler must split them.
struct EightDoubles {
  using Register [[gnu::vector_size(64)]] = double;
  Register v;

  GYROSTAT_INLINE double operator[](int i) const noexcept { return v[i]; }
  GYROSTAT_INLINE friend EightDoubles operator+(const EightDoubles& a, const EightDoubles& b) noexcept {
    return {a.v + b.v};
  }
  GYROSTAT_INLINE friend EightDoubles operator-(const EightDoubles& a, const EightDoubles& b) noexcept {
    return {a.v - b.v};
  }
  GYROSTAT_INLINE friend EightDoubles operator*(const EightDoubles& a, const EightDoubles& b) noexcept {
    return {a.v * b.v};
  }
};

GYROSTAT_INLINE EightDoubles multiply_add(const EightDoubles& a, const EightDoubles& b,
                                          const EightDoubles& c) noexcept {
  return {_mm512_fmadd_pd(a.v, b.v, c.v)};
}

GYROSTAT_INLINE void store(double* to, const EightDoubles& a) noexcept { std::memcpy(to, &a.v, sizeof(a.v)); }

namespace detail {
template <Real Scalar>
using WideOf = std::conditional_t<std::is_same_v<Scalar, double>, EightDoubles, Lanes<Scalar>>;
}
#else
namespace detail {
template <Real Scalar>
using WideOf = Lanes<Scalar>;
}
#endif

/// As many numbers side by side as one register holds, for work on many independent problems: eight doubles with AVX-512, else four
/// numbers. With +, -, *, multiply_add, store, and the functions below.
template <Real Scalar>
using Wide = detail::WideOf<Scalar>;

/// 4 or 8.
template <Real Scalar>
inline constexpr int wide_size = std::is_same_v<Wide<Scalar>, Lanes<Scalar>> ? 4 : 8;

/// From memory, aligned or not.
template <Real Scalar>
GYROSTAT_INLINE Wide<Scalar> load_wide(const Scalar* from) noexcept {
  Wide<Scalar> result;
  std::memcpy(&result.v, from, sizeof(result.v));
  return result;
}

/// The same number everywhere.
template <Real Scalar>
GYROSTAT_INLINE Wide<Scalar> wide(Scalar a) noexcept {
  if constexpr (wide_size<Scalar> == 4) {
    return lanes(a);
  } else {
    return {typename Wide<Scalar>::Register{a, a, a, a, a, a, a, a}};
  }
}

/// Number by number, a > b ? a : b; so b where one of them is NaN.
template <Real Scalar>
GYROSTAT_INLINE Wide<Scalar> greater_of(const Wide<Scalar>& a, const Wide<Scalar>& b) noexcept {
  if constexpr (Lanes<Scalar>::vectorised) {
    return {a.v > b.v ? a.v : b.v};
  } else {
    Wide<Scalar> result;
    for (int i = 0; i < 4; ++i) result.v[i] = a[i] > b[i] ? a[i] : b[i];
    return result;
  }
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
