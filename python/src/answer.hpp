// SPDX-License-Identifier: BSD-3-Clause
// The answer of a ladder as plain data, the same for every family.
#pragma once

#include <time.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "convert.hpp"
#include "gil.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/rung.hpp"

namespace gyrostat::python {

/// The values of a column: (n,) or (n, width); of words: a list.
inline py::object values_of(Column& column) {
  const ColumnKind& kind = *column.kind;
  if (kind.kind == Kind::word) {
    py::list words;
    for (const double place : column.values)
      words.append(std::isnan(place) ? py::object(py::str("")) : py::object(py::str(kind.words[std::size_t(place)])));
    return words;
  }
  const int width = column.row_width();
  const auto n = py::ssize_t(column.values.size()) / width;
  if (kind.width == 1) return array(std::move(column.values), {n});
  return array(std::move(column.values), {n, width});
}

/// A number or a vector, a truth value, a place, a name or a list of names; None where a truth value, a place or a name is not known.
inline py::object value_of(const Quantity& quantity) {
  const double first = quantity.values[0];
  switch (quantity.kind->kind) {
    case Kind::flag: return std::isnan(first) ? py::object(py::none()) : py::object(py::bool_(first != 0));
    case Kind::place: return std::isnan(first) ? py::object(py::none()) : py::object(py::int_(int(first)));
    case Kind::word:
      return std::isnan(first) ? py::object(py::none()) : py::object(py::str(quantity.kind->words[std::size_t(first)]));
    case Kind::words: {
      py::list names;
      for (std::size_t i = 0; i < quantity.kind->words.size(); ++i)
        if (has(ColumnSet(first), i)) names.append(quantity.kind->words[i]);
      return names;
    }
    default: break;
  }
  if (quantity.kind->width == 1) return py::float_(first + 0.0);  // no -0
  std::vector<double> values;
  for (int i = 0; i < quantity.kind->width; ++i) values.push_back(quantity.values[std::size_t(i)] + 0.0);
  return array(std::move(values), {quantity.kind->width});
}

/// The answer as plain data. Every scalar that is asked for, and where nothing was named every one of the family, is there, None where
/// this answer has no value of it.
inline Data to_python(Answer& answer, const Question& question, const Family& family, double seconds) {
  const bool explicit_scalars = !question.asked.empty();
  py::dict columns, error, scale, scalars, scalar_error, tolerances, counts;
  for (Column& column : answer.columns) {
    columns[column.kind->name] = values_of(column);
    if (column.kind->measure != Measure::none) error[column.kind->name] = column.error;
    if (!std::isnan(column.tolerance)) tolerances[column.kind->name] = column.tolerance;
    if (column.kind->measure == Measure::relative) scale[column.kind->name] = column.scale;
  }
  for (const Quantity& quantity : answer.quantities) {
    scalars[quantity.kind->name] = value_of(quantity);
    if (!std::isnan(quantity.tolerance)) tolerances[quantity.kind->name] = quantity.tolerance;
    scalar_error[quantity.kind->name] = std::isfinite(quantity.values[0]) ? quantity.error : missing;
  }
  for (const ScalarKind& kind : family.scalars) {
    if (explicit_scalars || scalars.contains(kind.name)) continue;
    scalars[kind.name] = py::none();
    scalar_error[kind.name] = missing;
  }
  py::list warnings, tried;
  for (const Warning& w : answer.warnings) {
    py::dict item;
    item["code"] = w.kind->code;
    item["message"] = std::isnan(w.value) ? std::string(w.text) : w.text + (" (" + text(w.value) + ")");
    warnings.append(item);
  }
  for (const Attempt& a : answer.tried) {
    py::dict item;
    item["model"] = a.model;
    item["error"] = std::isnan(a.error) ? py::object(py::none()) : py::object(py::float_(a.error));
    item["accepted"] = a.accepted;
    std::string why = a.why ? a.why : "";
    const double tolerance = a.excess > 0 && a.excess < infinity<double> ? a.error / a.excess : answer.tolerance;
    char over[80];
    std::snprintf(over, sizeof over, "error %.2g over tolerance %.2g", a.error, tolerance);
    if (std::isnan(a.excess) ? a.error > tolerance : a.excess > 1) why += (why.empty() ? "" : "; ") + std::string(over);
    item["why"] = why;
    item["predicted"] = std::isfinite(a.predicted) ? py::object(py::float_(a.predicted)) : py::object(py::none());
    item["spent"] = a.spent;
    tried.append(item);
  }
  counts["rhs"] = answer.counts.rhs;
  counts["steps"] = answer.counts.steps;
  counts["rejected"] = answer.counts.rejected;
  Data made;
  made["model"] = answer.model;
  made["met"] = answer.met;
  made["error"] = error;
  made["scale"] = scale;
  made["warnings"] = warnings;
  made["columns"] = columns;
  made["scalars"] = scalars;
  made["scalar_error"] = scalar_error;
  made["tolerances"] = tolerances;
  made["counts"] = counts;
  made["seconds"] = seconds;
  made["tried"] = tried;
  return made;
}

/// CPU time of this thread, s: what else the machine does is not in it.
inline double thread_seconds() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Runs `work` without the GIL; its result and the CPU time that it took, s.
template <class Work>
auto timed(Work&& work) {
  const Unlocked free;
  const double began = thread_seconds();
  auto made = work();
  return std::pair(std::move(made), thread_seconds() - began);
}

/// Whether a signal wants this thread to raise an exception, as Ctrl-C does, which is then set: at most twenty times a second the interpreter is asked.
inline bool signalled() noexcept {
  using Clock = std::chrono::steady_clock;
  thread_local Clock::time_point last;
  const auto now = Clock::now();
  if (now - last < std::chrono::milliseconds(50)) return false;
  last = now;
  const Locked hold;
  return PyErr_CheckSignals() != 0;
}

/// work(monitor) as timed() has it, watched by the caller's monitor or by one that hears signals alone. Raises what a signal raises.
template <class Work>
auto watched(const std::optional<std::shared_ptr<Monitor>>& given, Work&& work) {
  Monitor own;
  own.stop = &signalled;
  auto made = timed([&] { return work(given ? given->get() : &own); });
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  return made;
}

/// The exception of a climb that ended without an answer.
inline void require_answer(const Refusal& refusal) {
  if (refusal.code == Errc::ok) return;
  raise(refusal.code,
        refusal.code == Errc::cancelled ? "cancelled" : std::string("model ") + refusal.model + ": " + refusal.why);
}

}  // namespace gyrostat::python
