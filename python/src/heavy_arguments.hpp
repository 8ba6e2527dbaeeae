// SPDX-License-Identifier: BSD-3-Clause
// Heavy bodies about a fixed point from Python arguments.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "scene_arguments.hpp"

namespace gyrostat::python {

/// Checked bodies in principal axes, one a row; DomainError names the argument and, of several, the row.
class HeavyBodies {
 public:
  using Problem = heavy::Problem<double>;

  /// inertia (n, 3), mass (n,), centre_of_mass (n, 3), gravity and gravity_gradient (n,).
  HeavyBodies(const Array& inertia, const Array& mass, const Array& centre_of_mass, const Array& gravity,
              const Array& gradient) {
    const py::ssize_t n = mass.size();
    require_shape("inertia", inertia, {n, 3});
    require_shape("mass", mass, {n});
    require_shape("centre_of_mass", centre_of_mass, {n, 3});
    require_shape("gravity", gravity, {n});
    require_shape("gravity_gradient", gradient, {n});
    rows_.reserve(std::size_t(n));
    for (py::ssize_t row = 0; row < n; ++row) {
      const auto vector = [row](const Array& values) {
        const double* v = values.data() + 3 * row;
        return Vec3<double>(v[0], v[1], v[2]);
      };
      const auto made = Problem::make(vector(inertia), mass.data()[row], vector(centre_of_mass), gravity.data()[row],
                                      gradient.data()[row]);
      if (!made)
        raise("DomainError", label(row) + unphysical(made.error(), Array(3, inertia.data() + 3 * row), mass.data()[row],
                                                     Array(3, centre_of_mass.data() + 3 * row), gravity.data()[row],
                                                     gradient.data()[row]));
      rows_.push_back(*made);
    }
  }

  const std::vector<Problem>& rows() const noexcept { return rows_; }
  std::size_t size() const noexcept { return rows_.size(); }

  /// "row 3: " where there are several, for messages.
  std::string label(py::ssize_t row) const {
    return rows_.capacity() > 1 ? "row " + std::to_string(row) + ": " : std::string();
  }

  static std::string unphysical(Errc code, const Array& inertia, double mass, const Array& centre_of_mass,
                                double gravity, double gradient) {
    return "inertia = " + text(inertia) + ", mass = " + text(mass) + ", centre_of_mass = " + text(centre_of_mass) +
           ", gravity = " + text(gravity) + ", gravity_gradient = " + text(gradient) + ": " +
           (code == Errc::triangle_inequality
                ? "no body has this inertia about the fixed point and its mass centre there"
                : message(code));
  }

 private:
  std::vector<Problem> rows_;
};

/// (n,) numbers that belong to the rows.
inline void require_rows(const char* name, const Array& values, std::size_t rows) {
  require_shape(name, values, {py::ssize_t(rows)});
  require_finite(name, values);
}

/// A body from three moments or a tensor in body axes.
inline heavy::Body heavy_body(const Array& inertia, double mass, const Array& centre_of_mass, double gravity,
                              double gradient) {
  Mat3<double> I = Mat3<double>::Zero();
  if (inertia.ndim() == 2) {
    require_shape("inertia", inertia, {3, 3});
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) I(i, j) = inertia.data()[3 * i + j];
  } else {
    require_shape("inertia", inertia, {3});
    for (int i = 0; i < 3; ++i) I(i, i) = inertia.data()[i];
  }
  require_shape("centre_of_mass", centre_of_mass, {3});
  const double* c = centre_of_mass.data();
  const auto made = heavy::Body::make(I, mass, {c[0], c[1], c[2]}, gravity, gradient);
  if (!made)
    raise("DomainError", HeavyBodies::unphysical(made.error(), inertia, mass, centre_of_mass, gravity, gradient));
  return *made;
}

/// What a motion starts from: rates with down or attitude, in body axes, or a periodic motion (spin, cosine of the inclination).
/// Where the attitude is given the question wants it.
inline heavy::Start heavy_start(const std::optional<Array>& angular_velocity, const std::optional<Array>& down,
                                const std::optional<Array>& attitude,
                                const std::optional<std::pair<double, double>>& periodic, Question& question) {
  heavy::Start start;
  if (!periodic) {
    if (!angular_velocity || !down == !attitude)
      raise("DomainError", "give angular_velocity with either down or attitude, or periodic");
    start.state.angular_velocity = vector("angular_velocity", *angular_velocity);
  } else {
    if (angular_velocity || down || attitude)
      raise("DomainError", "periodic stands alone: its start is not given by angular_velocity, down or attitude");
    start.periodic = heavy::Periodic{periodic->first, periodic->second};
  }
  if (down) {
    start.state.down = vector("down", *down);
    if (!(std::abs(start.state.down.norm() - 1) <= 1e-8))
      raise("DomainError", "down = " + text(*down) + ": not a unit vector");
  }
  if (attitude) {
    start.state.attitude = quaternion("attitude", *attitude);
    start.oriented = true;
    question.wants_attitude = true;
  }
  return start;
}

}  // namespace gyrostat::python
