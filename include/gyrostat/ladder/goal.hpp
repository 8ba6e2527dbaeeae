// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/question.hpp"

/// What a question asks of each column and scalar, and how far an answer is from it.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// What is asked of one column or scalar.
struct Aim {
  double tolerance;
  bool absolute;
  bool needed;
};

/// The aim of a column, or of a scalar; nothing where it is not asked for.
inline std::optional<Aim> aim_of(const Question& question, const Family& family, bool scalar,
                                 std::size_t place) noexcept {
  if (question.asked.empty()) {
    const auto& counted = family.asked_scalars;
    const bool asked = scalar ? std::find(counted.begin(), counted.end(), place) != counted.end()
                              : question.rung != any_rung || question.wants_attitude || !has(family.unasked, place);
    return asked ? std::optional(Aim{question.tolerance, false, !scalar}) : std::nullopt;
  }
  for (const AskedQuantity& each : question.asked)
    if (each.scalar == scalar && each.place == place)
      return Aim{each.tolerance == each.tolerance ? each.tolerance : question.tolerance, each.absolute, each.needed};
  return std::nullopt;
}

/// Whether a value of the column has to be there.
inline bool needs_column(const Question& question, const Family& family, std::size_t place) noexcept {
  const auto aim = aim_of(question, family, false, place);
  return aim && aim->needed;
}

/// The tolerances of a family's columns as its table measures them, infinite where they are not asked for, and the least of them and of those
/// of the scalars. `scale` is that of the columns: one that outgrows it is held to an absolute tolerance by `judge` alone.
template <std::size_t N>
struct Goal {
  Errors<N> columns;
  double tightest;

  static Goal of(const Question& question, const Family& family, const Errors<N>& scale) noexcept {
    Goal goal{Errors<N>::all(infinity<double>), infinity<double>};
    for (std::size_t i = 0; i < N; ++i) {
      const ColumnKind& kind = family.columns[i];
      const auto aim = aim_of(question, family, false, i);
      if (!aim || kind.measure == Measure::none) continue;
      const bool over_scale = aim->absolute && kind.measure == Measure::relative;
      goal.columns[i] = over_scale && scale[i] > 0 ? aim->tolerance / scale[i] : aim->tolerance;
      goal.tightest = std::min(goal.tightest, goal.columns[i]);
    }
    for (std::size_t i = 0; i < family.scalars.size(); ++i)
      if (const auto aim = aim_of(question, family, true, i); aim && !aim->absolute)
        goal.tightest = std::min(goal.tightest, aim->tolerance);
    goal.tightest = goal.tightest < 1 ? goal.tightest : question.tolerance;
    return goal;
  }

  /// The least tolerance of these columns; infinite where none is asked for.
  double tightest_of(ColumnSet set) const noexcept {
    double least = infinity<double>;
    for (std::size_t i = 0; i < N; ++i)
      if (has(set, i)) least = std::min(least, columns[i]);
    return least;
  }

  /// The greatest error over its tolerance; NaN if one is.
  template <Real Scalar>
  Scalar excess(const Errors<N, Scalar>& error) const noexcept {
    Scalar most = 0;
    for (std::size_t i = 0; i < N; ++i)
      if (columns[i] < infinity<double>) most = greater(over(error[i], Scalar(columns[i])), most);
    return most;
  }
};

/// The greatest norm of a column's rows, or its scale, whichever is greater.
inline double size_of(const Column& column) noexcept {
  double size = column.scale;
  const auto width = std::size_t(column.row_width());
  for (std::size_t row = 0; row + width <= column.values.size(); row += width) {
    double square = 0;
    for (std::size_t i = 0; i < width; ++i) square += column.values[row + i] * column.values[row + i];
    size = std::max(size, std::sqrt(square));
  }
  return size;
}

/// The error of a column in the unit of its values.
inline double absolute_error(const Column& column) noexcept {
  return column.kind->measure == Measure::relative ? column.error * size_of(column) : column.error;
}

/// The magnitude of a scalar, or of the vector that it is.
inline double size_of(const Quantity& quantity) noexcept {
  return std::hypot(quantity.values[0], quantity.values[1], quantity.values[2]);
}

/// Holds an answer's errors against what is asked: sets error, excess, and the tolerance of each column and scalar.
inline void judge(Answer& answer, const Question& question, const Family& family) noexcept {
  answer.error = answer.excess = 0;
  const auto hold = [&](double error, double tolerance) noexcept {
    answer.error = greater(error, answer.error);
    answer.excess = greater(over(error, tolerance), answer.excess);
  };
  for (Column& column : answer.columns) {
    const auto place = std::size_t(column.kind - family.columns.data());
    const auto aim = aim_of(question, family, false, place);
    if (!aim || column.kind->measure == Measure::none) continue;
    const bool over_size = aim->absolute && column.kind->measure == Measure::relative;
    column.tolerance = over_size ? aim->tolerance / size_of(column) : aim->tolerance;
    const bool has_value = !column.values.empty() && !std::isnan(column.values.front());
    if (aim->needed || has_value) hold(column.error, column.tolerance);
  }
  for (std::size_t place = 0; place < family.scalars.size(); ++place) {
    const auto aim = aim_of(question, family, true, place);
    if (!aim) continue;
    const auto at = std::find_if(answer.quantities.begin(), answer.quantities.end(),
                                 [&](const Quantity& q) { return q.kind == &family.scalars[place]; });
    if (at == answer.quantities.end() || std::isnan(at->values[0])) {
      if (aim->needed) hold(infinity<double>, aim->tolerance);
      continue;
    }
    if (std::isnan(at->error)) continue;  // a definition
    const bool over_value = aim->absolute && at->kind->measure == Measure::relative;
    at->tolerance = over_value ? aim->tolerance / size_of(*at) : aim->tolerance;
    hold(at->error, at->tolerance);
  }
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
