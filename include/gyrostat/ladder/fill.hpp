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

/// The first `count` columns of the writer's table from states; the answer's error is the greatest of theirs.
template <class Writer>
void fill_columns(Answer& answer, const Writer& writer, std::span<const typename Writer::State> states,
                  const Errors<std::size(Writer::columns)>& error, std::size_t count = std::size(Writer::columns)) {
  constexpr std::size_t most = std::size(Writer::columns);
  std::array<double*, most> to{};
  answer.columns.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ColumnKind& kind = Writer::columns[i];
    answer.columns.push_back({&kind, std::vector<double>(states.size() * std::size_t(kind.width)), error[i]});
    if constexpr (requires { writer.scale; }) answer.columns.back().scale = writer.scale[i];
    to[i] = answer.columns.back().values.data();
  }
  double row[row_width(Writer::columns)];
  for (const auto& state : states) {
    writer(state, row);
    const double* from = row;
    for (std::size_t i = 0; i < count; ++i)
      for (int j = 0; j < Writer::columns[i].width; ++j) *to[i]++ = *from++;
  }
  answer.error = 0;
  for (std::size_t i = 0; i < count; ++i) answer.error = greater(error[i], answer.error);
}

/// The row at t = 0, where it is asked for, is the start as it was given, to the bit.
inline void put_start(Answer& answer, const ColumnKind& kind, std::initializer_list<double> given) {
  if (answer.times.front() != 0) return;
  for (Column& column : answer.columns)
    if (column.kind == &kind) std::copy(given.begin(), given.end(), column.values.begin());
}

}  // namespace gyrostat
