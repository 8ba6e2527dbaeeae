// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
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
  GYROSTAT_INLINE friend EightDoubles operator/(const EightDoubles& a, const EightDoubles& b) noexcept {
    return {a.v / b.v};
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
/// numbers. With +, -, *, /, multiply_add, store, and the functions below.
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

#if defined(__GNUC__) && defined(__AVX512F__)
namespace detail {
/// 1/sqrt a or sqrt a: the processor's 14-bit estimate, corrected by the binomial series up to the fourth power of its error; finite where a is 0.
GYROSTAT_INLINE Wide<double> refined_root(const Wide<double>& a, bool of_itself) noexcept {
  const Wide<double> y = {_mm512_maskz_rsqrt14_pd(0xff, greater_of<double>(a, wide(1e-300)).v)}, s = a * y;
  const Wide<double> e = multiply_add(wide(-0.0) - s, y, wide(1.)), first = of_itself ? s : y;
  const Wide<double> high = multiply_add(e, wide(35. / 128), wide(5. / 16)),
                     low = multiply_add(e, wide(.375), wide(.5));
  return multiply_add(first * e, multiply_add(e * e, high, low), first);
}
}  // namespace detail
#endif

/// sqrt a for 1e-300 <= a < infinity, error an eps; 0 gives 0.
template <Real Scalar>
GYROSTAT_INLINE Wide<Scalar> square_root(const Wide<Scalar>& a) noexcept {
#if defined(__GNUC__) && defined(__AVX512F__)
  if constexpr (wide_size<Scalar> == 8) return detail::refined_root(a, true);  // sooner than the processor's own root
#endif
#if defined(__GNUC__) && defined(__AVX__)
  if constexpr (wide_size<Scalar> == 4 && std::is_same_v<Scalar, double>) return {_mm256_sqrt_pd(a.v)};
#endif
  Wide<Scalar> result = a;
  for (int i = 0; i < wide_size<Scalar>; ++i) result.v[i] = std::sqrt(a[i]);
  return result;
}

/// 1/sqrt a, a from 1e-300; error 2 eps.
template <Real Scalar>
GYROSTAT_INLINE Wide<Scalar> inverse_square_root(const Wide<Scalar>& a) noexcept {
#if defined(__GNUC__) && defined(__AVX512F__)
  if constexpr (wide_size<Scalar> == 8) return detail::refined_root(a, false);
#endif
  return wide(Scalar(1)) / square_root<Scalar>(a);
}

namespace detail {
#if defined(__GNUC__) && defined(__AVX512F__)
struct EightChoices {
  __mmask8 of;

  GYROSTAT_INLINE friend EightChoices operator&(EightChoices a, EightChoices b) noexcept {
    return {static_cast<__mmask8>(a.of & b.of)};
  }
  GYROSTAT_INLINE friend EightChoices operator|(EightChoices a, EightChoices b) noexcept {
    return {static_cast<__mmask8>(a.of | b.of)};
  }
};
#endif

template <Real Scalar>
struct FourChoices {
  Lanes<Scalar> of;  ///< 1 or 0

  GYROSTAT_INLINE friend FourChoices operator&(const FourChoices& a, const FourChoices& b) noexcept {
    return {a.of * b.of};
  }
  GYROSTAT_INLINE friend FourChoices operator|(const FourChoices& a, const FourChoices& b) noexcept {
    return {a.of + b.of - a.of * b.of};
  }
};
template <Real Scalar>
  requires has_register<Scalar>
struct FourChoices<Scalar> {
  decltype(Lanes<Scalar>::v < Lanes<Scalar>::v) of;

  GYROSTAT_INLINE friend FourChoices operator&(const FourChoices& a, const FourChoices& b) noexcept {
    return {a.of & b.of};
  }
  GYROSTAT_INLINE friend FourChoices operator|(const FourChoices& a, const FourChoices& b) noexcept {
    return {a.of | b.of};
  }
};

#if defined(__GNUC__) && defined(__AVX512F__)
template <Real Scalar>
using ChoicesOf = std::conditional_t<wide_size<Scalar> == 8, EightChoices, FourChoices<Scalar>>;
#else
template <Real Scalar>
using ChoicesOf = FourChoices<Scalar>;
#endif
}  // namespace detail

/// A yes or no for each number. With &, |, and the functions below.
template <Real Scalar>
using WideChoices = detail::ChoicesOf<Scalar>;

/// Number by number, a < b; no where one of them is NaN.
template <Real Scalar>
GYROSTAT_INLINE WideChoices<Scalar> less(const Wide<Scalar>& a, const Wide<Scalar>& b) noexcept {
#if defined(__GNUC__) && defined(__AVX512F__)
  if constexpr (wide_size<Scalar> == 8) return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)};
#endif
  if constexpr (wide_size<Scalar> == 4 && Lanes<Scalar>::vectorised) {
    return {a.v < b.v};
  } else if constexpr (wide_size<Scalar> == 4) {
    return {lanes<Scalar>(a[0] < b[0], a[1] < b[1], a[2] < b[2], a[3] < b[3])};
  }
}

template <Real Scalar>
GYROSTAT_INLINE Wide<Scalar> choose(const WideChoices<Scalar>& yes, const Wide<Scalar>& a,
                                    const Wide<Scalar>& b) noexcept {
#if defined(__GNUC__) && defined(__AVX512F__)
  if constexpr (wide_size<Scalar> == 8) return {_mm512_mask_blend_pd(yes.of, b.v, a.v)};
#endif
  if constexpr (wide_size<Scalar> == 4 && Lanes<Scalar>::vectorised) {
    return {yes.of ? a.v : b.v};
  } else if constexpr (wide_size<Scalar> == 4) {
    Wide<Scalar> result = b;
    for (int i = 0; i < 4; ++i) result.v[i] = yes.of[i] != 0 ? a[i] : b[i];
    return result;
  }
}

/// The choices as a number, 2^i for a yes of number i.
template <Real Scalar>
GYROSTAT_INLINE unsigned bits(const WideChoices<Scalar>& yes) noexcept {
#if defined(__GNUC__) && defined(__AVX512F__)
  if constexpr (wide_size<Scalar> == 8) return yes.of;
#endif
  if constexpr (wide_size<Scalar> == 4) {
    unsigned result = 0;
    for (int i = 0; i < 4; ++i) result |= yes.of[i] != 0 ? 1u << i : 0u;
    return result;
  }
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
