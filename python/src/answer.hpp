// SPDX-License-Identifier: BSD-3-Clause
// The answer of a ladder as plain data, the same for every family.
#pragma once

#include <time.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "convert.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/rung.hpp"

namespace gyrostat::python {

/// The values of a column (n,) or (n, width).
inline py::object numbers(Column& column) {
  const auto n = py::ssize_t(column.values.size()) / column.width;
  if (column.width == 1) return array(std::move(column.values), {n});
  return array(std::move(column.values), {n, column.width});
}

/// A number, or a vector.
inline py::object number(const Quantity& quantity) {
  std::vector<double> values;
  for (int i = 0; i < quantity.width; ++i) values.push_back(quantity.values[i] + 0.0);  // no -0
  if (quantity.width == 1) return py::float_(values[0]);
  return array(std::move(values), {quantity.width});
}

/// A family whose columns or quantities are not all numbers hands in functions of its own; what is no array has no error.
inline Data to_python(Answer& answer, double seconds, py::object (*values_of)(Column&) = &numbers,
                      py::object (*value_of)(const Quantity&) = &number) {
  py::dict columns, error, scalars, scalar_error, counts;
  for (Column& column : answer.columns) {
    const py::object values = values_of(column);
    columns[column.name] = values;
    if (py::isinstance<py::array>(values)) error[column.name] = column.error;
  }
  for (const Quantity& quantity : answer.quantities) {
    scalars[quantity.name] = value_of(quantity);
    scalar_error[quantity.name] = std::isfinite(quantity.values[0]) ? quantity.error : missing;
  }
  py::list warnings, tried;
  for (const Warning& w : answer.warnings) {
    py::dict item;
    item["code"] = w.code;
    item["message"] = std::isnan(w.value) ? std::string(w.text) : w.text + (" (" + text(w.value) + ")");
    warnings.append(item);
  }
  for (const Attempt& a : answer.tried) {
    py::dict item;
    item["model"] = a.model;
    item["error"] = std::isnan(a.error) ? py::object(py::none()) : py::object(py::float_(a.error));
    item["accepted"] = a.accepted;
    std::string why = a.why ? a.why : "";
    char over[80];
    std::snprintf(over, sizeof over, "error %.2g over tolerance %.2g", a.error, answer.tolerance);
    if (a.error > answer.tolerance) why += (why.empty() ? "" : "; ") + std::string(over);
    item["why"] = why;
    tried.append(item);
  }
  counts["rhs"] = answer.counts.rhs;
  counts["steps"] = answer.counts.steps;
  counts["rejected"] = answer.counts.rejected;
  Data made;
  made["model"] = answer.model;
  made["met"] = answer.met;
  made["error"] = error;
  made["warnings"] = warnings;
  made["columns"] = columns;
  made["scalars"] = scalars;
  made["scalar_error"] = scalar_error;
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
  const py::gil_scoped_release free;
  const double began = thread_seconds();
  auto made = work();
  return std::pair(std::move(made), thread_seconds() - began);
}

/// The exception of a climb that ended without an answer.
inline void require_answer(const Refusal& refusal) {
  if (refusal.code == Errc::ok) return;
  raise(refusal.code,
        refusal.code == Errc::cancelled ? "cancelled" : std::string("model ") + refusal.model + ": " + refusal.why);
}

}  // namespace gyrostat::python
