// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "gyrostat/core/real.hpp"

#if defined(__GNUC__) && defined(__FMA__) && defined(__AVX__)
#include <immintrin.h>
#endif

#if defined(__GNUC__)
#define GYROSTAT_INLINE __attribute__((always_inline)) inline
#define GYROSTAT_INLINE_LAMBDA __attribute__((always_inline))
#define GYROSTAT_NOINLINE __attribute__((noinline))
#else
#define GYROSTAT_INLINE inline
#define GYROSTAT_INLINE_LAMBDA
#define GYROSTAT_NOINLINE
#endif

namespace gyrostat::inline GYROSTAT_LEVEL {

namespace detail {

/// Four numbers without a vector register of their own (long double, or a compiler without vector extensions).
template <Real Scalar>
struct FourNumbers {
  Scalar value[4];
  GYROSTAT_INLINE constexpr Scalar& operator[](int i) noexcept { return value[i]; }
  GYROSTAT_INLINE constexpr const Scalar& operator[](int i) const noexcept { return value[i]; }
};

template <Real Scalar>
struct Register {
  using type = FourNumbers<Scalar>;
};

#if defined(__GNUC__)
template <>
struct Register<double> {
  using type [[gnu::vector_size(32)]] = double;
};
template <>
struct Register<float> {
  using type [[gnu::vector_size(16)]] = float;
};
#endif

template <Real Scalar>
inline constexpr bool has_register = !std::is_same_v<typename Register<Scalar>::type, FourNumbers<Scalar>>;

}  // namespace detail

/// Four numbers side by side, worked on at once: a vector register for float and double. Everything is inlined, so no
/// register type crosses a function call and the ABI does not depend on the instruction set.
template <Real Scalar>
struct Lanes {
  using Register = typename detail::Register<Scalar>::type;
  static constexpr bool vectorised = detail::has_register<Scalar>;

  Register v;

  GYROSTAT_INLINE Scalar operator[](int i) const noexcept { return v[i]; }

  GYROSTAT_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
    if constexpr (vectorised) {
      return {a.v + b.v};
    } else {
      return {{{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}}};
    }
  }
  GYROSTAT_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept {
    if constexpr (vectorised) {
      return {a.v - b.v};
    } else {
      return {{{a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}}};
    }
  }
  GYROSTAT_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
    if constexpr (vectorised) {
      return {a.v * b.v};
    } else {
      return {{{a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]}}};
    }
  }
  GYROSTAT_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
    if constexpr (vectorised) {
      return {a.v / b.v};
    } else {
      return {{{a[0] / b[0], a[1] / b[1], a[2] / b[2], a[3] / b[3]}}};
    }
  }
};

template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> lanes(Scalar a, Scalar b, Scalar c, Scalar d) noexcept {
  if constexpr (Lanes<Scalar>::vectorised) {
    return {typename Lanes<Scalar>::Register{a, b, c, d}};
  } else {
    return {{{a, b, c, d}}};
  }
}

/// The same number in all lanes.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> lanes(Scalar a) noexcept {
  return lanes(a, a, a, a);
}

/// Four numbers from memory, aligned or not.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> load(const Scalar* from) noexcept {
  Lanes<Scalar> result;
  std::memcpy(&result.v, from, 4 * sizeof(Scalar));
  return result;
}

template <Real Scalar>
GYROSTAT_INLINE void store(Scalar* to, const Lanes<Scalar>& a) noexcept {
  std::memcpy(to, &a.v, 4 * sizeof(Scalar));
}

/// Whether multiply_add of Scalar is rounded once.
#if defined(__GNUC__) && defined(__FMA__) && defined(__AVX__)
template <Real Scalar>
inline constexpr bool fuses = std::is_same_v<Scalar, double> || std::is_same_v<Scalar, float>;
#else
template <Real Scalar>
inline constexpr bool fuses = false;
#endif

/// a b + c, rounded once where the machine has the instruction.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> multiply_add(const Lanes<Scalar>& a, const Lanes<Scalar>& b,
                                           const Lanes<Scalar>& c) noexcept {
#if defined(__GNUC__) && defined(__FMA__) && defined(__AVX__)
  if constexpr (std::is_same_v<Scalar, double>) {
    return {_mm256_fmadd_pd(a.v, b.v, c.v)};
  } else if constexpr (std::is_same_v<Scalar, float>) {
    return {_mm_fmadd_ps(a.v, b.v, c.v)};
  } else {
    return a * b + c;
  }
#else
  return a * b + c;
#endif
}

/// Lanes (i, j, k, l) of a.
template <int i, int j, int k, int l, Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> shuffle(const Lanes<Scalar>& a) noexcept {
#if defined(__GNUC__)
  if constexpr (Lanes<Scalar>::vectorised) {
    return {__builtin_shufflevector(a.v, a.v, i, j, k, l)};
  } else {
    return lanes(a[i], a[j], a[k], a[l]);
  }
#else
  return lanes(a[i], a[j], a[k], a[l]);
#endif
}

/// Lanes 0 to 2 of a and lane 3 of b.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> with_last(const Lanes<Scalar>& a, const Lanes<Scalar>& b) noexcept {
#if defined(__GNUC__)
  if constexpr (Lanes<Scalar>::vectorised) {
    return {__builtin_shufflevector(a.v, b.v, 0, 1, 2, 7)};
  } else {
    return lanes(a[0], a[1], a[2], b[3]);
  }
#else
  return lanes(a[0], a[1], a[2], b[3]);
#endif
}

/// The sum of the four lanes, in all lanes.
template <Real Scalar>
GYROSTAT_INLINE Lanes<Scalar> sum(const Lanes<Scalar>& a) noexcept {
  const Lanes<Scalar> pairs = a + shuffle<1, 0, 3, 2>(a);
  return pairs + shuffle<2, 3, 0, 1>(pairs);
}

/// The greatest magnitude in the four lanes; NaN if one of them is not finite.
template <Real Scalar>
GYROSTAT_INLINE Scalar greatest_magnitude(const Lanes<Scalar>& a) noexcept {
  const Scalar x = std::abs(a[0]), y = std::abs(a[1]), z = std::abs(a[2]), w = std::abs(a[3]);
  const Scalar greatest = std::max(std::max(x, y), std::max(z, w));
  return greatest + 0 * (x + y + z + w);
}

/// 1/n as a number and what its rounding leaves.
template <Real Scalar>
struct Reciprocal {
  Scalar high = 0, low = 0;

  static constexpr Reciprocal of(int n) noexcept {
    const Scalar high = Scalar(1) / Scalar(n);
    return {high, static_cast<Scalar>((1 - static_cast<long double>(high) * n) / n)};
  }
};

namespace detail {

template <Real Scalar>
inline constexpr auto reciprocals = [] {
  std::array<Reciprocal<Scalar>, 64> made{};
  for (int n = 1; n < 64; ++n) made[std::size_t(n)] = Reciprocal<Scalar>::of(n);
  return made;
}();

}  // namespace detail

/// v/(k + 1), k < 63 a number or an index of count_up: what a Taylor recurrence ends in. A rounded reciprocal is off to one side in every step, for all
/// runs alike, and over thousands of steps that outgrows the roundings that come and go; here it is in two words, or the quotient is taken. Beyond the
/// eighth the coefficients of steps to rounding are too small for it. Row: Lanes or LanePair; all(x): a row of the number x.
template <Real Scalar, class Row, class Index, class All>
GYROSTAT_INLINE Row over_next(const Row& v, Index k, const All& all) noexcept {
  const auto exactly = [&](int n, const Reciprocal<Scalar>& share) GYROSTAT_INLINE_LAMBDA {
    if constexpr (fuses<Scalar>) return multiply_add(v, all(share.high), v * all(share.low));
    else return v / all(Scalar(n));
  };
  if constexpr (std::is_integral_v<Index>) {
    return exactly(int(k) + 1, detail::reciprocals<Scalar>[std::size_t(k + 1)]);
  } else {
    constexpr int n = Index::value + 1;
    constexpr auto share = Reciprocal<Scalar>::of(n);
    if constexpr (n > 8 || share.low == 0) return v * all(share.high);
    else return exactly(n, share);
  }
}
template <Real Scalar, class Index>
GYROSTAT_INLINE Lanes<Scalar> over_next(const Lanes<Scalar>& v, Index k) noexcept {
  return over_next<Scalar>(v, k, [](Scalar x) GYROSTAT_INLINE_LAMBDA { return lanes(x); });
}

/// term(from), ..., term(1): unrolled where lanes are registers and the number of turns is known to the compiler.
template <Real Scalar, class Term>
GYROSTAT_INLINE void count_down(int from, const Term& term) noexcept {
  if constexpr (Lanes<Scalar>::vectorised) {
#pragma GCC unroll 32
    for (int j = from; j >= 1; --j) term(j);
  } else {
    for (int j = from; j >= 1; --j) term(j);
  }
}

/// term(1), ..., term(to): unrolled, with k a constant to the compiler, where lanes are registers. A term that is a lambda wants
/// GYROSTAT_INLINE_LAMBDA: a call for an order costs more than its arithmetic.
template <Real Scalar, int to, class Term>
GYROSTAT_INLINE void count_up(const Term& term) noexcept {
  if constexpr (Lanes<Scalar>::vectorised) {
    [&]<int... k>(std::integer_sequence<int, k...>) GYROSTAT_INLINE_LAMBDA {
      (term(std::integral_constant<int, k + 1>{}), ...);
    }(std::make_integer_sequence<int, to>{});
  } else {
    for (int k = 1; k <= to; ++k) term(k);
  }
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
