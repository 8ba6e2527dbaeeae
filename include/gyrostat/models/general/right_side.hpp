// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/holding.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/table.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// The equations of docs/general.md, section 1, as they stand there: torque by torque and wheel by wheel, for integrators that want a
/// right-hand side and for what is asked seldom. Nothing is collected beforehand.
namespace gyrostat::general {

/// A torque about the reference point and a force on the mass centre, body axes.
template <Real Scalar>
struct Load {
  Vec3<Scalar> torque{0, 0, 0};  ///< N m
  Vec3<Scalar> force{0, 0, 0};   ///< N
};

/// What loads depend on.
template <Real Scalar>
struct Pose {
  Quat<Scalar> attitude{};                 ///< body to inertial, unit
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< rad/s, body axes
  Vec3<Scalar> angular_momentum{0, 0, 0};  ///< N m s, body axes
};

namespace detail {

/// A factor at t, in the piece between two breakpoints that holds `inside`.
template <Real Scalar>
Scalar factor_at(const Factor<Scalar>& factor, Scalar t, Scalar inside) noexcept {
  if (!factor.is_on(inside)) return 0;
  Scalar made = factor.mean;
  if (factor.amplitude != 0) made += factor.amplitude * clock_angle(factor.rate, t, factor.phase).sine;
  if (!factor.table.times.empty()) made *= piece(factor.table, 1, 0, inside)(t);
  return made;
}

template <Real Scalar>
Vec3<Scalar> table_at(const Table<Scalar>& table, Scalar t, Scalar inside) noexcept {
  return {piece(table, 3, 0, inside)(t), piece(table, 3, 1, inside)(t), piece(table, 3, 2, inside)(t)};
}

/// d x J d
template <Real Scalar>
Vec3<Scalar> gradient_shape(const Mat3<Scalar>& J, const Vec3<Scalar>& d) noexcept {
  return cross<Scalar>(d, Vec3<Scalar>(J * d));
}

/// What damping and brakes oppose.
template <Real Scalar>
Vec3<Scalar> opposed_by(const Problem<Scalar>& problem, const Torque<Scalar>& torque,
                        const Pose<Scalar>& pose) noexcept {
  if (torque.opposed == Opposed::angular_velocity) return pose.angular_velocity;
  if (torque.opposed == Opposed::momentum) return pose.angular_momentum;
  return problem.inertia * pose.angular_velocity;
}

/// One torque without its factor; that of a brake where what it opposes is not zero.
template <Real Scalar>
Load<Scalar> load_of(const Problem<Scalar>& problem, const Torque<Scalar>& torque, const Pose<Scalar>& pose, Scalar t,
                     Scalar inside) noexcept {
  const auto to_body = [&](const Vec3<Scalar>& v_I) noexcept { return rotate<Scalar>(conjugate(pose.attitude), v_I); };
  const auto from_orbit = [&](const Vec3<Scalar>& v) noexcept {
    const auto at = orbit_at(*problem.orbit, t);
    return Vec3<Scalar>(v[0] * at.radial + v[1] * at.along + v[2] * cross<Scalar>(at.radial, at.along));
  };
  const auto turned = [&](const Vec3<Scalar>& v) noexcept {
    if (torque.axes == Axes::body) return v;
    return to_body(torque.axes == Axes::inertial ? v : from_orbit(v));
  };
  const Vec3<Scalar>& w = pose.angular_velocity;
  const Vec3<Scalar> down = to_body(problem.field.down);
  const Vec3<Scalar> opposed = opposed_by(problem, torque, pose);
  switch (torque.type) {
    case TorqueType::constant: return {turned(torque.vector), {0, 0, 0}};
    case TorqueType::table: return {turned(table_at(torque.table, t, inside)), {0, 0, 0}};
    case TorqueType::damping: return {-(torque.matrix * opposed), {0, 0, 0}};
    case TorqueType::brake: return {-torque.vector.cwiseProduct(opposed) / opposed.norm(), {0, 0, 0}};
    case TorqueType::weight:
      return {problem.mass * problem.field.gravity * cross<Scalar>(problem.centre_of_mass, down), {0, 0, 0}};
    case TorqueType::gravity_gradient: {
      if (torque.gradient) return {*torque.gradient * gradient_shape<Scalar>(problem.inertia, down), {0, 0, 0}};
      const auto at = orbit_at(*problem.orbit, t);
      return {at.gradient * gradient_shape<Scalar>(problem.inertia, to_body(at.radial)), {0, 0, 0}};
    }
    case TorqueType::magnetic:
      return {cross<Scalar>(torque.vector, to_body(field_at(problem, t).flux_density)), {0, 0, 0}};
    case TorqueType::eddy_current: {
      const auto field = field_at(problem, t);
      const Vec3<Scalar> B = to_body(field.flux_density);
      const Vec3<Scalar> seen = cross<Scalar>(w, B) - to_body(field.rate);  // w_rel x B
      return {cross<Scalar>(Vec3<Scalar>(torque.matrix * seen), B), {0, 0, 0}};
    }
    case TorqueType::thrust: {
      const Vec3<Scalar> force = turned(torque.vector);
      if (problem.fixed) return {cross<Scalar>(torque.point, force), {0, 0, 0}};
      return {cross<Scalar>(Vec3<Scalar>(torque.point - problem.centre_of_mass), force), force};
    }
    case TorqueType::charge: return {cross<Scalar>(w, torque.vector), {0, 0, 0}};
  }
  return {};
}

}  // namespace detail

/// All external torques and forces at t. Brakes whose momentum is zero take up the others as far as they can (holding.hpp). inside: a time in
/// the piece between two breakpoints whose laws are meant; t itself for what holds from t on.
template <Real Scalar>
Load<Scalar> load_at(const Problem<Scalar>& problem, const Pose<Scalar>& pose, Scalar t, Scalar inside) noexcept {
  Load<Scalar> sum;
  Vec3<Scalar> holding(0, 0, 0);
  for (const Torque<Scalar>& torque : problem.torques) {
    const Scalar factor = detail::factor_at(torque.factor, t, inside);
    if (factor == 0) continue;
    if (torque.type == TorqueType::brake && detail::opposed_by(problem, torque, pose).isZero(0)) {
      holding += factor * torque.vector;
      continue;
    }
    const Load<Scalar> one = detail::load_of(problem, torque, pose, t, inside);
    sum.torque += factor * one.torque;
    sum.force += factor * one.force;
  }
  if (!holding.isZero(0)) sum.torque += torque_at_rest<Scalar>(holding, sum.torque);
  return sum;
}

/// A state as numbers: attitude (w, x, y, z), M (3), p of each wheel (of those that turn by themselves), their angles, velocity and
/// position of the mass centre.
template <Real Scalar>
struct Flow {
  static constexpr std::size_t attitude = 0, momentum = 4, wheel = 8, angle = 16, velocity = 24, position = 27,
                               width = 30;
  using Numbers = std::array<Scalar, width>;

  Flow(const Problem<Scalar>& of, const Wheels<Scalar>& with) noexcept : problem(of), wheels(with) {}

  const Problem<Scalar>& problem;
  const Wheels<Scalar>& wheels;
  Scalar inside = 0;  ///< a time in the piece between two breakpoints that is integrated

  Numbers start() const noexcept {
    Numbers y{};
    const auto& q = problem.attitude;
    y[0] = q.w, y[1] = q.x, y[2] = q.y, y[3] = q.z;
    Vec3<Scalar> M = wheels.reduced * problem.angular_velocity + wheels.momentum_of_wheels();
    put(y, momentum, M);
    if (!problem.fixed) put(y, velocity, problem.velocity), put(y, position, problem.position);
    for (std::size_t i = 0; i < wheels.count; ++i) {
      y[wheel + i] = wheels.laws[i].momentum;
      y[angle + i] = wheels.laws[i].angle;
    }
    return y;
  }

  Vec3<Scalar> angular_velocity(Scalar t, const Numbers& y) const noexcept {
    Vec3<Scalar> G = get(y, momentum) - wheels.rotor_momentum;
    for (std::size_t i = 0; i < wheels.count; ++i) {
      const auto& law = wheels.laws[i];
      if (law.turns_by_itself()) G -= y[wheel + i] * law.axis;
      if (law.follows == Follows::rate && law.tabled)
        G -= law.axial_inertia * rotor_rate(t, y, {0, 0, 0}, i) * law.axis;
    }
    return wheels.inverse * G;
  }

  Scalar rotor_rate(Scalar t, const Numbers& y, const Vec3<Scalar>& w, std::size_t i) const noexcept {
    const auto& law = wheels.laws[i];
    if (law.turns_by_itself()) return y[wheel + i] / law.axial_inertia - law.axis.dot(w);
    return law.tabled ? piece(problem.wheels[i].table, 1, 0, inside)(t) : law.rate;
  }

  /// dy/dt
  void operator()(Scalar t, const Numbers& y, Numbers& rate) const noexcept {
    const Quat<Scalar> q{y[0], y[1], y[2], y[3]};
    const Vec3<Scalar> w = angular_velocity(t, y), M = get(y, momentum);
    const auto load = load_at(problem, Pose<Scalar>{normalised(q), w, M}, t, inside);
    const Quat<Scalar> turning = quaternion_rate<Scalar>(q, w);
    rate = {turning.w, turning.x, turning.y, turning.z};
    put(rate, momentum, cross<Scalar>(M, w) + load.torque);
    for (std::size_t i = 0; i < wheels.count; ++i) {
      const auto& law = wheels.laws[i];
      rate[angle + i] = rotor_rate(t, y, w, i);
      if (!law.turns_by_itself()) continue;
      rate[wheel + i] = law.torque - law.friction * rate[angle + i];
      if (law.tabled) rate[wheel + i] += piece(problem.wheels[i].table, 1, 0, inside)(t);
    }
    if (problem.fixed) return;
    put(rate, velocity,
        rotate<Scalar>(normalised(q), load.force) / problem.mass + problem.field.gravity * problem.field.down);
    put(rate, position, get(y, velocity));
  }

  State<Scalar> state(Scalar t, const Numbers& y) const noexcept {
    State<Scalar> made;
    made.attitude = normalised(Quat<Scalar>{y[0], y[1], y[2], y[3]});
    made.angular_velocity = angular_velocity(t, y);
    made.angular_momentum = get(y, momentum);
    for (std::size_t i = 0; i < wheels.count; ++i) {
      made.rotor_rate[i] = rotor_rate(t, y, made.angular_velocity, i);
      made.rotor_angle[i] = y[angle + i];
    }
    made.velocity = get(y, velocity), made.position = get(y, position);
    const Vec3<Scalar>&w = made.angular_velocity, &w0 = problem.angular_velocity;
    made.work = Vec3<Scalar>(w - w0).dot(wheels.reduced * Vec3<Scalar>(w + w0)) / 2;
    for (std::size_t i = 0; i < wheels.count; ++i) {
      const auto& law = wheels.laws[i];
      if (!law.turns_by_itself()) continue;
      const Scalar p = y[wheel + i], p0 = law.momentum;
      made.work += (p - p0) * (p + p0) / (2 * law.axial_inertia);
    }
    const Vec3<Scalar> M0 = wheels.reduced * w0 + wheels.momentum_of_wheels();
    made.impulse = rotate<Scalar>(made.attitude, made.angular_momentum) - rotate<Scalar>(problem.attitude, M0);
    return made;
  }

 private:
  static Vec3<Scalar> get(const Numbers& y, std::size_t from) noexcept { return {y[from], y[from + 1], y[from + 2]}; }
  static void put(Numbers& y, std::size_t from, const Vec3<Scalar>& v) noexcept {
    for (int i = 0; i < 3; ++i) y[from + std::size_t(i)] = v[i];
  }
};

#ifdef GYROSTAT_COMPILED
extern template Load<double> load_at<double>(const Problem<double>&, const Pose<double>&, double, double) noexcept;
#endif

}  // namespace gyrostat::general
