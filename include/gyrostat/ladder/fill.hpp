// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>

#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/question.hpp"

namespace gyrostat {

/// Times, warnings and counts, the same of every family.
inline void fill_head(Answer& answer, const Question& question, const Outcome& outcome) {
  answer.times = question.times;
  answer.warnings = outcome.warnings;
  answer.counts = outcome.counts;
}

/// Columns of the writer's table from states, those that are `kept`; the answer's error is the greatest of theirs.
template <class Writer>
void fill_columns(Answer& answer, const Writer& writer, std::span<const typename Writer::State> states,
                  const Errors<std::size(Writer::columns)>& error,
                  const std::array<bool, std::size(Writer::columns)>& kept) {
  constexpr std::size_t count = std::size(Writer::columns);
  std::array<double*, count> to{};
  answer.columns.reserve(count);
  answer.error = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!kept[i]) continue;
    const ColumnKind& kind = Writer::columns[i];
    const bool measured = kind.measure != Measure::none;
    answer.columns.push_back(
        {&kind, std::vector<double>(states.size() * std::size_t(kind.width)), measured ? error[i] : nan<double>});
    if constexpr (requires { writer.scale; }) answer.columns.back().scale = writer.scale[i];
    to[i] = answer.columns.back().values.data();
    if (measured) answer.error = greater(error[i], answer.error);
  }
  double row[row_width(Writer::columns)];
  for (const auto& state : states) {
    writer(state, row);
    const double* from = row;
    for (std::size_t i = 0; i < count; from += Writer::columns[i++].width)
      if (kept[i]) to[i] = std::copy_n(from, Writer::columns[i].width, to[i]);
  }
}

/// The first `count` columns.
template <class Writer>
void fill_columns(Answer& answer, const Writer& writer, std::span<const typename Writer::State> states,
                  const Errors<std::size(Writer::columns)>& error, std::size_t count = std::size(Writer::columns)) {
  std::array<bool, std::size(Writer::columns)> kept{};
  std::fill_n(kept.begin(), count, true);
  fill_columns(answer, writer, states, error, kept);
}

/// The row at t = 0, where it is asked for, is the start as it was given, to the bit.
inline void put_start(Answer& answer, const ColumnKind& kind, std::initializer_list<double> given) {
  if (answer.times.front() != 0) return;
  for (Column& column : answer.columns)
    if (column.kind == &kind) std::copy(given.begin(), given.end(), column.values.begin());
}

}  // namespace gyrostat
