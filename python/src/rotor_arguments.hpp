// SPDX-License-Identifier: BSD-3-Clause
// Body, rotor and motor from Python arguments, and a start of the motion.
#pragma once

#include <cmath>
#include <string>

#include "gyrostat/models/rotor/gyrostat.hpp"
#include "scene_arguments.hpp"

namespace gyrostat::python {

inline double finite(const char* name, double value) {
  if (!std::isfinite(value)) raise("DomainError", std::string(name) + " = " + text(value) + ": not finite");
  return value;
}

/// The number, which is > 0 and finite.
inline double positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    raise("DomainError", std::string(name) + " = " + text(value) + ": give a finite number > 0");
  return value;
}

/// A direction from numpy, of unit length within 1e-8.
inline Vec3<double> unit_vector(const char* name, const Array& values) {
  const Vec3<double> v = vector(name, values);
  const double length = magnitude(v);
  if (!(std::abs(length - 1) <= 1e-8))
    raise("DomainError", name + (" = " + text(values)) + ": the length is " + text(length) + ", not 1");
  return std::abs(length - 1) <= 4 * epsilon<double> ? v : Vec3<double>(v / length);  // as in a row of a sweep
}

/// The physics of a gyrostat with a driven rotor.
template <Real Scalar = double>
rotor::Gyrostat<Scalar> gyrostat_of(const Array& inertia, const Array& axis, double axial_inertia, double slope,
                                    double no_load_rate) {
  const Mat3<double> theta = body(inertia).tensor();
  const Vec3<double> e = unit_vector("axis", axis);
  positive("axial_inertia", axial_inertia);
  if (!(slope >= 0) || !std::isfinite(slope))
    raise("DomainError", "slope = " + text(slope) + ": give a finite number >= 0");
  finite("no_load_rate", no_load_rate);
  const auto made = rotor::Gyrostat<Scalar>::make(theta.cast<Scalar>(), e.cast<Scalar>(), Scalar(axial_inertia),
                                                  Scalar(slope), Scalar(no_load_rate));
  if (made) return *made;
  if (made.error() == Errc::triangle_inequality)
    raise("DomainError", "axial_inertia = " + text(axial_inertia) + ": the whole gyrostat holds less than " +
                             text(1 / e.dot(theta.inverse() * e)) + " about this axis");
  raise("DomainError", "inertia = " + text(inertia) + ": " + message(made.error()));
}

}  // namespace gyrostat::python
