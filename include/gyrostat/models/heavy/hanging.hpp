// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/math/root.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::heavy {

/// The hanging body: rest where the potential energy -M g r_cm . d + (N/2) d . I d is least, and its two small swings without turn about
/// the vertical (docs/heavy.md, section 6).
template <Real Scalar>
struct Hanging {
  Vec3<Scalar> down{0, 0, -1};  ///< body axes, unit; not along the mass centre where N != 0
  std::array<Scalar, 2> frequency{0,
                                  0};  ///< rad/s, ascending; 0 where the potential energy does not grow to second order
  std::array<Vec3<Scalar>, 2>
      swing;  ///< of down, unit, across it: at rest at down + a swing, a small, the body swings so
};

/// Errors: not_applicable where all orientations are alike: neither weight nor gradient, or no weight and three equal moments; not_finite where
/// products overflow or vanish.
template <Real Scalar>
Result<Hanging<Scalar>> hanging(const Problem<Scalar>& problem) noexcept {
  const Vec3<Scalar>& I = problem.inertia();
  const Vec3<Scalar> m = problem.moment();
  // grad V = N I d - m = -mu d: (N (I_i - I_min) + shift) d_i = m_i, and the least energy has shift >= 0
  const Scalar least = I.minCoeff();
  const Vec3<Scalar> stiffness = problem.gradient() * (I - Vec3<Scalar>::Constant(least));
  const Scalar weight = std::hypot(m[0], m[1], m[2]);
  if (weight == 0 && stiffness.maxCoeff() == 0) return Errc::not_applicable;

  Scalar soft = 0;  // of m, on the axes of least inertia
  int softest = 0;
  for (int i = 0; i < 3; ++i) {
    if (stiffness[i] == 0) soft = std::hypot(soft, m[i]);
    if (stiffness[i] < stiffness[softest]) softest = i;
  }
  const auto down_of = [&](Scalar shift) noexcept {
    Vec3<Scalar> d;
    for (int i = 0; i < 3; ++i) d[i] = m[i] == 0 ? Scalar(0) : m[i] / (stiffness[i] + shift);
    return d;
  };
  Scalar shift = 0;
  Vec3<Scalar> down = soft == 0 ? down_of(0) : Vec3<Scalar>(Vec3<Scalar>::Constant(2));
  if (down.squaredNorm() <= 1) {
    down[softest] = std::sqrt(std::max(1 - down.squaredNorm(), Scalar(0)));  // two rests, mirrored: the one with +
  } else {
    // 1/|d| grows with the shift, nearly linearly
    const auto root = math::newton_root<Scalar>(
        [&](Scalar x) noexcept {
          const Vec3<Scalar> d = down_of(x);
          const Scalar square = d.squaredNorm();
          Scalar bend = 0;
          for (int i = 0; i < 3; ++i) bend += d[i] == 0 ? Scalar(0) : d[i] * d[i] / (stiffness[i] + x);
          return math::Slope<Scalar>{1 / std::sqrt(square) - 1, bend / (square * std::sqrt(square))};
        },
        soft, std::max(weight, soft), true, weight);
    if (!root) return Errc::not_finite;
    shift = *root;
    down = down_of(shift);
  }
  Hanging<Scalar> made;
  made.down = down / down.norm();

  // second derivative of the energy by a turn, and I^-1/2 around it; its vanishing eigenvalue is the turn about the vertical
  const Mat3<Scalar> across = cross_matrix<Scalar>(made.down);
  const Vec3<Scalar> bend = stiffness + Vec3<Scalar>::Constant(shift);
  const Vec3<Scalar> root = I.cwiseSqrt().cwiseInverse();
  const Mat3<Scalar> turned = across * root.asDiagonal();
  const auto eigen = symmetric_eigen<Scalar>(turned.transpose() * bend.asDiagonal() * turned);
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    Vec3<Scalar> change = turned * eigen.axes.col(i + 1);
    // where nothing resists a swing either, it shares its eigenvalue with the turn about the vertical
    const Vec3<Scalar> other = turned * eigen.axes.col(0);
    if (i == 0 && change.squaredNorm() < other.squaredNorm()) change = other;
    made.frequency[k] = std::sqrt(std::max(eigen.values[i + 1], Scalar(0)));
    made.swing[k] = change / change.norm();
    if (!std::isfinite(made.frequency[k]) || !made.swing[k].allFinite()) return Errc::not_finite;
  }
  return made;
}

}  // namespace gyrostat::heavy
