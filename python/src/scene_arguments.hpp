// SPDX-License-Identifier: BSD-3-Clause
// The physics of a deceleration scene, from Python arguments.
#pragma once

#include <string>

#include "convert.hpp"
#include "gyrostat/body/inertia.hpp"
#include "gyrostat/models/deceleration/problem.hpp"

namespace gyrostat::python {

/// A body from three moments or a tensor in body axes; DomainError names what is wrong.
template <Real Scalar = double>
Inertia<Scalar> body(const Array& inertia) {
  require_finite("inertia", inertia);
  Mat3<Scalar> J = Mat3<Scalar>::Zero();
  if (inertia.ndim() == 2) {
    require_shape("inertia", inertia, {3, 3});
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) J(i, j) = Scalar(inertia.data()[3 * i + j]);
  } else {
    require_shape("inertia", inertia, {3});
    for (int i = 0; i < 3; ++i) J(i, i) = Scalar(inertia.data()[i]);
  }
  const auto made = Inertia<Scalar>::from_tensor(J);
  if (!made) raise("DomainError", "inertia = " + text(inertia) + ": " + message(made.error()));
  return *made;
}

inline deceleration::Law law(const char* name, const std::string& value) {
  if (value == "total") return deceleration::Law::total;
  if (value == "carrier") return deceleration::Law::carrier;
  raise("DomainError", std::string(name) + " = '" + value + "': use total or carrier");
}

/// Times from numpy: (n,), increasing, finite, the first >= 0.
inline std::vector<double> times(const Array& values) {
  require_shape("times", values, {-1});
  require_finite("times", values);
  if (values.size() == 0) raise("DomainError", "times = []: give at least one time");
  for (py::ssize_t i = 0; i < values.size(); ++i) {
    const double t = values.data()[i];
    if (t < 0) raise("DomainError", "times: element " + std::to_string(i) + " = " + text(t) + " is negative");
    if (i > 0 && !(t > values.data()[i - 1]))
      raise("DomainError",
            "times: element " + std::to_string(i) + " = " + text(t) + " does not come after the one before");
  }
  return {values.data(), values.data() + values.size()};
}

inline void require_not_negative(const char* name, const Array& values) {
  for (py::ssize_t i = 0; i < values.size(); ++i)
    if (!(values.data()[i] >= 0))
      raise("DomainError", std::string(name) + " = " + text(values) + ": an element is negative");
}

inline double drag_rate(double drag) {
  if (!(drag >= 0) || !std::isfinite(drag))
    raise("DomainError", "drag = " + text(drag) + ": give a finite number >= 0");
  return drag;
}

}  // namespace gyrostat::python
