// SPDX-License-Identifier: BSD-3-Clause
// The physics of a scene, from Python arguments.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "convert.hpp"
#include "gyrostat/body/inertia.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::python {

/// A body from three moments or a tensor in body axes; DomainError names what is wrong.
template <Real Scalar = double>
Inertia<Scalar> body(const Array& inertia, const char* name = "inertia") {
  require_finite(name, inertia);
  Mat3<Scalar> J = Mat3<Scalar>::Zero();
  if (inertia.ndim() == 2) {
    require_shape(name, inertia, {3, 3});
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) J(i, j) = Scalar(inertia.data()[3 * i + j]);
  } else {
    require_shape(name, inertia, {3});
    for (int i = 0; i < 3; ++i) J(i, i) = Scalar(inertia.data()[i]);
  }
  const auto made = Inertia<Scalar>::from_tensor(J);
  if (!made) raise("DomainError", name + (" = " + text(inertia)) + ": " + message(made.error()));
  return *made;
}

/// An attitude [x, y, z, w] from numpy, of unit norm within 1e-6.
inline Quat<double> quaternion(const char* name, const Array& values) {
  require_shape(name, values, {4});
  require_finite(name, values);
  const double* q = values.data();
  const Quat<double> made{q[3], q[0], q[1], q[2]};
  if (std::abs(norm(made) - 1) > 1e-6) raise("DomainError", name + (" = " + text(values)) + ": not a unit quaternion");
  return as_unit(made);
}

inline double relative_tolerance(double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    raise("DomainError", "tolerance = " + text(tolerance) + ": give a number in (0, 1)");
  return tolerance;
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
