// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/models/rotor/exceptional.hpp"

/// Which steady rotation a motion tends to, said before it gets there (docs/rotor.md, section 4). V falls, and F <= V: once V is below
/// the lowest saddle of F, H stays in its valley for ever.
namespace gyrostat::rotor {

/// Why the attractor is known, or why not.
enum class Certificate : std::uint8_t {
  undecided,  ///< two minima, and V is above the lowest saddle (or within rounding of it); or a start on an unstable steady rotation
  by_level,   ///< V is below the lowest barrier: proven
  by_uniqueness,  ///< only one minimum: proven but for starts of measure zero (the stable manifolds of saddles and maxima)
  none,           ///< there is no attractor: S = 0, L = 0, symmetry about e, or a continuum of minima
};

template <Real Scalar>
struct Attractor {
  int index = -1;                                      ///< into SteadyRotations; -1: not certified
  Certificate certificate = Certificate::undecided;
  Scalar level = 0;   ///< V, J
  Scalar margin = 0;  ///< V - F(lowest barrier), J: negative once captured; -infinity where there is no barrier
};

/// H, body axes, N m s; p, the axial momentum of the rotor, N m s; steady: steady_rotations(gyrostat, |H|).
template <Real Scalar>
Attractor<Scalar> certify(const Gyrostat<Scalar>& gyrostat, const SteadyRotations<Scalar>& steady, const Vec3<Scalar>& H,
                          Scalar p) noexcept;

}  // namespace gyrostat::rotor
