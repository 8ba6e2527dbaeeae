// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/models/spinning/problem.hpp"

/// What the family `spinning` gives: its tables, and the row of columns of a state.
namespace gyrostat::spinning {

/// Places in column_kinds.
namespace column {
enum : std::size_t { angular_velocity, euler_312, attitude, angular_momentum_inertial, velocity, position };
}

inline constexpr ColumnKind column_kinds[] = {
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity of the carrier, body axes",
     "the rates at t = 0, or those that the torque builds up while the body turns by a radian"},
    {"euler_312", 3, "rad", Frame::body_to_inertial, Measure::angle,
     "angles psi, phi, theta: body to inertial is Rz(theta) Rx(psi) Ry(phi); theta counts turns; phi and theta may "
     "each "
     "be off by twice the error over cos(psi)"},
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
    {"angular_momentum_inertial", 3, "N m s", Frame::inertial, Measure::relative,
     "angular momentum without the charge's, inertial axes",
     "a thousandth of the momenta of body and rotor at t = 0, which may cancel"},
    {"velocity", 3, "m/s", Frame::inertial, Measure::relative, "velocity of the mass centre, inertial axes",
     "the velocity at t = 0, and what the force adds while the body turns by a radian"},
    {"position", 3, "m", Frame::inertial, Measure::relative, "position of the mass centre, inertial axes",
     "the position at t = 0, the way at the velocity of t = 0, and what the force adds while the body turns by a "
     "radian"},
};

/// Places in scalar_kinds.
namespace scalar {
enum : std::size_t { pointing_error, secular_velocity_ratio, tilt_max, nutation_frequency_squared };
}

inline constexpr ScalarKind scalar_kinds[] = {
    {"pointing_error", 1, "rad", Frame::none, Measure::none, "mean lean of axis 3 under the torque, |M|/|r0 X|"},
    {"secular_velocity_ratio", 2, "1", Frame::inertial, Measure::none, "limit of (v1, v2)/v3"},
    {"tilt_max", 1, "rad", Frame::none, Measure::absolute,
     "greatest tilt of axis 3 from inertial axis 3 at the asked times"},
    {"nutation_frequency_squared", 1, "1/s2", Frame::none, Measure::none,
     "square of the nutation frequency; negative: the spin is unstable"},
};

/// Places in warning_kinds.
namespace warning {
enum : std::size_t {
  beyond_validity,
  gimbal_lock,
  no_spin,
  no_stiffness,
  resonance,
  unstable_spin,
  spin_reversal,
  mean_of_small_tilt
};
}

inline constexpr WarningKind warning_kinds[] = {
    {"beyond-validity",
     "the tilt, or the error of the spin angle, may exceed 0.3 rad: the equations for small tilt and their error "
     "estimate mean little; greatest tilt estimated, rad"},
    {"gimbal-lock", "the motion passes so near to cos(psi) = 0 that theta is known but for a turn"},
    {"no-spin", "the body does not spin at the start: nothing holds its direction"},
    {"no-stiffness", "D3 r0 + lambda3 - e_H is near 0: next to no gyroscopic stiffness; it is, N m s"},
    {"resonance", "spin and nutation are near resonance: the tilt grows over many turns; they differ by, 1/s"},
    {"unstable-spin", "nu^2 <= 0: the transverse rates grow; nu^2, 1/s^2"},
    {"spin-reversal", "the axial torque takes the spin through zero at about, s"},
    {"mean-of-small-tilt",
     "pointing_error and secular_velocity_ratio are formulas for small tilt, and not those of this motion: they are "
     "off by up to, relative"},
};

/// Places in rung_kinds, cheapest first.
namespace rung {
enum : int { linear, second_order, picard, full };
}

inline constexpr RungKind rung_kinds[] = {
    {"linear", "small tilt: closed form; under an axial torque Taylor series"},
    {"second-order",
     "the closed form with spin rate, spin angle, momentum and thrust right to the next order in the tilt"},
    {"picard", "sweeps of quadratures over the full equations; by name only"},
    {"full", "the full equations"},
};

inline constexpr const char* integrator_names[] = {"taylor", "cvode"};

inline constexpr Family tables{"spinning", column_kinds, scalar_kinds, warning_kinds, rung_kinds, integrator_names};

template <Real Scalar>
using ColumnErrors = Errors<std::size(column_kinds), Scalar>;

/// The scales of the columns that a problem sets for the times up to `span`, s, in their units.
template <Real Scalar>
ColumnErrors<Scalar> scales(const Problem<Scalar>& problem, Scalar span) noexcept {
  const Scalar rate = problem.rate_size(span), turning = std::min(span, 1 / rate);
  const Scalar push = problem.force.norm() / problem.mass;
  ColumnErrors<Scalar> made;
  made[column::angular_velocity] = rate;
  // parts that cancel are still measured by what is left of them
  made[column::angular_momentum_inertial] =
      Scalar(1e-3L) *
      (problem.inertia.cwiseProduct(problem.angular_velocity).norm() + std::abs(problem.rotor_momentum));
  made[column::velocity] = problem.velocity.norm() + push * turning;
  made[column::position] = problem.position.norm() + problem.velocity.norm() * span + push * turning * turning;
  return made;
}

/// Writes the columns of a state, one behind the other: the one place that knows them.
template <Real S>
struct Row {
  using Scalar = S;
  using State = spinning::State<S>;
  static constexpr const auto& columns = column_kinds;

  ColumnErrors<S> scale{};  ///< of the columns; none where it is left out

  void operator()(const State& state, S* row) const noexcept {
    const auto& [omega, angles, q, G, v, x] = state;
    for (const S value : {omega[0], omega[1], omega[2], angles.psi, angles.phi, angles.theta, q.x, q.y, q.z, q.w, G[0],
                          G[1], G[2], v[0], v[1], v[2], x[0], x[1], x[2]})
      *row++ = value;
  }

  /// |angular_velocity|.
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return std::hypot(row[0], row[1], row[2]);
  }
};

/// The error of euler_312 where the attitude errs by `attitude`, rad. The angles are judged by the attitude that they tell, for near
/// cos(psi) = 0 phi and theta turn the body about the same axis, and only their sum or difference means anything. Angles of many turns
/// are rounded as numbers of that size.
template <Real Scalar>
Scalar angles_error(Scalar attitude, std::span<const State<Scalar>> states) noexcept {
  Scalar most = 0;
  for (const State<Scalar>& s : states)
    most = greater(std::abs(s.angles.psi) + std::abs(s.angles.phi) + std::abs(s.angles.theta), most);
  return attitude + epsilon<Scalar> * most;
}

}  // namespace gyrostat::spinning
