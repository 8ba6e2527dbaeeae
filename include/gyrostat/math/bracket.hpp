// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/real.hpp"

namespace gyrostat::math {

/// Two points between which a yes becomes a no; `yes` may be the larger one.
template <Real Scalar>
struct Bracket {
  Scalar yes, no;

  /// The same change after `trips` halvings, `ask(x)` deciding for the middle.
  template <class Ask>
  [[nodiscard]] Bracket halved(int trips, const Ask& ask) const noexcept {
    Bracket b = *this;
    for (int trip = 0; trip < trips; ++trip) {
      const Scalar middle = (b.yes + b.no) / 2;
      (ask(middle) ? b.yes : b.no) = middle;
    }
    return b;
  }
};

/// A change of sign of f between low < high, for a search that is driven from outside since f is dear or has other answers too:
///     for (int trip = 0; trip < 200; ++trip) { x = change.guess(trip); if (!change.contains(x)) break; change.take(x, f(x)); }
/// False position with the Illinois rule (Dowell and Jarratt 1971), where an end that stays has its f halved; every third guess
/// is the middle, so that the bracket shrinks for certain.
template <Real Scalar>
struct SignChange {
  Scalar low, f_low, high, f_high;

  /// Between low and high, or one of them where no number lies between.
  [[nodiscard]] Scalar guess(int trip) const noexcept {
    const Scalar middle = low + (high - low) / 2;
    if (trip % 3 == 2) return middle;
    const Scalar x = (low * f_high - high * f_low) / (f_high - f_low);
    return contains(x) ? x : middle;
  }
  [[nodiscard]] bool contains(Scalar x) const noexcept { return x > low && x < high; }

  void take(Scalar x, Scalar f) noexcept {
    if ((f < 0) == (f_high < 0)) {
      high = x;
      f_high = f;
      f_low /= 2;
    } else {
      low = x;
      f_low = f;
      f_high /= 2;
    }
  }
};

}  // namespace gyrostat::math
