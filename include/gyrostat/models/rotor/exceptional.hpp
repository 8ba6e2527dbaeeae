// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "gyrostat/models/rotor/steady_stability.hpp"

/// The gyrostats whose momentum direction need not settle exponentially, or at all (docs/rotor.md, sections 3 and 4).
namespace gyrostat::rotor {

/// By precedence: a body axisymmetric about the rotor's axis has that axis principal, too.
enum class Exceptional : std::uint8_t {
  none,
  at_rest,       ///< L = 0: the direction m does not exist
  axisymmetric,  ///< theta symmetric about e, the sphere included: m precesses about e for ever
  circular_section,  ///< triaxial, n = J e normal to a circular section of x.J x = 1: the great circle n.m = 0 is invariant with
                     ///< omega = omega*
  principal_axis,  ///< e is a principal axis: m tends to +-e algebraically
};

/// How far the body is from each family: 0 on it, of order 1 far from it, linear in between. Below exceptional_rounding it is
/// on it as far as the numbers can resolve.
template <Real Scalar>
struct ExceptionalDistance {
  Scalar at_rest = 1;       ///< l/(l + |h|)
  Scalar axisymmetric = 1;  ///< |theta - its mean over turns about e|/|theta|
  Scalar circular_section =
      1;  ///< half the difference of the eigenvalues of J on the plane normal to n, over the largest of J
  Scalar principal_axis = 1;               ///< |e x theta e|/|theta|
  Exceptional family = Exceptional::none;  ///< the first of them that holds to rounding
};

template <Real Scalar>
inline constexpr Scalar exceptional_rounding = 64 * epsilon<Scalar>;

/// momentum_norm: l, N m s.
template <Real Scalar>
ExceptionalDistance<Scalar> exceptional_distance(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept {
  const Vec3<Scalar>& e = gyrostat.axis();
  const Mat3<Scalar>&theta = gyrostat.inertia(), &J = gyrostat.inverse_inertia();
  const Vec3<Scalar> theta_e = theta * e;
  const Scalar size = theta.norm(), axial = e.dot(theta_e), across = (theta.trace() - axial) / 2;
  const Mat3<Scalar> mean = across * Mat3<Scalar>::Identity() + (axial - across) * e * e.transpose();
  const detail::Tangent<Scalar> t((J * e).normalized());
  const Vec3<Scalar> Ju = J * t.u, Jv = J * t.v;

  ExceptionalDistance<Scalar> r;
  r.at_rest = momentum_norm > 0 ? momentum_norm / (momentum_norm + std::abs(gyrostat.target_momentum())) : Scalar(0);
  r.axisymmetric = (theta - mean).norm() / size;
  r.circular_section = std::hypot((t.u.dot(Ju) - t.v.dot(Jv)) / 2, t.u.dot(Jv)) * gyrostat.principal()[0];
  r.principal_axis = cross<Scalar>(e, theta_e).norm() / size;
  constexpr Scalar rounding = exceptional_rounding<Scalar>;
  r.family = r.at_rest == 0                   ? Exceptional::at_rest
             : r.axisymmetric <= rounding     ? Exceptional::axisymmetric
             : r.circular_section <= rounding ? Exceptional::circular_section
             : r.principal_axis <= rounding   ? Exceptional::principal_axis
                                              : Exceptional::none;
  return r;
}

/// The great circle n.m = 0 of the family circular_section: it is invariant, at one level of F.
template <Real Scalar>
struct CircularSection {
  Scalar level = 0;     ///< F on it, J
  Scalar drive = 0;     ///< h |n|, rad/s
  Scalar hold = 0;      ///< l |b|, rad/s: phi' = drive - hold sin(phi)
  bool tumbles = true;  ///< |drive| > hold: m runs round the circle for ever; else it has two steady rotations on it
};

template <Real Scalar>
CircularSection<Scalar> circular_section(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm) noexcept {
  const Mat3<Scalar>& J = gyrostat.inverse_inertia();
  const Scalar l = momentum_norm, h = gyrostat.target_momentum();
  const Vec3<Scalar> n = J * gyrostat.axis();
  const Scalar length = n.norm();
  const detail::Tangent<Scalar> t(n / length);
  const Vec3<Scalar> Jn = J * n / length;
  CircularSection<Scalar> r;
  // on the circle m.J m is half the trace of J on its plane
  r.level = (l * l * (t.u.dot(J * t.u) + t.v.dot(J * t.v)) / 2 + h * h * gyrostat.axis().dot(n)) / 2;
  r.drive = h * length;
  r.hold = l * std::hypot(t.u.dot(Jn), t.v.dot(Jn));
  r.tumbles = std::abs(r.drive) > r.hold;
  return r;
}

/// The constant c of the algebraic law 1/W = 1/W0 + c t, W = |V - F(m)|, close to a steady rotation m = +-e of a rotor on a
/// principal axis, 1/(J s). Away from a maximum W grows, 1/W = 1/W0 - c t. NaN for a saddle and where m is not +-e or e is not
/// principal (within 1e-6); 0 for a body symmetric about e. With A_1, A_2 the eigenvalues of B on the tangent plane,
///     c = (S/8) (n.m/k)^2 nu^2/(nu^2 + s^2) (1/A_1 - 1/A_2)^2,   nu = 2 sqrt(A_1 A_2),   s = S/(lambda k).
template <Real Scalar>
Scalar algebraic_rate(const Gyrostat<Scalar>& gyrostat, Scalar momentum_norm,
                      const SteadyRotation<Scalar>& rotation) noexcept {
  const Mat3<Scalar>& J = gyrostat.inverse_inertia();
  const Vec3<Scalar>& m = rotation.direction;
  const Vec3<Scalar> n = J * gyrostat.axis();
  const Scalar near = Scalar(1e-6L);
  if (!(cross<Scalar>(n, m).norm() <= near * n.norm()) || !(cross<Scalar>(gyrostat.axis(), m).norm() <= near))
    return nan<Scalar>;
  const detail::Tangent<Scalar> t(m);
  const Vec3<Scalar> Ju = momentum_norm * (J * t.u), Jv = momentum_norm * (J * t.v);
  const Scalar uu = t.u.dot(Ju) - rotation.spin_rate, uv = t.u.dot(Jv), vv = t.v.dot(Jv) - rotation.spin_rate;
  const Scalar D = uu * vv - uv * uv, difference = std::hypot(uu - vv, 2 * uv);
  if (!(D > 0)) return nan<Scalar>;
  const Scalar s = gyrostat.relaxation_rate(), gain = n.dot(m) / gyrostat.coupling() * (difference / D);
  return gyrostat.slope() / 8 * gain * gain * (4 * D / (4 * D + s * s));
}

}  // namespace gyrostat::rotor
