// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// A rotor, symmetric about an axis fixed in the carrier. Its spin enters the momentum of the gyrostat in two ways,
///     M = J omega + l              l relative to the carrier, J of the whole with the rotor locked
///     M = J* omega + p axis        p absolute, about the axis;  J* = J less the rotor's axial inertia
/// A motor that holds the rate keeps l constant, a rotor that turns freely keeps p.
template <Real Scalar>
class Rotor {
 public:
  Rotor() = default;

  /// Axis in body axes, of unit length within 1e-8 (it is normalised), and the moment of inertia about it, kg m^2.
  /// Errc::not_finite, zero_vector, out_of_domain where the axis is not of unit length, not_positive.
  static Result<Rotor> from_axis(const Vec3<Scalar>& axis_B, Scalar axial_inertia) noexcept {
    if (!axis_B.allFinite() || !std::isfinite(axial_inertia)) return Errc::not_finite;
    const Scalar length = std::hypot(axis_B[0], axis_B[1], axis_B[2]);
    if (length == 0) return Errc::zero_vector;
    if (!(std::abs(length - 1) <= Scalar(1e-8) + 4 * epsilon<Scalar>)) return Errc::out_of_domain;
    if (!(axial_inertia > 0)) return Errc::not_positive;
    Rotor rotor;
    rotor.axis_ = std::abs(length - 1) <= 4 * epsilon<Scalar> ? axis_B : Vec3<Scalar>(axis_B / length);
    rotor.axial_inertia_ = axial_inertia;
    return rotor;
  }

  const Vec3<Scalar>& axis() const noexcept { return axis_; }
  Scalar axial_inertia() const noexcept { return axial_inertia_; }

  /// l of a rotor that turns at `rate` relative to the carrier, rad/s; body axes, N m s.
  Vec3<Scalar> relative_momentum(Scalar rate) const noexcept { return axial_inertia_ * rate * axis_; }

  /// p of the same rotor while the carrier turns at omega_B.
  Scalar absolute_momentum(Scalar rate, const Vec3<Scalar>& omega_B) const noexcept {
    return axial_inertia_ * (rate + axis_.dot(omega_B));
  }

  /// The rate relative to the carrier, from p.
  Scalar relative_rate(Scalar absolute_momentum, const Vec3<Scalar>& omega_B) const noexcept {
    return absolute_momentum / axial_inertia_ - axis_.dot(omega_B);
  }

  /// The least second moments of mass that it can have, those of the thinnest disc: I/2 (E - u u^T), body axes, kg m^2.
  Mat3<Scalar> least_second_moments() const noexcept {
    return axial_inertia_ / 2 * (Mat3<Scalar>::Identity() - axis_ * axis_.transpose());
  }

  /// J* of J, body axes.
  Mat3<Scalar> inertia_without(const Mat3<Scalar>& J_B) const noexcept {
    return J_B - axial_inertia_ * axis_ * axis_.transpose();
  }

 private:
  Vec3<Scalar> axis_ = Vec3<Scalar>::UnitZ();
  Scalar axial_inertia_ = 1;
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
