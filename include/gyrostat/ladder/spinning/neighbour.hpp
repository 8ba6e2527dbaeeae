// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/spinning/problem.hpp"

/// Problems that differ from a given one by what rounding makes of it.
namespace gyrostat::spinning {

/// Whether the body turns about one principal axis for ever, so that the rates across it stay zero.
template <Real Scalar>
bool keeps_axis(const Problem<Scalar>& problem) noexcept {
  const auto &w = problem.angular_velocity, &M = problem.torque;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (w[i] == 0 && w[j] == 0 && M[i] == 0 && M[j] == 0 && (k == 2 || problem.gyroscopic() == 0)) return true;
  }
  return false;
}

/// A problem that differs from the given one by about `amount`: by what rounding makes of data and arithmetic, which errs by what
/// the greatest rate, about `rate`, rounds to. What is equal or zero by a symmetry stays so.
template <Real Scalar>
Problem<Scalar> neighbour(const Problem<Scalar>& of, Scalar rate, Scalar amount, Aside aside) noexcept {
  const Vec3<Scalar> v = amount * neighbour_direction<Scalar>(aside);
  const bool symmetric = of.inertia[0] == of.inertia[1], kept = keeps_axis(of);
  Problem<Scalar> near = of;
  near.inertia[0] *= 1 + v[0];
  near.inertia[1] *= 1 + (symmetric ? v[0] : v[1]);
  near.inertia[2] *= 1 + v[2];
  // the stiffness is a difference of terms that may nearly cancel
  near.rotor_momentum *= 1 + v[0];
  near.charge_momentum *= 1 + v[1];
  const Scalar torque = of.converted ? of.torque.norm() : Scalar(0);
  for (int i = 0; i < 3; ++i) {
    const Scalar part = v[(i + 1) % 3];
    near.torque[i] += part * std::max(std::abs(of.torque[i]), torque);
    // to opposite sides in the two, so that truncation cannot cancel it in both; and against the kick of one that runs alone (Taylor::kick)
    Scalar& w = near.angular_velocity[i];
    if (w != 0 || !kept) w += std::copysign(rate * amount / 4, aside == Aside::first ? w : -w);
  }
  if (!kept) {
    Vec3<Scalar> own = of.inertia.cwiseProduct(of.angular_velocity), M = own;
    M[2] += of.gyroscopic();
    const Vec3<Scalar> inverse = of.inertia.cwiseInverse();
    const Vec3<Scalar> leaving = leaving_direction<Scalar>(M, of.angular_velocity, inverse.asDiagonal());
    const Scalar size = std::max(own.cwiseAbs().maxCoeff(), std::abs(of.gyroscopic()));
    near.angular_velocity += inverse.cwiseProduct(leaving_shift(leaving, size, amount, aside));
  }
  // the axes whose third is the force's are known to a rounding: what they leave along the spin axis pushes on
  const bool oblique = of.force[0] != 0 || of.force[1] != 0;
  if (oblique) near.force += of.force.norm() * Vec3<Scalar>(v[1], v[2], v[0]);
  return near;
}

}  // namespace gyrostat::spinning
