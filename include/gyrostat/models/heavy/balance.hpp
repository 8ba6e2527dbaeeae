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

/// Whether a body swings in a plane about a principal axis, to within a `share`, and its energy is within that share of the range of its potential from
/// that of a rest where it turns back or goes over.
template <Real Scalar>
bool is_beside_separatrix(const Problem<Scalar>& problem, const Vec3<Scalar>& angular_velocity,
                          const Vec3<Scalar>& down, Scalar share) noexcept {
  const Vec3<Scalar>&I = problem.inertia(), &w = angular_velocity;
  const Vec3<Scalar> m = problem.moment(), d = down / down.norm();
  const auto across = [share](const Vec3<Scalar>& v, int k) noexcept { return std::abs(v[k]) <= share * v.norm(); };
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (!across(m, k) || !across(d, k) || !(std::hypot(w[i], w[j]) <= share * std::abs(w[k]))) continue;
    const auto potential = [&](Scalar x, Scalar y) noexcept {
      return problem.gradient() * (I[i] * x * x + I[j] * y * y) / 2 - m[i] * x - m[j] * y;
    };
    const Scalar energy = I[k] * w[k] * w[k] / 2 + potential(d[i], d[j]);
    // its maxima from values all round, by a parabola each
    constexpr int count = 64;
    Scalar V[count];
    for (int n = 0; n < count; ++n) {
      const Scalar angle = 2 * pi<Scalar> * Scalar(n) / count;
      V[n] = potential(std::cos(angle), std::sin(angle));
    }
    const Scalar range = *std::max_element(V, V + count) - *std::min_element(V, V + count);
    for (int n = 0; n < count; ++n) {
      const Scalar before = V[(n + count - 1) % count], behind = V[(n + 1) % count], slope = (behind - before) / 2;
      if (!(V[n] >= before && V[n] > behind)) continue;
      const Scalar top = V[n] + slope * slope / (2 * (2 * V[n] - before - behind));
      if (std::abs(energy - top) <= share * range) return true;
    }
  }
  return false;
}

/// Small departures from a steady rotation about the vertical, or a rest.
template <Real Scalar>
struct Departures {
  Scalar growth = 0;  ///< greatest rate at which one grows, 1/s; 0 where none does, but for rounding
  /// What decides when a motion leaves: departures of the rate, over `unit`, and of down along these two together. Zero where none grows.
  Vec3<Scalar> of_rate{0, 0, 0}, of_down{0, 0, 0};
  Scalar unit = 0;  ///< rad/s
};

/// Those from the rotation, or rest, with this rate and down, which has to be one (is_steady). Beside two zeros their linear equations have eigenvalues +-a, +-b; their matrix J has tr J^2 = 2 (a^2 + b^2) and
/// tr J^4 = 2 (a^4 + b^4).
template <Real Scalar>
Departures<Scalar> departures(const Problem<Scalar>& problem, const Vec3<Scalar>& angular_velocity,
                              const Vec3<Scalar>& down) noexcept {
  using Matrix = Eigen::Matrix<Scalar, 6, 6>;
  const Vec3<Scalar>& w = angular_velocity;
  Departures<Scalar> made;
  const Scalar unit = made.unit = w.norm() + detail::swing_rate(problem);  // in which changes of down are rates, too
  if (!(unit > 0)) return made;
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
  const Matrix square = J * J, identity = Matrix::Identity();
  const Scalar sum = square.trace() / 2, squares = square.cwiseProduct(square.transpose()).sum() / 2;
  const Scalar apart = 2 * squares - sum * sum;  // (a^2 - b^2)^2
  const Scalar size = J.squaredNorm(), rounding = 64 * epsilon<Scalar>;
  Matrix left;  // the other eigenvalues' factors: its rows are the left eigenvectors of those that grow fastest
  if (apart < -rounding * size * size) {
    const Scalar product = std::sqrt(std::max((sum * sum - squares) / 2, Scalar(0)));
    made.growth = std::sqrt(std::max((product + sum / 2) / 2, Scalar(0)));
    left = square * (square + 2 * made.growth * J + product * identity);
  } else {
    const Scalar greatest = (sum + std::sqrt(std::max(apart, Scalar(0)))) / 2;
    if (greatest > rounding * size) made.growth = std::sqrt(greatest);
    left = J * (J + made.growth * identity) * (square - (sum - greatest) * identity);
  }
  if (made.growth > 0) {
    int row = 0;
    left.rowwise().squaredNorm().maxCoeff(&row);
    made.of_rate = left.template block<1, 3>(row, 0).transpose();
    made.of_down = left.template block<1, 3>(row, 3).transpose();
  }
  return made;
}

/// Greatest growth rate of departures(), 1/s.
template <Real Scalar>
Scalar growth_rate(const Problem<Scalar>& problem, const Vec3<Scalar>& angular_velocity,
                   const Vec3<Scalar>& down) noexcept {
  return departures(problem, angular_velocity, down).growth;
}

}  // namespace gyrostat::heavy
