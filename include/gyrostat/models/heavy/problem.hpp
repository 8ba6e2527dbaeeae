// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/body/realisability.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A heavy body that turns about a fixed point O in a Newtonian field, to second order in size over distance
/// (docs/heavy.md, section 2):
///     I w' = (I w) x w + M g r_cm x d + N d x (I d),   d' = d x w,
/// with w the angular velocity and d the unit vector DOWN, to the attracting centre, both in body axes.
namespace gyrostat::heavy {

/// A motion at one time. SI units.
template <Real Scalar>
struct State {
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< (p, q, r), body axes, rad/s
  Vec3<Scalar> down{0, 0, -1};             ///< body axes, unit
  Quat<Scalar> attitude;  ///< body to inertial; the inertial axis 3 points up, so that down = -(row 3 of R_IB)
};

/// Body and field, in principal axes of the body at O, in any order.
template <Real Scalar>
class Problem {
 public:
  /// The unit sphere without weight.
  Problem() = default;

  /// Errors: not_finite; not_positive (a moment, the mass); negative (gravity, gradient); triangle_inequality, also where no
  /// mass distribution has these moments about O with its centre there (see realisability), beyond 8 eps.
  /// @param inertia A, B, C about O, kg m^2   @param mass kg   @param centre_of_mass from O, body axes, m
  /// @param gravity g at O, m/s^2   @param gradient N = 3 g/R with R the distance to the attracting centre, 1/s^2
  static Result<Problem> make(const Vec3<Scalar>& inertia, Scalar mass, const Vec3<Scalar>& centre_of_mass,
                              Scalar gravity, Scalar gradient) noexcept {
    if (!inertia.allFinite() || !centre_of_mass.allFinite() || !(std::abs(mass) < infinity<Scalar>) ||
        !(std::abs(gravity) < infinity<Scalar>) || !(std::abs(gradient) < infinity<Scalar>))
      return Errc::not_finite;
    if (!(inertia.minCoeff() > 0) || !(mass > 0)) return Errc::not_positive;
    if (gravity < 0 || gradient < 0) return Errc::negative;
    Problem made;
    made.inertia_ = inertia;
    made.mass_ = mass;
    made.centre_ = centre_of_mass;
    made.gravity_ = gravity;
    made.gradient_ = gradient;
    if (!(made.realisability() >= -8 * epsilon<Scalar> * inertia.maxCoeff())) return Errc::triangle_inequality;
    return made;
  }

  const Vec3<Scalar>& inertia() const noexcept { return inertia_; }            ///< A, B, C, kg m^2
  Scalar mass() const noexcept { return mass_; }                               ///< kg
  const Vec3<Scalar>& centre_of_mass() const noexcept { return centre_; }      ///< m
  Scalar gravity() const noexcept { return gravity_; }                         ///< m/s^2
  Scalar gradient() const noexcept { return gradient_; }                       ///< N, 1/s^2
  Vec3<Scalar> moment() const noexcept { return mass_ * gravity_ * centre_; }  ///< M g r_cm, N m
  /// c = sqrt(M g l/C), the pendulum rate, rad/s.
  Scalar pendulum_rate() const noexcept { return std::sqrt(magnitude(moment()) / inertia_[2]); }

  /// Least eigenvalue of the second moments of mass about the mass centre, tr(I)/2 - I - M r r^T, kg m^2: negative where no body has
  /// this inertia about O and this mass centre. Stronger than the triangle inequality.
  Scalar realisability() const noexcept {
    return gyrostat::realisability<Scalar>(inertia_.asDiagonal(), mass_ * centre_ * centre_.transpose());
  }

  /// I w' in body axes, N m.
  Vec3<Scalar> torque(const Vec3<Scalar>& angular_velocity, const Vec3<Scalar>& down) const noexcept {
    return inertia_.cwiseProduct(angular_velocity).cross(angular_velocity) + moment().cross(down) +
           gradient_ * down.cross(inertia_.cwiseProduct(down));
  }
  /// Kinetic energy - M g r_cm . d + (N/2) d . I d, J: constant.
  Scalar energy(const State<Scalar>& s) const noexcept {
    return (inertia_.dot(s.angular_velocity.cwiseAbs2()) + gradient_ * inertia_.dot(s.down.cwiseAbs2())) / 2 -
           moment().dot(s.down);
  }
  /// sigma = I w . d, N m s: constant.
  Scalar vertical_momentum(const State<Scalar>& s) const noexcept {
    return inertia_.cwiseProduct(s.angular_velocity).dot(s.down);
  }

 private:
  Vec3<Scalar> inertia_{1, 1, 1};
  Scalar mass_ = 1;
  Vec3<Scalar> centre_{0, 0, 0};
  Scalar gravity_ = 0;
  Scalar gradient_ = 0;
};

}  // namespace gyrostat::heavy
