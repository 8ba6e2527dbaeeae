// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/general/problem.hpp"

/// Tables over time as polynomials between their times.
namespace gyrostat::general {

/// c0 + c1 s + c2 s^2 + c3 s^3, s = t - origin.
template <Real Scalar>
struct Cubic {
  Scalar origin = 0;
  std::array<Scalar, 4> c{};

  Scalar operator()(Scalar t) const noexcept {
    const Scalar s = t - origin;
    return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
  }
  /// The sum of the sizes of its terms, which may cancel.
  Scalar terms(Scalar t) const noexcept {
    using std::abs;
    const Scalar s = abs(t - origin);
    return abs(c[0]) + s * (abs(c[1]) + s * (abs(c[2]) + s * abs(c[3])));
  }
  /// The same polynomial about another time.
  Cubic about(Scalar t) const noexcept {
    const Scalar s = t - origin;
    return {t, {(*this)(t), c[1] + s * (2 * c[2] + s * (3 * c[3])), c[2] + s * (3 * c[3]), c[3]}};
  }
  bool is_constant() const noexcept { return c[1] == 0 && c[2] == 0 && c[3] == 0; }
};

/// not_finite; out_of_domain: not `width` values for each time; not_increasing.
template <Real Scalar>
Errc check(const Table<Scalar>& table, std::size_t width) noexcept {
  using std::abs;
  if (table.values.size() != width * table.times.size()) return Errc::out_of_domain;
  for (const Scalar x : table.times)
    if (!(abs(x) < infinity<Scalar>)) return Errc::not_finite;
  for (const Scalar x : table.values)
    if (!(abs(x) < infinity<Scalar>)) return Errc::not_finite;
  for (std::size_t i = 1; i < table.times.size(); ++i)
    if (!(table.times[i - 1] < table.times[i])) return Errc::not_increasing;
  return Errc::ok;
}

namespace detail {

/// The slope at time i: that of the parabola through it and its neighbours, or at an end through the three nearest.
template <Real Scalar>
Scalar table_slope(const Table<Scalar>& table, std::size_t width, std::size_t column, std::size_t i) noexcept {
  const auto& t = table.times;
  const std::size_t last = t.size() - 1;
  const auto rise = [&](std::size_t k) noexcept {
    return (table.values[(k + 1) * width + column] - table.values[k * width + column]) / (t[k + 1] - t[k]);
  };
  if (last == 1) return rise(0);
  const std::size_t middle = std::clamp<std::size_t>(i, 1, last - 1);
  const Scalar before = t[middle] - t[middle - 1], behind = t[middle + 1] - t[middle];
  const Scalar curve = (rise(middle) - rise(middle - 1)) / (before + behind);
  // of the parabola at the middle one of its three times, and half its second derivative times the way to i
  return rise(middle - 1) + curve * before + 2 * curve * (t[i] - t[middle]);
}

}  // namespace detail

/// How far a cubic may go beyond the greatest value of its table. The slope of a jump between two times that lie close carries it on into
/// the long gaps beside them, farther than any table is meant to go.
inline constexpr double most_swing = 1000;

/// How far the cubics of a table that check() finds right go, at most, over its greatest value: by the points that span each of them.
template <Real Scalar>
Scalar swing(const Table<Scalar>& table, std::size_t width) noexcept {
  using std::abs, std::max;
  if (table.between != Between::cubic) return 1;
  Scalar values = 0, reached = 0;
  for (const Scalar x : table.values) values = max<Scalar>(values, abs(x));
  for (std::size_t i = 0; i + 1 < table.times.size(); ++i)
    for (std::size_t column = 0; column < width; ++column) {
      const Scalar third = (table.times[i + 1] - table.times[i]) / 3;
      const Scalar first = table.values[i * width + column], second = table.values[(i + 1) * width + column];
      reached = max<Scalar>(reached, abs(first + third * detail::table_slope(table, width, column, i)));
      reached = max<Scalar>(reached, abs(second - third * detail::table_slope(table, width, column, i + 1)));
    }
  return reached > values ? reached / values : Scalar(1);
}

/// One column of a table from `from` on, up to its next time: a table of `width` values a time that check() finds right.
template <Real Scalar>
Cubic<Scalar> piece(const Table<Scalar>& table, std::size_t width, std::size_t column, Scalar from) noexcept {
  const auto& t = table.times;
  if (t.empty()) return {};
  const auto value = [&](std::size_t i) noexcept { return table.values[i * width + column]; };
  if (from < t.front()) return {from, {table.holds ? value(0) : Scalar(0)}};
  if (from >= t.back()) return {from, {table.holds ? value(t.size() - 1) : Scalar(0)}};
  const auto i = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), from) - t.begin()) - 1;
  const Scalar h = t[i + 1] - t[i], rise = (value(i + 1) - value(i)) / h;
  Cubic<Scalar> made{t[i], {value(i)}};
  if (table.between == Between::linear) made.c[1] = rise;
  if (table.between == Between::cubic) {
    const Scalar first = detail::table_slope(table, width, column, i);
    const Scalar second = detail::table_slope(table, width, column, i + 1);
    made.c[1] = first;
    made.c[2] = (3 * rise - 2 * first - second) / h;
    made.c[3] = (first + second - 2 * rise) / (h * h);
  }
  return made;
}

/// Whether a table of single numbers has one value from 0 to `span`.
template <Real Scalar>
bool is_constant(const Table<Scalar>& table, Scalar span) noexcept {
  const auto& v = table.values;
  if (v.empty()) return true;
  const bool covers = table.holds || v[0] == 0 || (table.times.front() <= 0 && table.times.back() >= span);
  return covers && std::all_of(v.begin(), v.end(), [&](Scalar x) noexcept { return x == v[0]; });
}

}  // namespace gyrostat::general
