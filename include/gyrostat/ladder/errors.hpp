// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/family.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// The greater of two numbers, NaN if either is.
template <Real Scalar>
constexpr Scalar greater(Scalar a, Scalar b) noexcept {
  return a >= b || !(a == a) ? a : b;
}

/// `error` over `size`, 0/0 = 0.
template <Real Scalar>
constexpr Scalar over(Scalar error, Scalar size) noexcept {
  return error == 0 ? Scalar(0) : error / size;
}

/// Makes an error relative to the answer one relative to the truth, which may be smaller by as much; infinite where the truth
/// may vanish.
template <Real Scalar>
constexpr Scalar relative_to_truth(Scalar error) noexcept {
  return error < 1 ? error / (1 - error) : error == error ? infinity<Scalar> : error;
}

/// One number for each column of a family.
template <std::size_t N, Real Scalar = double>
struct Errors {
  std::array<Scalar, N> of{};

  constexpr Scalar& operator[](std::size_t column) noexcept { return of[column]; }
  constexpr Scalar operator[](std::size_t column) const noexcept { return of[column]; }

  /// NaN if any is.
  constexpr Scalar greatest() const noexcept {
    Scalar most = 0;
    for (const Scalar e : of)
      if (!(e <= most)) most = most == most ? e : most;
    return most;
  }

  /// Column by column the greater of the two; NaN if either is.
  constexpr void raise(const Errors& by) noexcept {
    for (std::size_t i = 0; i < N; ++i) of[i] = greater(of[i], by.of[i]);
  }

  constexpr Errors& operator+=(const Errors& by) noexcept {
    for (std::size_t i = 0; i < N; ++i) of[i] += by.of[i];
    return *this;
  }
  constexpr Errors& operator*=(Scalar factor) noexcept {
    for (Scalar& e : of) e *= factor;
    return *this;
  }
  friend constexpr Errors operator+(Errors a, const Errors& b) noexcept { return a += b; }
  friend constexpr Errors operator*(Scalar factor, Errors a) noexcept { return a *= factor; }

  static constexpr Errors all(Scalar value) noexcept {
    Errors made;
    made.of.fill(value);
    return made;
  }
};

/// relative_to_truth of each column that is measured relative to its size.
template <std::size_t N, Real Scalar>
constexpr Errors<N, Scalar> relative_to_truth(Errors<N, Scalar> errors, const ColumnKind (&columns)[N]) noexcept {
  for (std::size_t i = 0; i < N; ++i)
    if (columns[i].measure == Measure::relative) errors[i] = relative_to_truth(errors[i]);
  return errors;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
