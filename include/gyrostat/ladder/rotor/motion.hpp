// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/models/rotor/gyrostat.hpp"

/// What the family `rotor` gives: its tables, and the row of columns of a state.
namespace gyrostat::rotor {

/// Places in column_kinds.
namespace column {
enum : std::size_t { attitude, angular_velocity, angular_momentum, rotor_rate, rotor_angle, lyapunov };
}

inline constexpr ColumnKind column_kinds[] = {
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity of the carrier, body axes",
     "what the momenta of carrier and rotor at t = 0 would turn the whole with, over its greatest moment"},
    {"angular_momentum", 3, "N m s", Frame::body, Measure::relative, "total angular momentum, body axes",
     "where |H| = 0: the sum of the sizes of the momenta of carrier and rotor at t = 0"},
    {"rotor_rate", 1, "rad/s", Frame::none, Measure::relative, "rate of the rotor relative to the carrier",
     "a thousandth of the greatest of the rates of carrier and rotor at t = 0 and the scale of angular_velocity"},
    {"rotor_angle", 1, "rad", Frame::none, Measure::relative, "angle of the rotor in the carrier, from 0 at t = 0",
     "0.001 rad"},
    {"lyapunov", 1, "J", Frame::none, Measure::relative,
     "Lyapunov function V: energy less no_load_rate times the rotor's axial momentum, plus a constant; it never grows",
     "the least rotational energy of the whole with the momenta of carrier and rotor at t = 0"},
};

/// Places in scalar_kinds.
namespace scalar {
enum : std::size_t { attractor, decay_rate };
}

inline constexpr ScalarKind scalar_kinds[] = {
    {"attractor", 1, "", Frame::none, Measure::none,
     "place of the steady rotation that the motion tends to, by level; None: not certified", Kind::place},
    {"decay_rate", 1, "1/s", Frame::none, Measure::none, "rate at which the motion comes to its attractor in the end"},
};

/// Places in warning_kinds.
namespace warning {
enum : std::size_t {
  leaves_closed_form,
  hand_over,
  not_realisable,
  no_motor,
  no_attractor,
  marginal,
  attractor_undecided,
  beyond_validity,
};
}

inline constexpr WarningKind warning_kinds[] = {
    {"leaves-closed-form",
     "body and start lie off the exact family by rounding or by the data, and before the last time the motion has left "
     "it; off by, relative"},
    {"hand-over", "the full equations were solved first; the linear tail goes on from, s"},
    {"not-realisable",
     "no mass distribution has this inertia and this rotor: tr(theta)/2 - theta - lambda/2 (1 - e e^T) has a negative "
     "eigenvalue, kg m^2"},
    {"no-motor", "the motor has no slope: nothing is dissipated and no steady rotation attracts"},
    {"no-attractor", "the body is symmetric about the rotor's axis: it precesses for ever"},
    {"marginal", "the rotor lies on a principal axis: the nutation dies out like 1/sqrt(t), at no exponential rate"},
    {"attractor-undecided",
     "two steady rotations attract and the motion has not chosen at the last time; V is above the lowest saddle by, J"},
    {"beyond-validity",
     "the start is far from the steady rotation on whose linear motion the answer goes on, and so may be drawn to "
     "another; distance, rad"},
};

/// Places in rung_kinds, cheapest first.
namespace rung {
enum : int { closed_form, linear_tail, full };
}

inline constexpr RungKind rung_kinds[] = {
    {"closed-form",
     "exact special cases: no momentum, symmetry about the rotor's axis, steady rotations, circular sections"},
    {"linear-tail", "near a steady rotation that attracts: the motion in closed form to second order in the distance"},
    {"full", "the full equations"},
};

inline constexpr const char* integrator_names[] = {"taylor", "radau", "cvode"};

inline constexpr Family tables{"rotor", column_kinds, scalar_kinds, warning_kinds, rung_kinds, integrator_names};

template <Real Scalar>
using ColumnErrors = Errors<std::size(column_kinds), Scalar>;

/// The scales of the columns that a start sets, in their units.
template <Real Scalar>
ColumnErrors<Scalar> scales(const Gyrostat<Scalar>& body, const State<Scalar>& start) noexcept {
  const Vec3<Scalar> Omega = body.angular_velocity(start.momentum, start.axial_momentum);
  const Scalar omega = std::abs(body.rotor_rate(start.axial_momentum, Omega));
  const Scalar momentum = (body.inertia() * Omega).norm() + body.axial_inertia() * omega;
  const Scalar rate = momentum / body.principal()[2];
  ColumnErrors<Scalar> made;
  made[column::angular_velocity] = rate;
  made[column::angular_momentum] = start.momentum.isZero(0) ? momentum : Scalar(0);
  // a rotor that creeps while the body turns fast is still measured by itself
  constexpr Scalar least = Scalar(1e-3L);
  made[column::rotor_rate] = least * std::max({Omega.norm(), omega, rate});
  made[column::rotor_angle] = least;
  made[column::lyapunov] = momentum * rate / 2;
  return made;
}

/// Writes the columns of a state, one behind the other: the one place that knows them.
template <Real S>
struct Row {
  using Scalar = S;
  using State = rotor::State<S>;
  static constexpr const auto& columns = column_kinds;

  Gyrostat<S> body;
  ColumnErrors<S> scale{};

  explicit Row(const Gyrostat<S>& of) noexcept : body(of) {}
  Row(const Gyrostat<S>& of, const State& start) noexcept : body(of), scale(scales(of, start)) {}

  void operator()(const State& state, S* row) const noexcept {
    const auto& [q, H, p, angle] = state;
    const Vec3<S> Omega = body.angular_velocity(H, p);
    for (const S value : {q.x, q.y, q.z, q.w, Omega[0], Omega[1], Omega[2], H[0], H[1], H[2], body.rotor_rate(p, Omega),
                          angle, body.lyapunov(H, p)})
      *row++ = value;
  }

  /// |angular_velocity|.
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return std::hypot(row[4], row[5], row[6]);
  }
};

}  // namespace gyrostat::rotor
