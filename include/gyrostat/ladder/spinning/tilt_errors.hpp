// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/problem.hpp"

/// The stated errors of a motion for small tilt, column by column.
namespace gyrostat::spinning {

/// Whether a motion for small tilt means something: so far the error of the spin angle counts as the tilt does.
inline bool holds(const LinearErrors<double>& error) noexcept {
  return error.size.tilt + error.tilt <= small_tilt && error.theta <= small_tilt;
}

/// What rounding makes of a few operations and of the phases of spin and nutation over [0, span], relative.
inline double rounding_of_phases(const Problem<double>& problem, double span) noexcept {
  const double r0 = std::abs(problem.spin()),
               r1 = std::abs(problem.spin() + problem.torque[2] / problem.inertia[2] * span);
  const double stiffest = std::max({std::abs(problem.kappa1(r0)), std::abs(problem.kappa1(-r0)),
                                    std::abs(problem.kappa2(r0)), std::abs(problem.kappa2(-r0))});
  return epsilon<double> * (16 + 2 * (std::max(r0, r1) + stiffest) * span);
}

/// `left_out` (in units of the quantities), `of_data` (in units of the columns) and rounding over [0, span], relative to the least greatest
/// norms that the right columns can have, or to their scales where those are greater. Infinite where a column without a scale may be all error.
inline ColumnErrors<double> tilt_errors(const Problem<double>& problem, const LinearErrors<double>& left_out,
                                        std::span<const State<double>> states, double span,
                                        const ColumnErrors<double>& of_data = {}) noexcept {
  const Row<double> row{scales(problem, span)};
  Comparison sizes(row);
  for (const auto& state : states) sizes.add(state);
  const auto& size = sizes.size();

  const auto& D = problem.inertia;
  const double r0 = std::abs(problem.spin()), r1 = std::abs(problem.spin() + problem.torque[2] / D[2] * span);
  const double fastest = std::max(r0, r1);
  const double g = left_out.size.tilt, P = left_out.size.rate;
  const double once = problem.torque[2] == 0 ? std::min(span, 2 / r0) : span;  // greatest int e^(i theta)
  const double push = std::hypot(problem.force[0], problem.force[1]) / problem.mass;
  const double thrust = std::abs(problem.force[2]) / problem.mass;
  const double rounding = rounding_of_phases(problem, span);

  ColumnErrors<double> error;
  error[column::angular_velocity] =
      std::hypot(left_out.rates, left_out.spin) + rounding * P + 4 * epsilon<double> * fastest;
  error[column::attitude] =
      left_out.attitude + rounding * g + 4 * epsilon<double> * (1 + std::abs(problem.angles.theta) + fastest * span);
  const double torque = std::hypot(problem.torque[0], problem.torque[1]);
  const double axial_parts = D[2] * fastest + std::abs(problem.rotor_momentum);
  error[column::angular_momentum_inertial] = std::hypot(left_out.momentum, left_out.axial_momentum) +
                                             8 * epsilon<double> * size[column::angular_momentum_inertial] +
                                             rounding * (torque * once + D.maxCoeff() * P + axial_parts * g);
  // the body's share and the rotor's may cancel; where the spin is constant their sum is known to more digits
  if (problem.torque[2] != 0) error[column::angular_momentum_inertial] += 2 * epsilon<double> * axial_parts;
  const double v = push * once + thrust * span;
  error[column::velocity] = std::hypot(left_out.velocity, left_out.axial_velocity) +
                            4 * epsilon<double> * size[column::velocity] +
                            rounding * (push * once + thrust * span * g) + 8 * epsilon<double> * v;
  error[column::position] =
      std::hypot(left_out.position, left_out.axial_position) +
      4 * epsilon<double> * (size[column::position] + problem.position.norm() + (problem.velocity.norm() + v) * span) +
      rounding * (push * once + thrust * span * g) * span;

  for (std::size_t i = 0; i < std::size(column_kinds); ++i) {
    // below a part of the rounding of the column's scale nothing is claimed: what cancels so far hangs on the order of operations
    error[i] += of_data[i] + epsilon<double> / 4 * (row.scale[i] < infinity<double> ? row.scale[i] : 0);
    if (column_kinds[i].measure != Measure::relative || error[i] == 0) continue;
    const double least = std::max(size[i] - error[i], row.scale[i]);
    error[i] = least > 0 ? error[i] / least : infinity<double>;
  }
  error[column::attitude] = std::min(error[column::attitude], pi<double>);
  error[column::euler_312] = angles_error(error[column::attitude], states);
  return error;
}

}  // namespace gyrostat::spinning
