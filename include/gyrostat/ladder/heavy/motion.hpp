// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/models/heavy/problem.hpp"

/// What the family `heavy` gives: its tables, and the row of columns of a state.
namespace gyrostat::heavy {

/// Places in column_kinds. The attitude, which may be left out, is the last.
namespace column {
enum : std::size_t { angular_velocity, down, attitude };
}

inline constexpr ColumnKind column_kinds[] = {
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity, body axes",
     "the greater of |omega| at t = 0, of a periodic motion its spin, and sqrt(M g l/I + N), I the greatest moment"},
    {"down", 3, "1", Frame::body, Measure::relative, "unit vector to the attracting centre, body axes", "1"},
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
};

/// Places in scalar_kinds.
namespace scalar {
enum : std::size_t { period, floquet_trace, stable, precession_rate };
}

inline constexpr ScalarKind scalar_kinds[] = {
    {"period", 1, "s", Frame::none, Measure::relative,
     "time after which rates and down return; None: not known to be periodic"},
    {"floquet_trace", 1, "1", Frame::none, Measure::absolute,
     "trace of the 6x6 monodromy minus 4: the sum of the two multipliers that are not one; stable between -2 and 2"},
    {"stable", 1, "", Frame::none, Measure::none,
     "whether small changes of a periodic motion stay small; None: not known", Kind::flag},
    {"precession_rate", 1, "rad/s", Frame::none, Measure::absolute,
     "mean turn about the vertical, right-handed about down"},
};

/// Places in warning_kinds.
namespace warning {
enum : std::size_t {
  rounding_decides,
  beyond_validity,
  slow_spin,
  strong_gradient,
  near_equal_moments_1,
  near_equal_moments_2,
  near_lamina,
  upright,
  resonance,
  unstable,
  unstable_sleep,
  unstable_balance,
  gradient,
  not_unique,
};
}

inline constexpr WarningKind warning_kinds[] = {
    {"rounding-decides",
     "before the last time rounding of the data has grown to the size of the motion (a separatrix, a start off the "
     "plane of a pendulum, chaos, or a very long time)"},
    {"beyond-validity", "the series for a fast spin do not hold: their error estimate means little; it is"},
    {"slow-spin",
     "the spin is below three times sqrt(M g l/C): series are poor, and below 0.6 to 2 times there is no such motion; "
     "the "
     "ratio is"},
    {"strong-gradient", "the gravity gradient is strong beside the spin; N/r0^2 is"},
    {"near-equal-moments-1", "moments 1 and 3 are nearly equal and the weight drives that resonance; 1 - A/C is"},
    {"near-equal-moments-2", "moments 2 and 3 are nearly equal and the weight drives that resonance; 1 - B/C is"},
    {"near-lamina",
     "the body is nearly a lamina across axis 3, whose free nutation keeps pace with the spin; A/C + B/C - 1 is"},
    {"upright", "axis 3 may pass near the vertical: its precession loses its meaning; the sine of its inclination is"},
    {"resonance",
     "the free nutation is near half the spin rate, where a parametric resonance may make it grow; they differ, over "
     "the spin, by"},
    {"unstable", "a free nutation beside this motion grows over a period by the factor"},
    {"unstable-sleep", "the top spins too slowly to stay upright: its tilt grows; the least spin that holds it, rad/s"},
    {"unstable-balance",
     "the body rests, or turns steadily about the vertical, where the weight makes that unstable: whatever disturbs it "
     "grows; growth rate, 1/s"},
    {"gradient",
     "gravity and gravity gradient belong to a centre at 3 g/N, which is not far beside the body's size: give them on "
     "purpose only; m"},
    {"not-unique",
     "another periodic motion with this spin and inclination may be near, as a free nutation about this one nearly "
     "stands still or keeps in step with it; the full equations give at every tolerance the one to which shooting from "
     "the motion of first order leads; nu^2 is"},
};

/// Places in rung_kinds, in the order in which the ladder is climbed.
namespace rung {
enum : int { exact, series_2, series, full };
}

inline constexpr RungKind rung_kinds[] = {
    {"exact", "closed forms and quadratures: no torque, symmetric tops, pendulums"},
    {"series-2", "a fast spin about axis 3: the forced motion to second order, with its free nutation to first order"},
    {"series", "a fast spin about axis 3: the forced motion by its series to the order that the tolerance needs"},
    {"full", "the full equations; of a periodic motion from the start that shooting finds"},
};

inline constexpr const char* integrator_names[] = {"taylor", "cvode"};

inline constexpr Family tables{
    "heavy", column_kinds, scalar_kinds, warning_kinds, rung_kinds, integrator_names, column_set(column::attitude)};

template <Real Scalar>
using ColumnErrors = Errors<std::size(column_kinds), Scalar>;

/// The scales of the columns, in their units. spin: |omega| at t = 0, of a periodic motion its spin, rad/s.
template <Real Scalar>
ColumnErrors<Scalar> scales(const Problem<Scalar>& problem, Scalar spin) noexcept {
  const Scalar slow = std::sqrt(problem.moment().norm() / problem.inertia().maxCoeff() + problem.gradient());
  return {std::max(std::abs(spin), slow), 1, 0};
}

/// Writes the columns of a state, one behind the other, in the axes of the state: the one place that knows them.
template <Real S>
struct Row {
  using Scalar = S;
  using State = heavy::State<S>;
  static constexpr const auto& columns = column_kinds;

  ColumnErrors<S> scale{};

  void operator()(const State& state, S* row) const noexcept {
    const auto& [w, d, q] = state;
    for (const S value : {w[0], w[1], w[2], d[0], d[1], d[2], q.x, q.y, q.z, q.w}) *row++ = value;
  }

  /// |angular_velocity|.
  template <class Numbers>
  S turning(const Numbers& row) const noexcept {
    return std::hypot(row[0], row[1], row[2]);
  }
  /// Two runs have nothing in common any more: where they meet again it is by chance.
  template <class Numbers>
  bool has_parted(const Numbers& a, const Numbers& b) const noexcept {
    S square = 0;
    for (std::size_t i = 3; i < 6; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return square > S(0.25L);
  }
};

}  // namespace gyrostat::heavy
