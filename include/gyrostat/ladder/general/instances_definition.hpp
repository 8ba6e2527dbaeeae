// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include "gyrostat/ladder/general/instances.hpp"

namespace gyrostat::general {

namespace detail {

GYROSTAT_COMPILED_ONCE bool symmetric_about(const Mat3<double>& J, const Vec3<double>& e, double* dropped) noexcept {
  const double size = J.cwiseAbs().maxCoeff(), C = e.dot(J * e);
  const Vec3<double> across = symmetric_eigen<double>(J - C * e * e.transpose()).values;  // 0 and the two others
  Vec3<double> sizes = across.cwiseAbs();
  std::sort(sizes.data(), sizes.data() + 3);
  return drops((J * e - C * e).cwiseAbs().maxCoeff(), size, dropped) && drops(sizes[2] - sizes[1], size, dropped);
}

/// Of torques that are linear in the inertial axes, sum A_j e_j: the moment m and direction d with A_j = d_j [m]x. False: there are none.
inline bool one_direction(const Terms<double>& sum, const Terms<double>& size, Loads& loads) noexcept {
  Mat3<double> outer, most = Mat3<double>::Zero();  // m d^T
  for (int j = 0; j < 3; ++j) {
    const Mat3<double>& A = sum.inertial[std::size_t(j)];
    most = most.cwiseMax(size.inertial[std::size_t(j)]);
    if (!loads.drop((A + A.transpose()) / 2, size.inertial[std::size_t(j)])) return false;
    outer.col(j) = Vec3<double>(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)) / 2;
  }
  if (loads.drop(outer, most)) return true;
  int longest = 0;
  outer.colwise().norm().maxCoeff(&longest);
  const Vec3<double> along = outer.col(longest).normalized();
  const Vec3<double> direction = outer.transpose() * along;
  if (!loads.drop(outer - along * direction.transpose(), most)) return false;
  const double length = direction.norm();
  loads.direction = direction / length;
  loads.moment = length * along;
  loads.weighs = true;
  return true;
}

/// The torque of a sum in a motion of this extent, its parts taken by their sizes, N m.
inline double torque_of(const Terms<double>& sum, const Problem<double>& problem, const Extent& extent) noexcept {
  double torque = sum.body.norm() + sum.by_rate.norm() * extent.rate + sum.by_momentum.norm() * extent.momentum +
                  sum.brake_total.norm() + sum.brake_carrier.norm() + std::abs(sum.gradient) * problem.inertia.norm();
  for (const auto& A : sum.inertial) torque += A.norm();
  return torque;
}

GYROSTAT_COMPILED_ONCE Loads Loads::of(const Problem<double>& problem, const Collected<double>& torques,
                                       const Extent& extent) noexcept {
  Loads made;
  const Terms<double>&sum = torques.steady().sum, &size = torques.steady().size;
  double* const dropped = &made.dropped;
  made.extent = extent;
  made.extent.torque = std::max(extent.torque, slack * torque_of(sum, problem, extent));
  const double force = sum.force_body.norm() + sum.force_inertial.norm();
  made.extent.force = std::max(extent.force, slack * force);
  const auto outside = [&](const char* what) noexcept {
    if (!made.other) made.other = what;
  };
  if (!torques.is_steady()) outside("a torque changes with time");
  for (std::size_t j = 0; j < 3; ++j)
    if (!made.drop(sum.orbital[j], size.orbital[j])) outside("a torque is given in the axes of an orbit");
  if (sum.orbit_gradient != 0) outside("the gravity gradient turns with an orbit");
  if (!sum.dipole.isZero(0)) outside("the magnetic field moves");
  if (!sum.eddy.isZero(0)) outside("no family has eddy currents");
  if (!made.drop(sum.body, size.body)) made.body = sum.body;
  const Mat3<double> skew = (sum.by_rate - sum.by_rate.transpose()) / 2;
  if (!made.drop(skew, size.by_rate, extent.rate)) made.charge = {skew(2, 1), skew(0, 2), skew(1, 0)};
  const Mat3<double> damping = (sum.by_rate + sum.by_rate.transpose()) / 2;
  if (!made.drop(damping, size.by_rate, extent.rate)) made.damping = damping, made.damping_size = size.by_rate;
  if (!made.drop(sum.by_momentum, size.by_momentum, extent.momentum))
    made.by_momentum = sum.by_momentum, made.by_momentum_size = size.by_momentum;
  made.brake_total = sum.brake_total;
  made.brake_carrier = sum.brake_carrier;
  if (!one_direction(sum, size, made)) outside("torques are constant along more than one direction of space");
  const Vec3<double>& down = problem.field.down;
  if (made.direction.dot(down) < 0) made.direction *= -1, made.moment *= -1;
  // that of weight alone is known without rounding
  if ((made.direction - down).cwiseAbs().maxCoeff() <= slack) made.direction = down;
  if (sum.gradient != 0) {
    if (made.weighs && !parallel(made.direction, down, dropped))
      outside("weight and gravity gradient have different directions");
    made.gradient = sum.gradient;
    if (!made.weighs) made.direction = down;
    made.weighs = true;
  }
  const auto drops_force = [&](const Vec3<double>& residue, const Vec3<double>& of) noexcept {
    return residue.cwiseAbs().maxCoeff() <= made.extent.force && vanishes(residue, of, dropped);
  };
  if (!drops_force(sum.force_body, size.force_body)) made.force = sum.force_body;
  if (!drops_force(sum.force_inertial, size.force_inertial)) made.force_I = sum.force_inertial;
  return made;
}

GYROSTAT_COMPILED_ONCE bool wants_attitude(const Question& question, std::size_t but) noexcept {
  for (std::size_t c = 0; c < std::size(column_kinds); ++c)
    if (c != but && has(made_of[c], primitive::attitude) && aim_of(question, tables, false, c)) return true;
  return false;
}

GYROSTAT_COMPILED_ONCE Question plain(const Question& question) {
  Question made;
  made.times = question.times;
  made.tolerance = question.tolerance;
  made.wants_attitude = wants_attitude(question);
  return made;
}

}  // namespace detail

}  // namespace gyrostat::general
