// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "gyrostat/models/rotor/gyrostat.hpp"

/// Every steady rotation of a gyrostat at the rotor's no-load rate (docs/rotor.md, section 4): the carrier turns about the
/// momentum H = l m with the rate psi_dot, the rotor with omega*,
///     psi_dot theta m = l m - h e,   |m| = 1,
/// which are the critical points of F(m) = (l m - h e).J (l m - h e)/2 on the sphere |m| = 1. In principal axes of theta, with
/// a_i = 1/theta_i and sigma = psi_dot/l,
///     m_i = (h/l) e_i a_i/(a_i - sigma),   phi(sigma) = m.m - 1 = 0.
/// 1/|m| is concave in sigma between two poles a_i and beyond the outer ones, and it is close to straight: all roots are found
/// by a method of third order from known brackets. The unknown is the distance from a pole, so that a pole with a tiny e_i costs
/// no digits.
namespace gyrostat::rotor {

/// What F has there. Two minima at most; one minimum and one maximum at least.
enum class SteadyType : std::uint8_t {
  minimum,
  saddle,
  maximum,
  degenerate,  ///< two or more steady rotations merge here to rounding (fold), or it is one of a continuum
};

template <Real Scalar>
struct SteadyRotation {
  Vec3<Scalar> direction{0, 0, 0};  ///< m = H/|H|, unit, body axes
  Scalar spin_rate = 0;             ///< psi_dot: Omega = psi_dot m, rad/s; may be negative or zero
  Scalar level = 0;                 ///< F(m), J
  SteadyType type = SteadyType::degenerate;
  bool isolated = true;  ///< false: a representative of a circle or of the whole sphere of steady rotations
};

/// By ascending level: 2, 4 or 6 isolated ones where none is degenerate.
template <Real Scalar>
struct SteadyRotations {
  std::array<SteadyRotation<Scalar>, 8> at{};
  int count = 0;
  bool circle = false;  ///< one entry stands for a circle: two equal moments, and no rotor momentum in their plane
  bool sphere = false;  ///< every m is steady: three equal moments and h = 0

  const SteadyRotation<Scalar>* begin() const noexcept { return at.data(); }
  const SteadyRotation<Scalar>* end() const noexcept { return at.data() + count; }
  const SteadyRotation<Scalar>& operator[](int i) const noexcept { return at[std::size_t(i)]; }

  /// Index of the lowest entry of a type; -1 where there is none.
  int lowest(SteadyType type) const noexcept {
    for (int i = 0; i < count; ++i)
      if (at[std::size_t(i)].type == type) return i;
    return -1;
  }
};

/// All steady rotations with |H| = momentum_norm, N m s. None where it is zero, negative or not finite, or so small that
/// h/|H| overflows. Direction to 1e-14 and spin rate to 1e-14 relative (double) away from folds; at a distance d from a fold, relative
/// in h, the loss is a factor 1/sqrt(d). A pair that is closer to its fold than rounding of theta and e moves it is one entry.
template <Real Scalar>
SteadyRotations<Scalar> steady_rotations(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept;

}  // namespace gyrostat::rotor
