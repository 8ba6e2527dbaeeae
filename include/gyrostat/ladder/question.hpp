// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// What advances the full equations, of the library's own; `any` leaves it to the family: Taylor series, or Radau where the motion is
/// stiff. A scene may bring another (full_equations).
enum class Integrator : std::uint8_t { any, taylor, radau };

/// In place of a rung's place in the table of its family: climb the ladder.
inline constexpr int any_rung = -1;

/// One column or scalar that is asked for.
struct AskedQuantity {
  std::size_t place;  ///< in its family's table of columns, or of scalars
  bool scalar = false;
  double tolerance = nan<double>;  ///< greatest error wanted, as its table measures it; NaN: that of the question
  bool absolute = false;           ///< the tolerance is in the unit of the column or scalar
  bool needed = true;              ///< false: an answer without a value of it will do
};

/// What is asked of a scene, the same for every family.
struct Question {
  std::vector<double> times;  ///< s, increasing, the first >= 0
  double tolerance = 1e-6;    ///< greatest error wanted in what is asked, as its table measures it
  int rung = any_rung;        ///< place in the family's table of the one rung that is to answer
  /// The only rung that is asked, as it would be on the way up the ladder: it refuses where it is not sure to meet, as `rung` does not.
  int only_rung = any_rung;
  Integrator integrator = Integrator::any;
  bool wants_attitude = false;         ///< of families that can leave it out
  std::vector<AskedQuantity> asked{};  ///< empty: what the family gives by default; of a rung that is named, all it has
};

/// Whether scalars are asked for by name.
inline bool asks_for_scalars(const Question& question) noexcept {
  return std::any_of(question.asked.begin(), question.asked.end(),
                     [](const AskedQuantity& each) { return each.scalar; });
}

/// Whether an answer tells scalars: where nothing is asked by name it tells what it can.
inline bool tells_scalars(const Question& question) noexcept {
  return question.asked.empty() || asks_for_scalars(question);
}

/// Whether it tells the scalar at this place of the table.
inline bool tells_scalar(const Question& question, std::size_t place) noexcept {
  return question.asked.empty() ||
         std::any_of(question.asked.begin(), question.asked.end(),
                     [place](const AskedQuantity& each) { return each.scalar && each.place == place; });
}

/// Whether an answer can be asked for at these times, s, to this tolerance. Errc::not_finite; out_of_domain: no times, or a
/// tolerance outside (0, 1); negative: a time before the start; not_increasing.
inline Errc check_times(std::span<const double> times, double tolerance) noexcept {
  if (!std::isfinite(tolerance)) return Errc::not_finite;
  if (!(tolerance > 0 && tolerance < 1) || times.empty()) return Errc::out_of_domain;
  double last = -1;
  for (const double t : times) {
    if (!std::isfinite(t)) return Errc::not_finite;
    if (t < 0) return Errc::negative;
    if (!(t > last)) return Errc::not_increasing;
    last = t;
  }
  return Errc::ok;
}

/// Whether the square of a size is a number with all its digits; of 0, too.
inline bool can_be_squared(double size) noexcept {
  const double square = size * size;
  return size == 0 || (square >= std::numeric_limits<double>::min() && square < infinity<double>);
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
