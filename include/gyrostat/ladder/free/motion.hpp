// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"

/// What the family `free` gives: its tables.
namespace gyrostat::free {

/// Places in column_kinds.
namespace column {
enum : std::size_t { attitude, angular_velocity, angular_momentum, rotor_rate, rotor_angle };
}

inline constexpr ColumnKind column_kinds[] = {
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity of the body, body axes"},
    {"angular_momentum", 3, "N m s", Frame::body, Measure::relative, "total angular momentum, body axes",
     "the momentum of the wheels at t = 0, over a thousand"},
    {"rotor_rate", per_rotor, "rad/s", Frame::none, Measure::relative,
     "rates of the wheels relative to the body, in the order of the scene; of scenes with wheels",
     "a thousandth of the greatest rate of body and wheels at t = 0"},
    {"rotor_angle", per_rotor, "rad", Frame::none, Measure::relative,
     "angles of the wheels in the body, from 0 at t = 0; of scenes with wheels", "0.001 rad"},
};

inline constexpr const char* kind_words[] = {"about-largest", "about-smallest", "one-component",
                                             "separatrix",    "steady",         "spherical"};

/// Places in scalar_kinds.
namespace scalar {
enum : std::size_t {
  kind,
  period,
  turn_per_period,
  modulus_squared,
  energy,
  angular_momentum_norm,
  angular_momentum_inertial,
  mean_angular_velocity,
  precession_rate,
  spin_rate,
  flip_interval,
  view_fraction,
  view_cosine,
};
}

inline constexpr ScalarKind scalar_kinds[] = {
    {"kind", 1, "", Frame::none, Measure::none,
     "what the motion is: about-largest or about-smallest (M surrounds that axis, with wheels one that may lie apart), "
     "one-component, separatrix, steady, spherical",
     gyrostat::Kind::word, kind_words},
    {"period", 1, "s", Frame::none, Measure::relative,
     "of the angular velocity in the body; infinite on a separatrix, None in a steady rotation"},
    {"turn_per_period", 1, "rad", Frame::none, Measure::absolute,
     "rotation of the body about the angular momentum after one period, in (-pi, pi]"},
    {"modulus_squared", 1, "1", Frame::none, Measure::absolute, "k2 of the elliptic functions; 1 on a separatrix"},
    {"energy", 1, "J", Frame::none, Measure::relative,
     "omega.J omega/2, wheels that turn freely left out of J; constant"},
    {"angular_momentum_norm", 1, "N m s", Frame::none, Measure::relative, "constant"},
    {"angular_momentum_inertial", 3, "N m s", Frame::inertial, Measure::relative, "total angular momentum, constant"},
    {"mean_angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "mean over a period"},
    {"precession_rate", 1, "rad/s", Frame::none, Measure::relative,
     "mean rate at which the axis that M surrounds, or that of symmetry, goes round M; of a steady rotation and of one "
     "component without symmetry None"},
    {"spin_rate", 1, "rad/s", Frame::none, Measure::relative,
     "mean rate of the body about that axis, relative to the plane of axis and M; the axis as M points on the average"},
    {"flip_interval", 1, "s", Frame::none, Measure::relative,
     "time between two flips of the middle axis, half a period; None with wheels or rotor momentum, and in steady "
     "rotations"},
    {"view_fraction", 1, "1", Frame::none, Measure::absolute,
     "share of a long time in which view.axis is within view.half_angle of view.direction"},
    {"view_cosine", 1, "1", Frame::none, Measure::absolute,
     "mean over a long time of the cosine between view.axis and view.direction, where that is positive"},
};

/// Places in warning_kinds.
namespace warning {
enum : std::size_t { phase_unknown, near_separatrix, unstable_rotation, not_realisable };
}

inline constexpr WarningKind warning_kinds[] = {
    {"phase-unknown",
     "the data, each good to one rounding, do not fix the phase of the motion up to the last time; period and energy "
     "keep their meaning; "
     "last time, s"},
    {"near-separatrix",
     "the motion passes close by an unstable rotation: a rounding of the data moves the time of each passage; 1 - k2"},
    {"unstable-rotation",
     "the body stands on an unstable steady rotation: it leaves it by whatever disturbs it; growth rate, 1/s"},
    {"not-realisable",
     "no body with this inertia can hold these wheels: the equations are solved as they stand; least second moment "
     "that is left for the body, kg m^2"},
};

/// Places in rung_kinds, cheapest first.
namespace rung {
enum : int { closed_form, full };
}

inline constexpr RungKind rung_kinds[] = {
    {"closed-form", "rates and attitude in closed form: a pair of theta functions"},
    {"full", "the full equations"},
};

inline constexpr const char* integrator_names[] = {"taylor"};

inline constexpr Family tables{"free", column_kinds, scalar_kinds, warning_kinds, rung_kinds, integrator_names};

template <Real Scalar>
using ColumnErrors = Errors<std::size(column_kinds), Scalar>;

}  // namespace gyrostat::free
