// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/free/motion.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"

/// What the family `general` gives: its tables. Its rungs are those of the families that a scene may be an instance of, and the full equations.
namespace gyrostat::general {

/// Places in column_kinds.
namespace column {
enum : std::size_t {
  attitude,
  angular_velocity,
  angular_momentum,
  angular_momentum_inertial,
  angular_momentum_norm,
  energy,
  rotor_rate,
  rotor_angle,
  velocity,
  position,
  down,
  attitude_orbit,
  torque,
  euler,
};
}

inline constexpr ColumnKind column_kinds[] = {
    {"attitude", 4, "1", Frame::body_to_inertial, Measure::angle, "attitude, body to inertial, [x, y, z, w]"},
    {"angular_velocity", 3, "rad/s", Frame::body, Measure::relative, "angular velocity of the body, body axes",
     "|omega| at t = 0; where it vanishes, a thousandth of what the momenta of the wheels would turn the whole with, "
     "over its greatest moment"},
    {"angular_momentum", 3, "N m s", Frame::body, Measure::relative, "total angular momentum, body axes",
     "a thousandth of the momenta of body and wheels at t = 0, which may cancel"},
    {"angular_momentum_inertial", 3, "N m s", Frame::inertial, Measure::relative,
     "total angular momentum, inertial axes", "that of angular_momentum"},
    {"angular_momentum_norm", 1, "N m s", Frame::none, Measure::relative, "size of the total angular momentum",
     "that of angular_momentum"},
    {"energy", 1, "J", Frame::none, Measure::relative,
     "omega.J* omega/2 + sum p^2/(2 I): of the body, held wheels locked in it, and of the other wheels",
     "a thousandth of what the momenta of body and wheels at t = 0 would have in the greatest moment"},
    {"rotor_rate", per_rotor, "rad/s", Frame::none, Measure::relative,
     "rates of the wheels relative to the body, in the order of the scene; of scenes with wheels",
     "a thousandth of the greatest rate of body and wheels at t = 0"},
    {"rotor_angle", per_rotor, "rad", Frame::none, Measure::relative,
     "angles of the wheels in the body; of scenes with wheels", "0.001 rad"},
    {"velocity", 3, "m/s", Frame::inertial, Measure::relative,
     "velocity of the mass centre of a free body, inertial axes, beside that of its orbit",
     "the velocity at t = 0, and what gravity adds"},
    {"position", 3, "m", Frame::inertial, Measure::relative,
     "position of the mass centre of a free body, inertial axes, beside that on its orbit",
     "the position at t = 0, and the way at the velocity of t = 0 and under gravity"},
    {"down", 3, "1", Frame::body, Measure::relative,
     "unit vector along gravity, body axes; of scenes with a weight or a gradient that stands still", "1"},
    {"attitude_orbit", 4, "1", Frame::body_to_orbit, Measure::angle,
     "attitude, body to the axes of the orbit: x along it, y against its normal, z to the centre; of scenes with an "
     "orbit"},
    {"torque", 3, "N m", Frame::body, Measure::relative, "external torque, body axes",
     "a thousandth of the sizes of all torques at t = 0, or a millionth of what they may come to"},
    {"euler", 3, "rad", Frame::body_to_inertial, Measure::absolute,
     "angles of the attitude in the sequence solve.euler, in its order; first and last count turns; of scenes with "
     "that "
     "key"},
};

/// What columns are made of.
namespace primitive {
enum : std::size_t {
  attitude,
  angular_velocity,
  angular_momentum,
  rotor_rate,
  rotor_angle,
  velocity,
  position,
  count,
};
}

/// What each column is made of, in the order of column_kinds.
inline constexpr ColumnSet made_of[] = {
    column_set(primitive::attitude),
    column_set(primitive::angular_velocity),
    column_set(primitive::angular_momentum),
    column_set(primitive::attitude, primitive::angular_momentum),
    column_set(primitive::angular_momentum),
    column_set(primitive::angular_velocity, primitive::rotor_rate),
    column_set(primitive::rotor_rate),
    column_set(primitive::rotor_angle),
    column_set(primitive::velocity),
    column_set(primitive::position),
    column_set(primitive::attitude),
    column_set(primitive::attitude),
    column_set(primitive::attitude, primitive::angular_velocity, primitive::angular_momentum),
    column_set(primitive::attitude),
};
static_assert(std::size(made_of) == std::size(column_kinds));

/// Places in scalar_kinds.
namespace scalar {
enum : std::size_t { recognised, stop_time, energy_balance, momentum_balance, work_torques, work_motors };
}

/// Families that a scene may be found to be an instance of, in the order in which they are looked for.
enum class Special : std::uint8_t { free, deceleration, heavy, rotor, spinning, none };
inline constexpr std::size_t specials = 5;
inline constexpr const Family* special_tables[specials] = {&free::tables, &deceleration::tables, &heavy::tables,
                                                           &rotor::tables, &spinning::tables};
inline constexpr const char* special_words[specials] = {"free", "deceleration", "heavy", "rotor", "spinning"};

inline constexpr ScalarKind scalar_kinds[] = {
    {"recognised", 1, "", Frame::none, Measure::none, "families of which the scene is exactly an instance",
     gyrostat::Kind::words, special_words},
    {"stop_time", 1, "s", Frame::none, Measure::relative,
     "time from the start on after which a brake has first stopped the body, and holds it"},
    {"energy_balance", 1, "1", Frame::none, Measure::none,
     "of the full equations: change of the energy up to the last time less the integral of all power, over that of its "
     "size"},
    {"momentum_balance", 1, "1", Frame::none, Measure::none,
     "of the full equations: the same of momentum, inertial axes, and torque"},
    {"work_torques", 1, "J", Frame::none, Measure::relative,
     "of the full equations: work of the external torques up to the last time; its error, as that of work_motors, is "
     "relative to all energy and work, for works may cancel"},
    {"work_motors", 1, "J", Frame::none, Measure::relative,
     "of the full equations: work of motors and bearings up to the last time, that of a motor which changes a held "
     "rate "
     "among it, not what one takes to hold it"},
};

/// Places in warning_kinds.
namespace warning {
enum : std::size_t {
  not_realisable,
  driven_damping,
  eddy_not_positive,
  beyond_no_load,
  start_uncertain,
  gimbal_lock,
  turns_untold,
  custom_smooth,
  stiff,
  rest,
  orbit_mismatch,
  inside_planet,
  wide_in_orbit,
  torque_outruns,
  held_table_ends,
  brakes_wheels,
  chaotic,
  with_rounding
};
}

inline constexpr WarningKind warning_kinds[] = {
    {"not-realisable",
     "no body with this inertia can hold these wheels: the equations are solved as they stand; least second moment "
     "that is left for the body, kg m^2"},
    {"driven-damping", "a damping matrix has a negative symmetric part: it drives the body; its least eigenvalue is"},
    {"eddy-not-positive",
     "the matrix of the eddy currents has a negative symmetric part: they drive the body; its least eigenvalue is"},
    {"wheel-beyond-no-load", "a wheel starts faster than its motor turns it without load: the motor brakes it; rad/s"},
    {"start-uncertain",
     "what the error of the start makes of the answer is over the tolerance: ask for the scene that it comes from more "
     "precisely; times the tolerance"},
    {"gimbal-lock",
     "the second of the angles comes so near to where the first and the last turn are about one axis that they "
     "cannot be told apart; distance, rad"},
    {"turns-untold",
     "the body may turn by more than half a turn from one asked time to the next: whole turns of the angles between "
     "them are not told; at most, rad"},
    {"custom-smooth",
     "no times are named at which the torque of your own jumps or has kinks: it is taken to be smooth, and what is "
     "shorter than a step, as a pulse, goes unseen"},
    {"stiff",
     "wheels settle so much faster than the body turns that the equations are solved by collocation (Radau IIA); "
     "greatest rate of settling, 1/s"},
    {"rest", "a brake has stopped the body and holds it against all other torques; first so long after the start, s"},
    {"orbit-mismatch",
     "the gravity gradient that is given is none of the orbit, 3 mu/r^3: it is greater by a share of"},
    {"inside-planet",
     "the orbit goes below a hundredth of its planet's radius above the surface: height of its lowest point, m"},
    {"wide-in-orbit",
     "the gravity gradient is that of a body that is small against its orbit: its torque errs by a share of about the "
     "size of the body over the radius of the orbit, which is"},
    {"torque-outruns",
     "torques that come and go bring the body to more than a thousand times the rate that it starts with; times"},
    {"held-table-ends",
     "the table of the rate at which a wheel is held ends before the last time: the wheel stands still after it, and "
     "the body takes up its momentum at once; first so long after the start, s"},
    {"brakes-wheels",
     "a torque opposes the whole angular momentum, that of wheels and rotor in it: where that is gone the body turns "
     "on against them, at so many rad/s as they run at the start"},
    {"chaotic",
     "motions that start closer than any data part far faster than in proportion to the time: the motion is chaotic, "
     "or "
     "passes by an unstable one; greater than in proportion by a factor of"},
    {"recognised-with-rounding",
     "the scene is an instance of the family that answers but for roundings, which were dropped; the greatest, in "
     "roundings of 2e-16"},
    {gyrostat::warning_of_family, "in sweeps: the family that the scene was recognised as warns of something"},
};

/// A rung of the ladder is one of a family, or the full equations of the family `general`.
struct SpecialRung {
  Special special;
  int rung;  ///< its place in the table of that family
};

/// Places in rung_kinds: of the first full equations of a family, and of the rungs that are of no family.
namespace rung {
enum : int { family_full = 11, segments = 16, full = 17 };
}

inline constexpr SpecialRung special_rungs[] = {
    {Special::free, free::rung::closed_form},
    {Special::deceleration, deceleration::rung::equal_torque},
    {Special::heavy, heavy::rung::exact},
    {Special::rotor, rotor::rung::closed_form},
    {Special::spinning, spinning::rung::linear},
    {Special::heavy, heavy::rung::series_2},
    {Special::heavy, heavy::rung::series},
    {Special::deceleration, deceleration::rung::averaged},
    {Special::spinning, spinning::rung::second_order},
    {Special::deceleration, deceleration::rung::averaged_2},
    {Special::rotor, rotor::rung::linear_tail},
    {Special::free, free::rung::full},
    {Special::deceleration, deceleration::rung::full},
    {Special::heavy, heavy::rung::full},
    {Special::rotor, rotor::rung::full},
    {Special::spinning, spinning::rung::full},
    {Special::none, rung::segments},
    {Special::none, rung::full},
};

/// Columns that turn with the body.
inline constexpr ColumnSet phase_columns = column_set(
    column::attitude, column::angular_velocity, column::angular_momentum, column::angular_momentum_inertial,
    column::rotor_rate, column::rotor_angle, column::down, column::attitude_orbit, column::torque, column::euler);
/// Columns that need the attitude.
inline constexpr ColumnSet oriented_columns = column_set(column::attitude, column::angular_momentum_inertial,
                                                         column::down, column::attitude_orbit, column::euler);

inline constexpr RungKind rung_kinds[] = {
    {"free:closed-form", "no torque: a pair of theta functions"},
    {"deceleration:equal-torque", "one braking torque for all axes: the free motion in a slower clock"},
    {"heavy:exact", "a weight or a field that stands still: closed forms and quadratures"},
    {"rotor:closed-form", "a body with one driven wheel on an axis of symmetry, or at rest in its steady rotation"},
    {"spinning:linear", "constant torque and thrust on a spinning body, small tilt: closed form"},
    {"heavy:series-2", "a fast spin under weight: the forced motion to second order"},
    {"heavy:series", "a fast spin under weight: the forced motion by its series"},
    {"deceleration:averaged", "brake and drag averaged over the free motion: slow columns only", phase_columns},
    {"spinning:second-order", "constant torque and thrust on a spinning body, to the next order in the tilt"},
    {"deceleration:averaged-2", "brake and drag averaged to second order",
     oriented_columns | column_set(column::torque)},
    {"rotor:linear-tail", "one driven wheel, near the steady rotation that the motion tends to"},
    {"free:full", "the full equations of that family"},
    {"deceleration:full", "the full equations of that family"},
    {"heavy:full", "the full equations of that family"},
    {"rotor:full", "the full equations of that family"},
    {"spinning:full", "the full equations of that family"},
    {"segments", "between times at which torques or wheels change, each by the rungs of a family"},
    {"full", "the full equations of body, wheels and all torques"},
};
static_assert(std::size(special_rungs) == std::size(rung_kinds) && special_rungs[rung::full].special == Special::none);
static_assert(special_rungs[rung::family_full].rung == free::rung::full);

inline constexpr const char* integrator_names[] = {"taylor", "radau", "dop853", "cvode"};

/// Columns that an answer lacks where nobody asks for them.
inline constexpr ColumnSet unasked_columns = column_set(
    column::angular_momentum, column::angular_momentum_inertial, column::angular_momentum_norm, column::energy,
    column::velocity, column::position, column::down, column::attitude_orbit, column::torque);

inline constexpr std::size_t asked_scalars[] = {scalar::stop_time};

inline constexpr Family tables{"general",  column_kinds,     scalar_kinds,    warning_kinds,
                               rung_kinds, integrator_names, unasked_columns, asked_scalars};

using ColumnErrors = Errors<std::size(column_kinds)>;

}  // namespace gyrostat::general
