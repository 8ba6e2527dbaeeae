// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ode/status.hpp"

/// What the ladder says of a scene. Names and texts are string literals; numbers are formatted at the edge.
namespace gyrostat {

/// One output column: n rows of `width` numbers, row after row.
struct Column {
  const char* name;
  int width;
  std::vector<double> values;
  /// Estimated greatest error over the span, relative to the greatest norm of the column over the span
  /// (attitude: rotation angle in rad; modulus_squared: absolute). NaN where the column has no error (regime).
  double error;
};

/// One number, or one vector, about the whole motion.
struct Quantity {
  const char* name;
  int width;
  double values[3];
  double error = nan<double>;  ///< estimated, relative; NaN where it is a definition and has none
};

/// Something the user should know; `value` is the number that raised it, NaN if there is none.
struct Warning {
  const char* code;
  const char* text;
  double value;
};

/// A rung that was looked at.
struct Attempt {
  const char* model;
  double error;  ///< its own estimate; NaN where it was passed over unsolved
  bool accepted;
  const char* why;  ///< why it was passed over; nullptr where only the error decided
};

struct Answer {
  const char* model = "";
  double tolerance = 0;
  double error = nan<double>;  ///< greatest error of any column
  bool met = false;
  std::vector<double> times;
  std::vector<Column> columns;
  std::vector<Quantity> quantities;
  std::vector<Warning> warnings;
  std::vector<Attempt> tried;
  ode::Counts counts;

  const Column* find(const char* name) const noexcept {
    for (const Column& column : columns)
      for (const char *p = column.name, *q = name; *p == *q; ++p, ++q)
        if (*p == '\0') return &column;
    return nullptr;
  }
};

}  // namespace gyrostat
