// SPDX-License-Identifier: BSD-3-Clause
// Rows of spinning, thrusting bodies from Python arguments.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "gyrostat/models/spinning/problem.hpp"
#include "scene_arguments.hpp"

namespace gyrostat::python {

/// Checked problems, one a row; DomainError names the argument and, of several, the row.
class SpinningProblems {
 public:
  using Problem = spinning::Problem<double>;

  /// mass, rotor_momentum, charge_momentum: (n,), the others (n, 3); angles: psi, phi, theta.
  SpinningProblems(const Array& inertia, const Array& mass, const Array& rotor_momentum, const Array& charge_momentum,
                   const Array& torque, const Array& force, const Array& angular_velocity, const Array& angles,
                   const Array& velocity, const Array& position) {
    const py::ssize_t n = mass.size();
    const auto numbers = [n](const char* name, const Array& values) {
      require_shape(name, values, {n});
      finite(name, values, 1);
    };
    const auto vectors = [n](const char* name, const Array& values) {
      require_shape(name, values, {n, 3});
      finite(name, values, 3);
    };
    vectors("inertia", inertia);
    numbers("mass", mass);
    numbers("rotor_momentum", rotor_momentum);
    numbers("charge_momentum", charge_momentum);
    vectors("torque", torque);
    vectors("force", force);
    vectors("angular_velocity", angular_velocity);
    vectors("euler_312", angles);
    vectors("velocity", velocity);
    vectors("position", position);
    rows_.reserve(std::size_t(n));
    for (py::ssize_t row = 0; row < n; ++row) {
      const auto vector = [row](const Array& values) {
        const double* v = values.data() + 3 * row;
        return Vec3<double>(v[0], v[1], v[2]);
      };
      Problem problem;
      problem.inertia = vector(inertia);
      problem.mass = mass.data()[row];
      problem.rotor_momentum = rotor_momentum.data()[row];
      problem.charge_momentum = charge_momentum.data()[row];
      problem.torque = vector(torque);
      problem.force = vector(force);
      problem.angular_velocity = vector(angular_velocity);
      const double* a = angles.data() + 3 * row;
      problem.angles = {a[0], a[1], a[2]};
      problem.velocity = vector(velocity);
      problem.position = vector(position);
      if (const std::string wrong = unphysical(problem); !wrong.empty())
        raise("DomainError", (n > 1 ? "row " + std::to_string(row) + ": " : std::string()) + wrong);
      rows_.push_back(problem);
    }
  }

  const std::vector<Problem>& rows() const noexcept { return rows_; }

  /// The only one.
  const Problem& single() const {
    if (rows_.size() != 1)
      raise("DomainError", "one body is wanted here, not " + std::to_string(rows_.size()) + " rows of them");
    return rows_.front();
  }

  /// DomainError where a torque acts about the spin axis, which the closed form does not know.
  void require_constant_spin() const {
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (rows_[row].torque[2] != 0)
        raise("DomainError",
              (rows_.size() > 1 ? "row " + std::to_string(row) + ": " : std::string()) +
                  "torque[2] = " + text(rows_[row].torque[2]) +
                  ": the closed form has no torque about the spin axis; solve with model = 'linear' does");
  }

 private:
  static void finite(const char* name, const Array& values, py::ssize_t width) {
    for (py::ssize_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values.data()[i]))
        raise("DomainError", (values.size() > width ? "row " + std::to_string(i / width) + ": " : std::string()) +
                                 name + " = " + text(Array({width}, values.data() + i / width * width)) +
                                 ": not finite");
  }

  static std::string unphysical(const Problem& problem) {
    const Vec3<double>& D = problem.inertia;
    const std::string inertia = "inertia = [" + text(D[0]) + ", " + text(D[1]) + ", " + text(D[2]) + "]: ";
    if (!(D.minCoeff() > 0)) return inertia + message(Errc::not_positive);
    const double most = D.maxCoeff();
    if (most > D.sum() - most + 8 * epsilon<double> * most) return inertia + message(Errc::triangle_inequality);
    if (!(problem.mass > 0)) return "mass = " + text(problem.mass) + ": give a finite number > 0";
    return {};
  }

  std::vector<Problem> rows_;
};

}  // namespace gyrostat::python
