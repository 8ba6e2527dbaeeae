// SPDX-License-Identifier: BSD-3-Clause
// Between numpy and C++: array arguments, and errors raised as the exceptions of gyrostat.errors.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ode/status.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Plain data by name.
using Data = py::typing::Dict<py::str, py::object>;

/// A number that is not known.
inline constexpr double missing = gyrostat::nan<double>;

/// Raises gyrostat.errors.NAME; needs the GIL.
[[noreturn]] inline void raise(const char* name, const std::string& message) {
  const py::object type = py::module_::import("gyrostat.errors").attr(name);
  PyErr_SetString(type.ptr(), message.c_str());
  throw py::error_already_set();
}

/// The exception that belongs to a failure: the work was cancelled, it did not converge, or the input is outside the domain.
[[noreturn]] inline void raise(Errc code, const std::string& message) {
  switch (code) {
    case Errc::cancelled: raise("Cancelled", message);
    case Errc::no_convergence:
    case Errc::step_limit:
    case Errc::step_underflow: raise("ConvergenceError", message);
    default: raise("DomainError", message);
  }
}

inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

inline std::string text(const Array& values) {
  std::string made = "[";
  for (py::ssize_t i = 0; i < values.size() && i < 9; ++i) made += (i ? ", " : "") + text(values.data()[i]);
  return made + (values.size() > 9 ? ", ...]" : "]");
}

/// How an integration ended.
inline const char* symbol(ode::Status status) {
  switch (status) {
    case ode::Status::reached: return "reached";
    case ode::Status::event: return "event";
    case ode::Status::step_limit: return "step_limit";
    case ode::Status::step_underflow: return "step_underflow";
    case ode::Status::not_finite: return "not_finite";
    case ode::Status::cancelled: return "cancelled";
  }
  return "";
}

/// DomainError unless the array has the shape.
inline void require_shape(const char* name, const py::array& values, std::initializer_list<py::ssize_t> shape) {
  bool same = values.ndim() == py::ssize_t(shape.size());
  py::ssize_t axis = 0;
  for (const py::ssize_t length : shape) {
    if (same && length >= 0) same = values.shape(axis) == length;
    ++axis;
  }
  if (same) return;
  std::string wanted, given;
  for (const py::ssize_t length : shape) wanted += (length < 0 ? std::string("n") : std::to_string(length)) + ", ";
  for (py::ssize_t i = 0; i < values.ndim(); ++i) given += std::to_string(values.shape(i)) + ", ";
  raise("DomainError", std::string(name) + ": the shape is (" + given + "), not (" + wanted + ")");
}

/// DomainError unless all elements are finite.
inline void require_finite(const char* name, const Array& values) {
  for (py::ssize_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values.data()[i]))
      raise("DomainError", std::string(name) + " = " + text(values) + ": not finite");
}

inline Vec3<double> vector(const char* name, const Array& values) {
  require_shape(name, values, {3});
  require_finite(name, values);
  return {values.data()[0], values.data()[1], values.data()[2]};
}

/// A numpy array that owns what the vector held.
inline py::array_t<double> array(std::vector<double>&& values, std::vector<py::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<double>>(std::move(values));
  const py::capsule owner(owned.get(), [](void* p) { delete static_cast<std::vector<double>*>(p); });
  return py::array_t<double>(std::move(shape), owned.release()->data(), owner);
}

}  // namespace gyrostat::python
