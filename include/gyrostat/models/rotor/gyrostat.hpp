// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/body/principal_axes.hpp"
#include "gyrostat/body/realisability.hpp"
#include "gyrostat/body/rotor.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// A free gyrostat whose rotor is driven by a motor of limited power (docs/rotor.md, section 2). A carrier turns with Omega; a
/// rotor symmetric about the axis e, fixed in the carrier, turns with the rate omega relative to it; the motor acts on the rotor with
/// the moment -S (omega - omega*) e. No torque acts from outside:
///     H = theta Omega + lambda omega e,   dH/dt = H x Omega,   lambda d/dt(omega + e.Omega) = -S (omega - omega*).
namespace gyrostat::rotor {

/// What moves, in body axes. SI units.
template <Real Scalar>
struct State {
  Quat<Scalar> attitude{};         ///< body to inertial, unit
  Vec3<Scalar> momentum{0, 0, 0};  ///< H, of the whole gyrostat about its mass centre, N m s
  Scalar axial_momentum = 0;       ///< p = lambda (omega + e.Omega), absolute, of the rotor about its axis, N m s
  Scalar rotor_angle = 0;          ///< integral of omega, rad
};

/// Body, rotor and motor, validated. Body axes, SI units.
template <Real Scalar>
class Gyrostat {
 public:
  /// A unit sphere with a free rotor of inertia 1/4 about axis 3.
  Gyrostat() { *this = make(Mat3<Scalar>::Identity(), Vec3<Scalar>::UnitZ(), Scalar(0.25L), 0, 0).value(); }

  /// inertia_B: theta, of the whole gyrostat about its mass centre, kg m^2, symmetric within 8 eps; axis_B: e, unit within
  /// 1e-8 (it is normalised); axial_inertia: lambda, of the rotor, kg m^2; slope: S >= 0, N m s/rad; no_load_rate: omega*,
  /// relative to the carrier, rad/s.
  /// Errc::not_finite; not_symmetric; not_positive: theta or lambda; zero_vector or out_of_domain: the axis; negative: S;
  /// triangle_inequality: the rotor has more inertia about its axis than the whole can hold, theta - lambda e e^T is not
  /// positive (k <= 0). A body that no mass distribution has, but whose equations can be solved, is reported by realisability().
  static Result<Gyrostat> make(const Mat3<Scalar>& inertia_B, const Vec3<Scalar>& axis_B, Scalar axial_inertia,
                               Scalar slope, Scalar no_load_rate) noexcept {
    if (!inertia_B.allFinite() || !std::isfinite(slope) || !std::isfinite(no_load_rate)) return Errc::not_finite;
    const auto rotor = Rotor<Scalar>::from_axis(axis_B, axial_inertia);
    if (!rotor) return rotor.error();
    if (slope < 0) return Errc::negative;
    const auto symmetric = symmetric_part<Scalar>(inertia_B);
    if (!symmetric) return symmetric.error();

    Gyrostat made{Unset{}};
    made.inertia_ = *symmetric;
    made.rotor_ = *rotor;
    made.slope_ = slope;
    made.no_load_rate_ = no_load_rate;
    constexpr Scalar least = 64 * epsilon<Scalar>;
    const SymmetricEigen<Scalar> whole = symmetric_eigen<Scalar>(made.inertia_);
    if (!(whole.values[0] > least * whole.values[2])) return Errc::not_positive;
    const SymmetricEigen<Scalar> free = symmetric_eigen<Scalar>(rotor->inertia_without(made.inertia_));
    if (!(free.values[0] > least * whole.values[2])) return Errc::triangle_inequality;
    made.principal_ = whole.values;
    made.R_BP_ = whole.axes;
    made.free_principal_ = free.values;
    made.inverse_ = whole.axes * whole.values.cwiseInverse().asDiagonal() * whole.axes.transpose();
    made.free_inverse_ = free.axes * free.values.cwiseInverse().asDiagonal() * free.axes.transpose();
    // k = 1 - lambda e.J e without the cancellation
    made.coupling_ = 1 / (1 + axial_inertia * made.axis().dot(made.free_inverse_ * made.axis()));
    return made;
  }

  const Mat3<Scalar>& inertia() const noexcept { return inertia_; }          ///< theta, kg m^2
  const Mat3<Scalar>& inverse_inertia() const noexcept { return inverse_; }  ///< J = theta^-1, 1/(kg m^2)
  /// R^-1, R = theta - lambda e e^T: the inertia with the rotor free to turn about its axis, 1/(kg m^2).
  const Mat3<Scalar>& free_inverse() const noexcept { return free_inverse_; }
  const Vec3<Scalar>& principal() const noexcept { return principal_; }  ///< of theta, ascending, kg m^2
  const Mat3<Scalar>& R_BP() const noexcept { return R_BP_; }            ///< principal axes of theta to body axes
  const Vec3<Scalar>& free_principal() const noexcept { return free_principal_; }  ///< of R, ascending, kg m^2
  /// The principal axes and moments of R, to rounding of their own; found anew in each call, some 2 us where R is not diagonal.
  PrincipalAxes<Scalar> free_axes() const noexcept {
    using Wide = Wider<Scalar>;
    const Vec3<Wide> e = vector_cast<Wide>(axis());
    return PrincipalAxes<Scalar>::nearest_of(matrix_cast<Wide>(inertia_) - Wide(axial_inertia()) * e * e.transpose());
  }

  const Vec3<Scalar>& axis() const noexcept { return rotor_.axis(); }       ///< e
  Scalar axial_inertia() const noexcept { return rotor_.axial_inertia(); }  ///< lambda, kg m^2
  Scalar slope() const noexcept { return slope_; }                          ///< S, N m s/rad
  Scalar no_load_rate() const noexcept { return no_load_rate_; }            ///< omega*, rad/s
  Scalar coupling() const noexcept { return coupling_; }                    ///< k = 1 - lambda e.J e, in (0, 1)
  Scalar relaxation_rate() const noexcept { return slope_ / (axial_inertia() * coupling_); }  ///< S/(lambda k), 1/s
  Scalar target_momentum() const noexcept { return axial_inertia() * no_load_rate_; }  ///< h = lambda omega*, N m s

  /// By how much the inverse of R magnifies rounding: its greatest moment over the least, and 1 where R is diagonal.
  Scalar condition() const noexcept {
    const bool diagonal = free_inverse_(0, 1) == 0 && free_inverse_(0, 2) == 0 && free_inverse_(1, 2) == 0;
    return diagonal ? Scalar(1) : free_principal_[2] / free_principal_[0];
  }
  /// What a rounding of the tensor, over epsilon, comes to in H where the carrier turns with Omega, N m s; 0 where R is diagonal.
  Scalar momentum_blur(const Vec3<Scalar>& Omega) const noexcept {
    return condition() > 1 ? principal_[2] * Omega.norm() : Scalar(0);
  }

  /// Omega of H and p, rad/s.
  Vec3<Scalar> angular_velocity(const Vec3<Scalar>& H, Scalar p) const noexcept {
    return free_inverse_ * (H - p * axis());
  }
  /// omega of p and Omega, relative to the carrier, rad/s.
  Scalar rotor_rate(Scalar p, const Vec3<Scalar>& Omega) const noexcept { return rotor_.relative_rate(p, Omega); }
  /// The state in which the carrier turns with Omega and the rotor with the rate omega relative to it. Where the two parts of H
  /// cancel to rounding, H = 0 exactly.
  State<Scalar> state(const Quat<Scalar>& attitude, const Vec3<Scalar>& Omega, Scalar omega) const noexcept {
    using Wide = Wider<Scalar>;  // so that a number of the state has one rounding
    const Vec3<Wide> turn = vector_cast<Wide>(Omega), e = vector_cast<Wide>(axis());
    const Vec3<Wide> carrier = matrix_cast<Wide>(inertia_) * turn;
    const Wide spin = Wide(axial_inertia()) * Wide(omega);
    Vec3<Scalar> H = vector_cast<Scalar>(Vec3<Wide>(carrier + spin * e));
    if (magnitude(H) <= lost_momentum(vector_cast<Scalar>(carrier), omega)) H.setZero();
    return {attitude, H, static_cast<Scalar>(spin + Wide(axial_inertia()) * e.dot(turn)), 0};
  }

  /// The momentum, N m s, that state() takes for none, where the carrier has theta Omega and the rotor turns with the rate omega.
  Scalar lost_momentum(const Vec3<Scalar>& of_carrier, Scalar omega) const noexcept {
    return 8 * epsilon<Scalar> * (magnitude(of_carrier) + axial_inertia() * std::abs(omega));
  }

  /// Rotational energy about the mass centre, J.
  Scalar energy(const Vec3<Scalar>& H, Scalar p) const noexcept {
    const Vec3<Scalar> G = H - p * axis();
    return G.dot(free_inverse_ * G) / 2 + p * p / (2 * axial_inertia());
  }
  /// F(H) = (H - h e).J (H - h e)/2, J: the Lyapunov function at omega = omega*. Its critical points on |H| = l are the steady
  /// rotations.
  Scalar steady_level(const Vec3<Scalar>& H) const noexcept {
    const Vec3<Scalar> y = H - target_momentum() * axis();
    return y.dot(inverse_ * y) / 2;
  }
  /// V = energy - omega* p + lambda omega*^2/2 = F(H) + lambda k (omega - omega*)^2/2 >= 0, J. dV/dt = -S (omega - omega*)^2.
  Scalar lyapunov(const Vec3<Scalar>& H, Scalar p) const noexcept {
    const Scalar x = rotor_rate(p, angular_velocity(H, p)) - no_load_rate_;
    return steady_level(H) + axial_inertia() * coupling_ * x * x / 2;
  }

  /// Least eigenvalue of tr(theta)/2 E - theta - lambda/2 (E - e e^T), kg m^2: negative where no mass distribution has this
  /// theta and this rotor (the thinnest disc is assumed for the rotor). Stronger than the triangle inequality.
  Scalar realisability() const noexcept {
    return gyrostat::realisability<Scalar>(inertia_, rotor_.least_second_moments());
  }
  /// Whether realisability() >= 0, to rounding.
  bool realisable() const noexcept { return realisability() >= -8 * epsilon<Scalar> * principal_[2]; }

 private:
  struct Unset {};
  explicit Gyrostat(Unset) noexcept {}

  Mat3<Scalar> inertia_, inverse_, free_inverse_, R_BP_;
  Vec3<Scalar> principal_, free_principal_;
  Rotor<Scalar> rotor_;
  Scalar slope_, no_load_rate_, coupling_;
};

}  // namespace gyrostat::rotor
