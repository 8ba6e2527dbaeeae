// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::rotor {

/// Carrier and rotor given apart. Body axes, SI units.
template <Real Scalar>
struct Assembly {
  Mat3<Scalar> carrier_inertia = Mat3<Scalar>::Identity();  ///< about the carrier's own centroid, kg m^2
  Scalar carrier_mass = 1;                                  ///< kg
  Scalar rotor_mass = 0;                                    ///< kg
  Scalar axial_inertia = 0;                                 ///< lambda, of the rotor about its axis, kg m^2
  Scalar equatorial_inertia = 0;  ///< mu, of the rotor across its axis, about its centroid, kg m^2
  Vec3<Scalar> axis{0, 0, 1};     ///< e, unit
  Vec3<Scalar> offset{0, 0, 0};   ///< d, from the carrier's centroid to the rotor's, m

  /// theta of the whole about the common mass centre, kg m^2 (docs/rotor.md, equation 2.1): the two inertias, and the reduced mass
  /// at the offset.
  /// Errc::not_finite; not_positive: a mass, or an inertia of the rotor; triangle_inequality: a rotor with lambda > 2 mu, which no
  /// mass distribution has (equality is a thin disc).
  Result<Mat3<Scalar>> inertia() const noexcept {
    if (!carrier_inertia.allFinite() || !axis.allFinite() || !offset.allFinite() || !std::isfinite(carrier_mass) ||
        !std::isfinite(rotor_mass) || !std::isfinite(axial_inertia) || !std::isfinite(equatorial_inertia))
      return Errc::not_finite;
    if (!(carrier_mass > 0 && rotor_mass > 0 && axial_inertia > 0 && equatorial_inertia > 0)) return Errc::not_positive;
    if (axial_inertia > 2 * equatorial_inertia * (1 + 8 * epsilon<Scalar>)) return Errc::triangle_inequality;
    const Mat3<Scalar> E = Mat3<Scalar>::Identity();
    const Mat3<Scalar> along = axis * axis.transpose();
    const Scalar reduced_mass = carrier_mass / (carrier_mass + rotor_mass) * rotor_mass;
    return Mat3<Scalar>(carrier_inertia + axial_inertia * along + equatorial_inertia * (E - along) +
                        reduced_mass * (offset.squaredNorm() * E - offset * offset.transpose()));
  }
};

}  // namespace gyrostat::rotor
