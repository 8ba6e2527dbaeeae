// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Steady rotations about the vertical, and rests: whether a motion is one, and whether it stays.
namespace gyrostat::heavy {

namespace detail {

/// How fast the weight swings the body, to its order, rad/s.
template <Real Scalar>
Scalar swing_rate(const Problem<Scalar>& problem) noexcept {
  return std::sqrt(magnitude(problem.moment()) / problem.inertia().maxCoeff() + problem.gradient());
}

}  // namespace detail

/// Whether a body turns steadily about the vertical, or rests: the torque and the change of down vanish to within a `share` of their terms.
template <Real Scalar>
bool is_steady(const Problem<Scalar>& problem, const Vec3<Scalar>& angular_velocity, const Vec3<Scalar>& down,
               Scalar share) noexcept {
  const Vec3<Scalar>&I = problem.inertia(), &w = angular_velocity;
  const Scalar off = problem.torque(w, down).norm();
  const Scalar whole = I.cwiseProduct(w).norm() * w.norm() + magnitude(problem.moment()) +
                       std::abs(problem.gradient()) * I.cwiseProduct(down).norm();
  return whole > 0 && off <= share * whole &&
         cross<Scalar>(w, down).norm() <= share * (w.norm() + detail::swing_rate(problem)) * down.norm();
}

/// Greatest growth rate, 1/s, of small departures from a steady rotation about the vertical, or a rest; 0 where none grows, but for rounding.
/// Beside two zeros the linear equations of the departures have eigenvalues +-a, +-b; their matrix J has tr J^2 = 2 (a^2 + b^2) and
/// tr J^4 = 2 (a^4 + b^4).
template <Real Scalar>
Scalar growth_rate(const Problem<Scalar>& problem, const Vec3<Scalar>& angular_velocity,
                   const Vec3<Scalar>& down) noexcept {
  using Matrix = Eigen::Matrix<Scalar, 6, 6>;
  const Vec3<Scalar>& w = angular_velocity;
  const Scalar unit = w.norm() + detail::swing_rate(problem);  // in which changes of down are rates, too
  if (!(unit > 0)) return 0;
  Matrix J;
  const Vec3<Scalar> per_moment = problem.inertia().cwiseInverse();
  for (int k = 0; k < 3; ++k) {
    // differences of the torque are exact: it is quadratic
    const Vec3<Scalar> one = Vec3<Scalar>::Unit(k), turn = unit * one;
    const Vec3<Scalar> by_rate = problem.torque(w + turn, down) - problem.torque(w - turn, down);
    const Vec3<Scalar> by_down = problem.torque(w, down + one) - problem.torque(w, down - one);
    J.template block<3, 1>(0, k) = per_moment.cwiseProduct(by_rate) / (2 * unit);
    J.template block<3, 1>(0, 3 + k) = per_moment.cwiseProduct(by_down) / (2 * unit);
    J.template block<3, 1>(3, k) = unit * cross<Scalar>(down, one);
    J.template block<3, 1>(3, 3 + k) = cross<Scalar>(one, w);
  }
  const Matrix square = J * J;
  const Scalar sum = square.trace() / 2, squares = square.cwiseProduct(square.transpose()).sum() / 2;
  const Scalar apart = 2 * squares - sum * sum;  // (a^2 - b^2)^2
  const Scalar size = J.squaredNorm(), rounding = 64 * epsilon<Scalar>;
  if (apart < -rounding * size * size) {
    const Scalar product = std::sqrt(std::max((sum * sum - squares) / 2, Scalar(0)));
    return std::sqrt(std::max((product + sum / 2) / 2, Scalar(0)));
  }
  const Scalar greatest = (sum + std::sqrt(std::max(apart, Scalar(0)))) / 2;
  return greatest > rounding * size ? std::sqrt(greatest) : Scalar(0);
}

}  // namespace gyrostat::heavy
