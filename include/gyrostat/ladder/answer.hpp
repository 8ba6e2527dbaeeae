// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ode/status.hpp"

/// What the ladder says of a scene. Names and texts are string literals; numbers are formatted at the edge.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// One output column: n rows of row_width() numbers, row after row.
struct Column {
  const ColumnKind* kind;
  std::vector<double> values;
  double error;      ///< estimated greatest error over the span, as kind->measure says; NaN where it has none
  double scale = 0;  ///< kind->scale of this scene, in the unit of the column
  double tolerance = nan<double>;  ///< what `error` is held against; NaN: nothing
  int width = 0;                   ///< of a kind that has per_rotor

  std::string_view name() const noexcept { return kind->name; }
  int row_width() const noexcept { return kind->width == per_rotor ? width : kind->width; }
};

/// One number, or one vector, about the whole motion.
struct Quantity {
  const ScalarKind* kind;
  std::array<double, 3> values;
  double error = nan<double>;      ///< estimated, as kind->measure says; NaN where it is a definition and has none
  double tolerance = nan<double>;  ///< what `error` is held against; NaN: nothing

  std::string_view name() const noexcept { return kind->name; }
};

/// Something the user should know; `value` is the number that raised it, NaN if there is none.
struct Warning {
  const WarningKind* kind;
  const char* text;  ///< kind->text, or what says more of this case
  double value;

  std::string_view code() const noexcept { return kind->code; }
};

/// A rung that was looked at.
struct Attempt {
  const char* model;
  double error;  ///< its own estimate; NaN where it was passed over unsolved
  bool accepted;
  const char* why;                 ///< why it was passed over; nullptr where only the error decided
  double excess = nan<double>;     ///< greatest error over its tolerance; NaN where that was not looked at
  double predicted = nan<double>;  ///< cost foreseen, s of one core (RungCost); NaN where the rung could not be asked
  double spent = 0;                ///< what it took on this machine, s
};

/// What solve() gives: a model, what it says at the times asked for and of the whole motion, and how sure it is. On the heap.
struct Answer {
  const char* model = "";       ///< the rung that answers, by its name in the table of the family
  double tolerance = 0;         ///< that of the question
  double error = nan<double>;   ///< greatest error of what is asked
  double excess = nan<double>;  ///< greatest error over its tolerance
  bool met = false;             ///< no error of what is asked is over its tolerance
  std::vector<double> times;    ///< those of the question, s: a row of each column for each
  std::vector<Column> columns;
  std::vector<Quantity> quantities;
  std::vector<Warning> warnings;
  std::vector<Attempt> tried;  ///< the rungs that were looked at, in that order
  ode::Counts counts;          ///< work of the rung that answers

  /// The column of that name; nullptr where there is none.
  const Column* find(std::string_view name) const noexcept {
    for (const Column& column : columns)
      if (column.name() == name) return &column;
    return nullptr;
  }
  /// The scalar of that name, likewise.
  const Quantity* quantity(std::string_view name) const noexcept {
    for (const Quantity& each : quantities)
      if (each.name() == name) return &each;
    return nullptr;
  }
  /// Whether there is a warning of that code.
  bool warns(std::string_view code) const noexcept {
    for (const Warning& warning : warnings)
      if (warning.code() == code) return true;
    return false;
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
