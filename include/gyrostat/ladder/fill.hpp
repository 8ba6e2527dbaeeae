// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>

#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/question.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Times, warnings and counts, the same of every family.
inline void fill_head(Answer& answer, const Question& question, const Outcome& outcome) {
  answer.times = question.times;
  answer.warnings = outcome.warnings;
  answer.counts = outcome.counts;
}

/// Column number i of an answer, with room for `size` values; the room of an earlier answer in its place is used again.
inline Column& renewed_column(Answer& answer, std::size_t i, const ColumnKind& kind, std::size_t size) {
  if (i == answer.columns.size()) answer.columns.push_back({&kind, {}, nan<double>});
  Column& column = answer.columns[i];
  column = {&kind, std::move(column.values), nan<double>};
  column.values.resize(size);
  return column;
}

/// Columns of the writer's table from states: those that are asked for, or of a rung that is named and asked for nothing those that it has.
/// What it has not, `unknown` says; it is NaN, its error infinite.
template <class Writer>
void fill_columns(Answer& answer, const Writer& writer, std::span<const typename Writer::State> states,
                  const Errors<std::size(Writer::columns)>& error, const Question& question, const Family& family,
                  ColumnSet unknown = 0) {
  constexpr std::size_t count = std::size(Writer::columns);
  const bool all = question.asked.empty() && question.rung != any_rung;
  std::array<double*, count> to{};
  answer.columns.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ColumnKind& kind = Writer::columns[i];
    if (all ? has(unknown, i) : !aim_of(question, family, false, i)) continue;
    const std::size_t size = states.size() * std::size_t(kind.width);
    const double its_error = kind.measure == Measure::none ? nan<double> : error[i];
    if (has(unknown, i)) {
      answer.columns.push_back({&kind, std::vector<double>(size, nan<double>), infinity<double>});
    } else {
      answer.columns.push_back({&kind, std::vector<double>(size), its_error});
      to[i] = answer.columns.back().values.data();
    }
    if constexpr (requires { writer.scale; }) answer.columns.back().scale = writer.scale[i];
  }
  double row[row_width(Writer::columns)];
  for (const auto& state : states) {
    writer(state, row);
    const double* from = row;
    for (std::size_t i = 0; i < count; from += Writer::columns[i++].width)
      if (to[i]) to[i] = std::copy_n(from, Writer::columns[i].width, to[i]);
  }
}

/// The row at t = 0, where it is asked for, is the start as it was given, to the bit.
inline void put_start(Answer& answer, const ColumnKind& kind, std::initializer_list<double> given) {
  if (answer.times.front() != 0) return;
  for (Column& column : answer.columns)  // but where the rung knows nothing of it
    if (column.kind == &kind && column.values.front() == column.values.front())
      std::copy(given.begin(), given.end(), column.values.begin());
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
