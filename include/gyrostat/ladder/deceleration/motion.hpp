// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/models/deceleration/problem.hpp"
#include "gyrostat/models/deceleration/regime.hpp"
#include "gyrostat/rotation/quaternion.hpp"

/// What the family `deceleration` gives: its tables, and the row of columns of a state.
namespace gyrostat::deceleration {

/// Places in column_kinds.
namespace column {
enum : std::size_t {
  angular_momentum,
  angular_velocity,
  angular_momentum_norm,
  energy,
  modulus_squared,
  regime,
  attitude,
};
}

/// Symbols of the regimes, in the order of Regime.
inline constexpr std::array regime_words{
    symbol(Regime::about_largest), symbol(Regime::about_smallest), symbol(Regime::one_component),
    symbol(Regime::point),         symbol(Regime::separatrix),     symbol(Regime::rest),
};

inline constexpr ColumnKind column_kinds[] = {
    {"angular_momentum", 3, "N m s", Frame::body, Measure::relative, "total angular momentum, body axes",
     "|M| at t = 0; where carrier and rotors cancel there, |l|"},
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity of the carrier, body axes",
     "|omega| at t = 0; where it is zero there, |J^-1 l|"},
    {"angular_momentum_norm", 1, "N m s", Frame::none, Measure::relative, "size of the total angular momentum",
     "that of angular_momentum"},
    {"energy", 1, "J", Frame::none, Measure::relative, "rotational energy of the carrier",
     "the energy at t = 0; where the carrier is at rest there, l . J^-1 l/2"},
    {"modulus_squared", 1, "1", Frame::none, Measure::absolute, "squared modulus of the orbit, k2"},
    {"regime", 1, "", Frame::none, Measure::none,
     "A: about the axis of largest inertia, C: about the smallest, 1: one component, point, separatrix, rest", "",
     Kind::word, regime_words},
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
};

/// Places in scalar_kinds.
namespace scalar {
enum : std::size_t { stop_time, final_angular_velocity, small_parameter, separatrix_distance };
}

inline constexpr ScalarKind scalar_kinds[] = {
    {"stop_time", 1, "s", Frame::none, Measure::relative, "time at which the deceleration ends"},
    {"final_angular_velocity", 3, "rad/s", Frame::body, Measure::none, "angular velocity at the stop"},
    {"small_parameter", 1, "1", Frame::none, Measure::none, "rate of damping over rate of rotation"},
    {"separatrix_distance", 1, "1", Frame::none, Measure::none,
     "energy from the nearest separatrix at the start, over the range of energies at that |M|; without a value, or "
     "infinite: there is "
     "none"},
};

/// Places in warning_kinds.
namespace warning {
enum : std::size_t {
  no_control,
  does_not_stop,
  beyond_validity,
  not_slow,
  near_symmetric,
  near_separatrix,
  crosses_separatrix,
  sticks_to_separatrix,
  capture_undetermined,
  stop_withheld,
  stop_unknown,
};
}

inline constexpr WarningKind warning_kinds[] = {
    {"no-control", "no control torque acts: the motion decays at best, and never stops"},
    {"does-not-stop", "the law brings M to zero, not the carrier to rest: it ends turning at -J^-1 l"},
    {"beyond-validity",
     "the averaged equations do not hold here: the torque changes the motion as fast as the body turns, or the size of "
     "what they leave out is not known"},
    {"not-slow", "the torque stops the body within a few turns: averaging has no meaning"},
    {"near-symmetric", "two moments of inertia are nearly equal: the libration is slow"},
    {"near-separatrix", "the orbit starts near a separatrix"},
    {"crosses-separatrix", "the motion passes from one kind of orbit to another"},
    {"sticks-to-separatrix", "the separatrix attracts from both sides and holds the mean motion"},
    {"capture-undetermined",
     "after the asked times the motion goes one of two ways behind a separatrix, under a small torque the likelier one "
     "with this chance: no stop time"},
    {"stop-withheld",
     "the stop lies behind the times asked for and its time misses the tolerance; ask for times up to it"},
    {"stop-unknown", "after the asked times the equations do not reach the stop"},
};

/// Columns that turn with the body: what is asked for without them needs no phase.
inline constexpr ColumnSet fast_columns =
    column_set(column::angular_momentum, column::angular_velocity, column::attitude);

/// Places in rung_kinds, cheapest first.
namespace rung {
enum : int { equal_torque, averaged, averaged_2, full };
}

inline constexpr RungKind rung_kinds[] = {
    {"equal-torque", "one control torque for all axes and no rotor momentum: exact, the free motion in a slower clock"},
    {"averaged", "the torques averaged over the free motion, first order: slow columns only, not the phase",
     fast_columns},
    {"averaged-2", "averaged to second order, and so with the phase; the full equations take over near the stop",
     column_set(column::attitude)},
    {"full", "the full equations"},
};

inline constexpr const char* integrator_names[] = {"taylor", "cvode"};

inline constexpr std::size_t asked_scalars[] = {scalar::stop_time};

inline constexpr Family tables{"deceleration", column_kinds,     scalar_kinds, warning_kinds,
                               rung_kinds,     integrator_names, fast_columns, asked_scalars};

/// What is known of the motion at one time, in principal axes.
template <Real Scalar>
struct State {
  Vec3<Scalar> momentum{0, 0, 0};  ///< M, N m s
  Scalar norm = 0;                 ///< |M|
  Scalar energy = 0;               ///< of the carrier, J
  Scalar k2 = 0;                   ///< modulus squared of the free orbit
  Regime regime = Regime::rest;    ///< of the free orbit
  Quat<Scalar> attitude{};         ///< principal axes to inertial
};

template <Real Scalar>
using ColumnErrors = Errors<std::size(column_kinds), Scalar>;

/// The scales of the columns that a start sets, in their units. Where the start has none, but for rounding, the rotors set it.
template <Real Scalar>
ColumnErrors<Scalar> scales(const Problem<Scalar>& problem) noexcept {
  const Scalar rounding = std::sqrt(epsilon<Scalar>);
  const Scalar M = problem.momentum.norm(), l = problem.rotor_momentum.norm();
  const Scalar omega = problem.angular_velocity(problem.momentum).norm(), g = problem.gyro_rate().norm();
  const bool moves = omega > rounding * g;
  ColumnErrors<Scalar> scale;
  scale[column::angular_momentum] = scale[column::angular_momentum_norm] = M > rounding * l ? M : l;
  scale[column::angular_velocity] = moves ? omega : g;
  scale[column::energy] = moves ? problem.energy(problem.momentum) : problem.rotor_energy_scale() / 2;
  return scale;
}

/// Writes the columns of a state in the caller's axes, one behind the other: the one place that knows them.
template <Real S>
struct Row {
  using Scalar = S;
  using State = deceleration::State<S>;
  static constexpr const auto& columns = column_kinds;

  Problem<S> problem;
  Mat3<S> R_BP;  ///< principal axes to body axes
  Quat<S> q_PB;
  ColumnErrors<S> scale;

  explicit Row(const Problem<S>& of, const Mat3<S>& axes = Mat3<S>::Identity()) noexcept
      : problem(of), R_BP(axes), q_PB(conjugate(from_matrix(axes))), scale(scales(of)) {}

  void operator()(const State& state, S* row) const noexcept {
    const Vec3<S> M = R_BP * state.momentum, omega = R_BP * problem.angular_velocity(state.momentum);
    const Quat<S> q = normalised(state.attitude * q_PB);
    for (const S value : {M[0], M[1], M[2], omega[0], omega[1], omega[2], state.norm, state.energy, state.k2,
                          S(static_cast<int>(state.regime)), q.x, q.y, q.z, q.w})
      *row++ = value;
  }

  /// So many times |angular_velocity| as errors decrease faster than the body turns.
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return S(honesty::stop_fading_factor) * std::hypot(row[3], row[4], row[5]);
  }
  /// Momenta more than 120 degrees apart: beside a separatrix one has turned over, and the other may yet go the other way. At one late time both may
  /// be near again by chance.
  template <class Numbers>
  bool has_parted(const Numbers& a, const Numbers& b) const noexcept {
    const S along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return along < 0 &&
           4 * along * along > (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
  }
  static bool lasts(std::size_t place) noexcept {
    return place == column::angular_momentum || place == column::angular_velocity || place == column::attitude;
  }
};

}  // namespace gyrostat::deceleration
