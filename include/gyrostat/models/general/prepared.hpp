// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/piece.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/settling.hpp"
#include "gyrostat/models/general/sizes.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A problem prepared for its full equations, by Taylor series or collocation, and the numbers of its state.
namespace gyrostat::general {

/// Body, wheels and torques, prepared once for all pieces.
template <Real Scalar>
struct Prepared {
  const Problem<Scalar>& problem;
  Wheels<Scalar> wheels;
  Collected<Scalar> torques;
  Settling<Scalar> settling;
  Vec3<Scalar> momentum{0, 0, 0};  ///< M at t = 0
  Scalar span = 0;                 ///< s
  Sizes<Scalar> sizes;

  /// A problem that check() finds right, for the times from 0 to `span`.
  Prepared(const Problem<Scalar>& of, Scalar span_) noexcept
      : problem(of),
        wheels(Wheels<Scalar>::of(of)),
        torques(Collected<Scalar>::of(of, span_)),
        settling(wheels),
        span(span_) {
    momentum = wheels.reduced * of.angular_velocity + wheels.momentum_of_wheels();
    sizes = sizes_of(of, wheels, torques, span);
  }
  /// Whether wheels settle so much faster than everything else changes, and for so long, that Taylor steps, which cannot be longer than about 8 over
  /// their rate, cost more than collocation.
  bool is_stiff() const noexcept {
    const Scalar fastest = settling.fastest(), pace = sizes.turning + sizes.forcing + sizes.damping;
    return fastest > 30 * pace && fastest * span > 1000;
  }
  /// Whether the full equations need the state with wheels and path.
  bool is_large() const noexcept {
    return settling.count > 0 ||
           std::any_of(torques.records.begin(), torques.records.end(), [](const auto& record) noexcept {
             return !record.sum.force_body.isZero(0) || !record.sum.force_inertial.isZero(0);
           });
  }
};

/// The numbers of a state: (w, x, y, z | M1, M2, M3, - | W1, W2, W3, -), W the integral of the angular velocity, and in the large one the
/// momenta and angles of wheels whose p is a state, by fours, and what forces have given to velocity and position:
/// (p of 0 to 3 | angles of 0 to 3 | p of 4 to 7 | angles of 4 to 7 | v1, v2, v3, - | x1, x2, x3, -).
template <bool large>
struct Places {
  static constexpr int attitude = 0, momentum = 4, turned = 8, velocity = 28, position = 32;
  static constexpr int width = large ? 36 : 12;
  /// p and angle of a wheel.
  static constexpr std::size_t wheel(std::size_t i) noexcept { return 12 + 8 * (i / 4) + i % 4; }
  static constexpr std::size_t angle(std::size_t i) noexcept { return wheel(i) + 4; }
};

/// The numbers of the state at t = 0, in the order of Places, SI.
template <Real Scalar, bool large>
std::array<Scalar, Places<large>::width> first_numbers(const Prepared<Scalar>& from) noexcept {
  using At = Places<large>;
  std::array<Scalar, At::width> x{};
  const auto& q = from.problem.attitude;
  x[0] = q.w, x[1] = q.x, x[2] = q.y, x[3] = q.z;
  for (std::size_t i = 0; i < 3; ++i) x[At::momentum + i] = from.momentum[int(i)];
  if constexpr (large)
    for (std::size_t i = 0; i < from.wheels.count; ++i) {
      const auto& law = from.wheels.laws[i];
      if (law.follows != Follows::state) continue;
      x[At::wheel(i)] = law.momentum;
      x[At::angle(i)] = law.angle;
    }
  return x;
}

/// What steps measure errors against: 1 for the quaternion and W (rad), the size of the momenta for M, of each wheel's own for p, and for v what forces
/// add in the time of a radian.
template <Real Scalar, bool large>
std::array<Scalar, Places<large>::width> scale_of(const Prepared<Scalar>& of) noexcept {
  using std::abs;
  using At = Places<large>;
  const Sizes<Scalar>& sizes = of.sizes;
  // where nothing moves any scale will do, but zero would leave the component out
  const auto positive = [](Scalar size) noexcept { return size > 0 ? size : Scalar(1); };
  const Scalar M = positive(std::max(sizes.momenta, sizes.built / 64));
  std::array<Scalar, At::width> made{1, 1, 1, 1, M, M, M, 0, 1, 1, 1, 0};
  if constexpr (large) {
    for (std::size_t i = 0; i < of.wheels.count; ++i) {
      const auto& law = of.wheels.laws[i];
      if (law.follows != Follows::state) continue;
      const Scalar push = abs(law.torque), driven = std::min(law.axial_inertia * push / law.friction, push * of.span);
      made[At::wheel(i)] = positive(abs(law.momentum) + driven + std::min(M, law.axial_inertia * M / sizes.least));
    }
    const Scalar time = sizes.turning > 0 ? std::min(of.span, 1 / sizes.turning) : of.span;
    for (std::size_t i = 0; i < 3; ++i) made[At::velocity + i] = sizes.force / of.problem.mass * time;
  }
  return made;
}

/// The state that numbers at t mean by the laws of a piece, without the torque.
template <Real Scalar, bool large>
State<Scalar> state_of(const Prepared<Scalar>& of, const Piece<Scalar>& piece, Scalar t, const Scalar* x) noexcept {
  using At = Places<large>;
  const auto& wheels = of.wheels;
  const Scalar s = t - piece.from;
  State<Scalar> made;
  made.attitude = normalised(Quat<Scalar>{x[0], x[1], x[2], x[3]});
  const Vec3<Scalar> M(x[4], x[5], x[6]), turned(x[8], x[9], x[10]);
  made.angular_momentum = M;
  Vec3<Scalar> G = M - piece.momentum_at(t);
  if constexpr (large)
    for (std::size_t i = 0; i < wheels.count; ++i)
      if (wheels.laws[i].follows == Follows::state) G -= x[At::wheel(i)] * wheels.laws[i].axis;
  const Vec3<Scalar> w = wheels.inverse * G, w0 = of.problem.angular_velocity;
  made.angular_velocity = w;
  made.work = Vec3<Scalar>(w - w0).dot(wheels.reduced * Vec3<Scalar>(w + w0)) / 2;
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    if (law.follows == Follows::body) {
      made.rotor_angle[i] = law.angle;
      continue;
    }
    const Scalar I = law.axial_inertia, own = piece.wheels[i].at(s);
    if (law.follows == Follows::state) {
      made.rotor_rate[i] = x[At::wheel(i)] / I - law.axis.dot(w);
      made.rotor_angle[i] = x[At::angle(i)];
      made.work += (x[At::wheel(i)] - law.momentum) * (x[At::wheel(i)] + law.momentum) / (2 * I);
      continue;
    }
    const Scalar integral = piece.wheels[i].integral + (piece.wheels[i].lost + piece.wheels[i].gained(s) / I);
    const bool held = law.follows == Follows::rate;
    made.rotor_rate[i] = own / I - (held ? Scalar(0) : law.axis.dot(w));
    made.rotor_angle[i] = law.angle + (integral - (held ? Scalar(0) : law.axis.dot(turned)));
    if (law.follows == Follows::integral) made.work += (own - law.momentum) * (own + law.momentum) / (2 * I);
  }
  made.impulse = rotate<Scalar>(made.attitude, M) - rotate<Scalar>(of.problem.attitude, of.momentum);
  if (of.problem.fixed) return made;
  const Vec3<Scalar> gravity = of.problem.field.gravity * of.problem.field.down;
  made.velocity = of.problem.velocity + t * gravity;
  made.position = of.problem.position + t * (of.problem.velocity + t / 2 * gravity);
  if constexpr (large) {
    const Scalar *v = x + At::velocity, *way = x + At::position;
    made.velocity += Vec3<Scalar>(v[0], v[1], v[2]);
    made.position += Vec3<Scalar>(way[0], way[1], way[2]);
  }
  return made;
}

}  // namespace gyrostat::general
