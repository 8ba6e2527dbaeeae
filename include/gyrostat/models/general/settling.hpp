// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/vector.hpp"

/// How wheels with friction settle (docs/general.md, section 3).
namespace gyrostat::general {

namespace detail {

template <Real Scalar>
using WheelMatrix = std::array<std::array<Scalar, most_wheels>, most_wheels>;

/// Makes a symmetric positive matrix of n rows diagonal by Jacobi's rotations, A -> V^T A V, and V, which begins as the unit matrix. Rows may
/// differ by many powers of ten: entries are held against their own diagonal, so that small eigenvalues are as good as great ones.
template <Real Scalar>
void make_diagonal(WheelMatrix<Scalar>& A, WheelMatrix<Scalar>& V, std::size_t n) noexcept {
  using std::abs, std::sqrt;
  V = {};
  for (std::size_t i = 0; i < n; ++i) V[i][i] = 1;
  bool turned = true;
  for (int sweep = 0; turned && sweep < 60; ++sweep) {
    turned = false;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        if (!(abs(A[i][j]) > epsilon<Scalar> * sqrt(A[i][i]) * sqrt(A[j][j]))) continue;
        turned = true;
        const Scalar slope = (A[j][j] - A[i][i]) / (2 * A[i][j]);
        const Scalar t = (slope < 0 ? -1 : 1) / (abs(slope) + std::hypot(slope, Scalar(1)));
        const Scalar c = 1 / std::hypot(t, Scalar(1)), s = t * c, moved = t * A[i][j];
        A[i][i] -= moved, A[j][j] += moved;
        A[i][j] = A[j][i] = 0;
        const auto turn = [&](Scalar& a, Scalar& b) noexcept {
          const Scalar first = a;
          a = c * first - s * b;
          b = s * first + c * b;
        };
        for (std::size_t k = 0; k < n; ++k) {
          turn(V[k][i], V[k][j]);
          if (k == i || k == j) continue;
          turn(A[k][i], A[k][j]);
          A[i][k] = A[k][i], A[j][k] = A[k][j];
        }
      }
  }
}

}  // namespace detail

/// The momenta p of wheels with friction settle as p' = -diag(c) (diag(1/I) + U^T J*^-1 U) p + (what depends on M and t). The matrix is
/// constant, and similar to a symmetric one: in its axes each unknown z_i relaxes by itself, z_i' = -rate_i z_i + ...
template <Real Scalar>
struct Settling {
  std::size_t count = 0;
  std::array<std::size_t, most_wheels> wheel{};  ///< the wheels with friction, places among all
  std::array<Scalar, most_wheels> rate{};        ///< of z_i, 1/s
  detail::WheelMatrix<Scalar> to_wheel{};        ///< [k][i]: p of wheel[k] is the sum of these times z_i
  detail::WheelMatrix<Scalar> to_mode{};         ///< [i][k]: its inverse
  std::array<Vec3<Scalar>, most_wheels> axis{};  ///< the momentum of these wheels is the sum of axis[i] z_i

  explicit Settling(const Wheels<Scalar>& wheels) noexcept {
    using std::sqrt;
    for (std::size_t i = 0; i < wheels.count; ++i)
      if (wheels.laws[i].follows == Follows::state) wheel[count++] = i;
    std::array<Scalar, most_wheels> root;
    for (std::size_t k = 0; k < count; ++k) root[k] = sqrt(wheels.laws[wheel[k]].friction);
    detail::WheelMatrix<Scalar> A{}, V{};
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t m = 0; m < count; ++m) {
        const auto &one = wheels.laws[wheel[k]], &two = wheels.laws[wheel[m]];
        const Scalar own = k == m ? 1 / one.axial_inertia : Scalar(0);
        A[k][m] = root[k] * root[m] * (one.axis.dot(wheels.inverse * two.axis) + own);
      }
    detail::make_diagonal(A, V, count);
    for (std::size_t i = 0; i < count; ++i) {
      rate[i] = A[i][i];
      axis[i].setZero();
      for (std::size_t k = 0; k < count; ++k) {
        to_wheel[k][i] = root[k] * V[k][i];
        to_mode[i][k] = V[k][i] / root[k];
        axis[i] += to_wheel[k][i] * wheels.laws[wheel[k]].axis;
      }
    }
  }

  /// The greatest of the rates; 0 without such wheels.
  Scalar fastest() const noexcept { return *std::max_element(rate.begin(), rate.end()); }
};

}  // namespace gyrostat::general
