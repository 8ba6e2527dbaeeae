// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/models/rotor/steady_stability.hpp"

/// The gyrostats whose momentum direction need not settle exponentially, or at all (docs/rotor.md, section 3).
namespace gyrostat::rotor {

/// By precedence: a body axisymmetric about the rotor's axis has that axis principal, too.
enum class Exceptional : std::uint8_t {
  none,
  at_rest,           ///< L = 0: the direction m does not exist
  axisymmetric,      ///< theta symmetric about e, the sphere included: m precesses about e for ever
  circular_section,  ///< triaxial, n = J e normal to a circular section of x.J x = 1: the great circle n.m = 0 is invariant with
                     ///< omega = omega*
  principal_axis,    ///< e is a principal axis: m tends to +-e algebraically
};

/// How far the body is from each family: 0 on it, of order 1 far from it, linear in between. Below exceptional_rounding it is
/// on it as far as the numbers tell.
template <Real Scalar>
struct ExceptionalDistance {
  Scalar at_rest = 1;           ///< l/(l + |h|)
  Scalar axisymmetric = 1;      ///< |theta - its mean over turns about e|/|theta|
  Scalar circular_section = 1;  ///< half the difference of the eigenvalues of J on the plane normal to n, over the largest of J
  Scalar principal_axis = 1;    ///< |e x theta e|/|theta|
  Exceptional family = Exceptional::none;  ///< the first of them that holds to rounding
};

template <Real Scalar>
inline constexpr Scalar exceptional_rounding = 64 * epsilon<Scalar>;

/// momentum_norm: l, N m s.
template <Real Scalar>
ExceptionalDistance<Scalar> exceptional_distance(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept;

/// The great circle n.m = 0 of the family circular_section: it is invariant, at one level of F.
template <Real Scalar>
struct CircularSection {
  Scalar level = 0;     ///< F on it, J
  Scalar drive = 0;     ///< h |n|, rad/s
  Scalar hold = 0;      ///< l |b|, rad/s: phi' = drive - hold sin(phi)
  bool tumbles = true;  ///< |drive| > hold: m runs round the circle for ever; else it has two steady rotations on it
};

template <Real Scalar>
CircularSection<Scalar> circular_section(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept;

/// The constant c of the algebraic law 1/W = 1/W0 + c t, W = |V - F(m)|, close to a steady rotation m = +-e of a rotor on a
/// principal axis, 1/(J s). It decays from a minimum and grows from a maximum (1/W = 1/W0 - c t). NaN for a saddle, or
/// where e is not principal; 0 for a body symmetric about e.
template <Real Scalar>
Scalar algebraic_rate(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm, const SteadyRotation<Scalar>& rotation) noexcept;

}  // namespace gyrostat::rotor
