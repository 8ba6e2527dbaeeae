// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/vector.hpp"

/// How large the quantities of a motion are, or may become.
namespace gyrostat::general {

template <Real Scalar>
struct Sizes {
  Scalar momenta = 0;   ///< of body and wheels at t = 0, their magnitudes summed, N m s
  Scalar torque = 0;    ///< a bound of all torques, motors included, but those that vanish with the motion, N m
  Scalar external = 0;  ///< the same without the motors
  Scalar force = 0;     ///< of the forces that move the mass centre, N
  Scalar built =
      0;  ///< momentum that the torques build up over the span, or until the body has turned by about a radian, N m s
  Scalar least = 1, greatest = 1;  ///< moments of J* and J, kg m^2
  Scalar turning = 0;              ///< how fast the body turns or could soon turn, of the order of |w|, rad/s
  /// Angle that it is likely to turn through over the span, rad: the span times the sum of its rate, of the precession due to its wheels and to half the
  /// momentum that motors and steady torques add while they are on, and of the rate of its swings in a field or gradient. Of 600 random scenes the steps
  /// of the runs were 0.3 to 4 times those of a law in proportion to it.
  Scalar angle = 0;

  Scalar damping = 0;  ///< rate at which torques linear in the motion change it, 1/s
  Scalar forcing = 0;  ///< greatest rate of what depends on time alone: waves, fields, the orbit, rad/s

  /// The momenta, or what the torques build up where there are none.
  Scalar momentum() const noexcept { return momenta > 0 ? momenta : built; }
};

namespace detail {

/// The greatest magnitude of a factor.
template <Real Scalar>
Scalar greatest_factor(const Factor<Scalar>& factor) noexcept {
  using std::abs;
  Scalar table = factor.table.values.empty() ? Scalar(1) : Scalar(0);
  for (const Scalar v : factor.table.values) table = std::max(table, abs(v));
  return table * (abs(factor.mean) + abs(factor.amplitude));
}

/// Bounds of the torques of a record without its factor and brakes: `steady`, of those that keep their direction in some axes while the body turns;
/// `swinging`, of those that change with its attitude.
template <Real Scalar>
struct Pushes {
  Scalar steady = 0, swinging = 0;
};
/// @param torque a bound of all of them
template <Real Scalar>
Pushes<Scalar> pushes_of(const Terms<Scalar>& terms, Scalar torque) noexcept {
  Pushes<Scalar> made{terms.body.norm(), 0};
  Scalar rest = torque - terms.body.norm() - terms.brake_total.norm() - terms.brake_carrier.norm();
  for (const auto* frame : {&terms.inertial, &terms.orbital}) {
    Vec3<Scalar> steady;  // a multiple of the unit matrix for each axis, where the torque stands still in the frame
    for (int j = 0; j < 3; ++j) {
      const Mat3<Scalar>& part = (*frame)[std::size_t(j)];
      steady[j] = part.trace() / 3;
      rest -= part.norm();
      made.swinging += Mat3<Scalar>(part - steady[j] * Mat3<Scalar>::Identity()).norm();
    }
    made.steady += steady.norm();
  }
  made.swinging += std::max(Scalar(0), rest);
  return made;
}

/// A bound of the torques of a record without its factor, where the body stands still.
template <Real Scalar>
Scalar torque_size(const Problem<Scalar>& problem, const Terms<Scalar>& terms, Scalar greatest) noexcept {
  using std::abs;
  Scalar sum = terms.body.norm() + terms.brake_total.norm() + terms.brake_carrier.norm();
  for (std::size_t j = 0; j < 3; ++j) sum += terms.inertial[j].norm() + terms.orbital[j].norm();
  sum += abs(terms.gradient) * greatest;
  if (terms.orbit_gradient != 0) {
    const auto at = orbit_at(*problem.orbit, Scalar(0));
    sum += abs(terms.orbit_gradient) * at.gradient * greatest;
  }
  if (terms.dipole.isZero(0) && terms.eddy.isZero(0)) return sum;
  const auto field = field_at(problem, Scalar(0));
  return sum + terms.dipole.norm() * field.flux_density.norm() +
         terms.eddy.norm() * field.flux_density.norm() * field.rate.norm();
}

/// Rate at which the torques of a record that are linear in the motion change it, without the factor, 1/s.
template <Real Scalar>
Scalar damping_rate(const Problem<Scalar>& problem, const Terms<Scalar>& terms, Scalar least) noexcept {
  Scalar sum = terms.by_rate.norm() / least + terms.by_momentum.norm();
  if (!terms.eddy.isZero(0)) sum += terms.eddy.norm() * field_at(problem, Scalar(0)).flux_density.squaredNorm() / least;
  return sum;
}

/// Greatest rate of the loads that depend on time alone: waves, a rotating field, the mean motion of the orbit, rad/s.
template <Real Scalar>
Scalar forcing_rate(const Problem<Scalar>& problem) noexcept {
  using std::abs, std::sqrt;
  Scalar rate = 0;
  bool sees_field = false;
  for (const auto& torque : problem.torques) {
    if (torque.factor.amplitude != 0) rate = std::max(rate, abs(torque.factor.rate));
    sees_field = sees_field || torque.type == TorqueType::magnetic || torque.type == TorqueType::eddy_current;
  }
  if (sees_field && problem.field.magnetic == MagneticField::rotating) rate = std::max(rate, abs(problem.field.rate));
  if (!problem.orbit) return rate;
  const auto& orbit = *problem.orbit;
  using std::cos;
  const Scalar axis = orbit.radius * (1 + orbit.eccentricity * cos(orbit.true_anomaly)) /
                      ((1 - orbit.eccentricity) * (1 + orbit.eccentricity));
  return std::max(rate, sqrt(orbit.mu / axis) / axis);
}

/// How long a factor is on, s.
template <Real Scalar>
Scalar time_on(const Factor<Scalar>& factor, Scalar span) noexcept {
  if (factor.on.empty()) return span;
  Scalar sum = 0;
  for (const auto& [from, to] : factor.on) sum += std::max(Scalar(0), std::min(to, span) - std::max(from, Scalar(0)));
  return std::min(sum, span);
}

}  // namespace detail

template <Real Scalar>
Sizes<Scalar> sizes_of(const Problem<Scalar>& problem, const Wheels<Scalar>& wheels, const Collected<Scalar>& torques,
                       Scalar span) noexcept {
  using std::abs, std::sqrt;
  Sizes<Scalar> made;
  made.least = symmetric_eigen<Scalar>(wheels.reduced).values[0];
  made.greatest = symmetric_eigen<Scalar>(wheels.whole).values[2];
  const Scalar of_body = (wheels.reduced * problem.angular_velocity).norm();
  made.momenta = of_body + wheels.rotor_momentum.norm();
  Scalar motors = 0, given = 0;  // their torques, and the momentum that these give
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    made.momenta += abs(law.momentum);
    if (law.follows == Follows::rate) {
      Scalar rate = abs(law.rate);
      for (const Scalar v : problem.wheels[i].table.values) rate = std::max(rate, abs(v));
      made.momenta += law.tabled ? law.axial_inertia * rate : Scalar(0);
      continue;
    }
    Scalar push = abs(law.torque);
    for (const Scalar v : problem.wheels[i].table.values) push = std::max(push, abs(law.torque + v));
    if (!law.turns_by_itself()) continue;
    const Scalar torque = push + law.friction * abs(law.rate), settled = law.axial_inertia * torque;
    motors += torque;
    // a wheel that settles gives no more than what it comes to hold
    given += law.friction * span > law.axial_inertia ? settled / law.friction : torque * span;
  }
  Scalar pushed = given, swings = 0;  // momentum, and torques that change with the attitude
  for (const auto& record : torques.records) {
    const Scalar factor = detail::greatest_factor(record.factor);
    const Scalar torque = detail::torque_size(problem, record.sum, made.greatest);
    const auto pushes = detail::pushes_of(record.sum, torque);
    const Scalar on = detail::time_on(record.factor, span);
    made.external += factor * torque, swings += factor * pushes.swinging;
    given += factor * torque * on, pushed += factor * pushes.steady * on;
    made.damping += factor * detail::damping_rate(problem, record.sum, made.least);
    made.force += factor * (record.sum.force_body.norm() + record.sum.force_inertial.norm());
  }
  made.forcing = detail::forcing_rate(problem);
  made.torque = made.external + motors;
  made.built = std::min(given, sqrt(made.torque * made.greatest));
  made.turning = made.momenta / made.least + std::min(given / made.least, sqrt(made.torque / made.least));
  const Scalar mean = sqrt(made.least * made.greatest), swinging = sqrt(swings / mean);
  const Scalar precessing = (made.momenta - of_body + pushed / 2) / mean;
  made.angle = (problem.angular_velocity.norm() + precessing + swinging) * span;
  return made;
}

}  // namespace gyrostat::general
