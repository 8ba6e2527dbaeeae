// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// One body, any wheels, any sum of torques (docs/general.md, section 1). With J the inertia of the whole, wheels locked, about the reference
/// point (the fixed point, or of a free body the mass centre), M the total angular momentum about it, and of wheel k the axis u_k, the axial
/// inertia I_k, the rate Om_k relative to the body and p_k = I_k (Om_k + u_k.w):
///     M = J w + sum I_k Om_k u_k + l,      dM/dt = M x w + tau,   dq/dt = q (0, w)/2,   dp_k/dt = T_k - c_k Om_k.
namespace gyrostat::general {

/// How many wheels a body can carry.
inline constexpr std::size_t most_wheels = 8;

/// How a table goes on from one of its times to the next.
enum class Between : std::uint8_t {
  step,    ///< the value of the time before
  linear,  ///< a straight line
  cubic,   ///< a cubic, continuous with its slope, which at each time is that of the parabola through three points
};
/// Words of the enumerators, in their order.
inline constexpr const char* between_words[] = {"step", "linear", "cubic"};
static_assert(std::size(between_words) == std::size_t(Between::cubic) + 1);

/// Values given at times. Outside of them it is zero, or where it holds the nearest value.
template <Real Scalar>
struct Table {
  std::vector<Scalar> times;   ///< s, increasing; empty: there is no table
  std::vector<Scalar> values;  ///< one or three a time, in the unit of what it is of
  Between between = Between::linear;
  bool holds = false;
};

/// What a torque is multiplied with over time: 1 while it is on, times the table, times mean + amplitude sin(rate t + phase).
template <Real Scalar>
struct Factor {
  std::vector<std::array<Scalar, 2>> on;  ///< s, from, to, one behind the other; empty: always
  Table<Scalar> table;                    ///< of single numbers
  Scalar mean = 1, amplitude = 0;
  Scalar rate = 0, phase = 0;  ///< rad/s, rad

  /// By the law of what begins at t; of intervals in the order that check() wants.
  bool is_on(Scalar t) const noexcept {
    const auto later =
        std::upper_bound(on.begin(), on.end(), t, [](Scalar at, const auto& one) { return at < one[0]; });
    return on.empty() || (later != on.begin() && t < later[-1][1]);
  }
};

/// What makes a wheel turn.
enum class WheelType : std::uint8_t {
  locked,    ///< part of the body
  held,      ///< a motor keeps its rate, or takes it through a table
  free,      ///< turns without friction
  torque,    ///< driven by a given torque, with friction
  motor,     ///< driven by slope (no_load_rate - rate), with friction
  friction,  ///< slowed by its bearing
};
/// Words of the enumerators, in their order.
inline constexpr const char* wheel_words[] = {"locked", "held", "free", "torque", "motor", "friction"};
static_assert(std::size(wheel_words) == std::size_t(WheelType::friction) + 1);

/// Rotationally symmetric about an axis fixed in the body.
template <Real Scalar>
struct Wheel {
  WheelType type = WheelType::held;
  Vec3<Scalar> axis{0, 0, 1};  ///< body axes, of unit length
  Scalar axial_inertia = 1;    ///< kg m^2
  Scalar rate = 0;             ///< at t = 0, relative to the body, rad/s
  Scalar angle = 0;            ///< at t = 0, rad
  Scalar torque = 0;           ///< of type torque: on the wheel, about its axis, N m
  Scalar friction = 0;         ///< c >= 0, N m s/rad
  Scalar slope = 0;            ///< of type motor, >= 0, N m s/rad
  Scalar no_load_rate = 0;     ///< of type motor, rad/s
  Table<Scalar> table;  ///< of type torque: added to its torque, N m; of type held: its rate in place of `rate`, rad/s
};

/// What a torque is, and the numbers of Torque that it is made of.
enum class TorqueType : std::uint8_t {
  constant,          ///< vector, N m
  table,             ///< three numbers a time, N m
  damping,           ///< -matrix U, U what it opposes
  brake,             ///< -vector_j U_j/|U| along each body axis j
  weight,            ///< of the mass centre, about the fixed point
  gravity_gradient,  ///< N d x J d, of `gradient` about down, or of the orbit
  magnetic,          ///< of a dipole, `vector`, A m^2
  eddy_current,      ///< (matrix (w_rel x B)) x B, matrix in S m^4
  thrust,            ///< a force, `vector`, N, at `point`, m
  charge,            ///< w x vector, N m s
};
/// Words of the enumerators, in their order.
inline constexpr const char* torque_words[] = {"constant",         "table",    "damping",      "brake",  "weight",
                                               "gravity-gradient", "magnetic", "eddy-current", "thrust", "charge"};
static_assert(std::size(torque_words) == std::size_t(TorqueType::charge) + 1);

/// The axes in which a torque, or a force, is given.
enum class Axes : std::uint8_t {
  body,
  inertial,
  orbit  ///< radial, along track, normal
};
/// Words of the enumerators, in their order.
inline constexpr const char* axes_words[] = {"body", "inertial", "orbit"};
static_assert(std::size(axes_words) == std::size_t(Axes::orbit) + 1);

/// What damping and brakes oppose.
enum class Opposed : std::uint8_t {
  angular_velocity,  ///< w
  momentum,          ///< M
  carrier_momentum,  ///< J w
};
/// Words of the enumerators, in their order.
inline constexpr const char* opposed_words[] = {"angular-velocity", "momentum", "carrier-momentum"};
static_assert(std::size(opposed_words) == std::size_t(Opposed::carrier_momentum) + 1);

/// One torque that acts on the body, times its factor. Which of the numbers count is said by its type; in SI units.
template <Real Scalar>
struct Torque {
  TorqueType type = TorqueType::constant;
  Axes axes = Axes::body;
  Opposed opposed = Opposed::angular_velocity;
  Vec3<Scalar> vector{0, 0, 0};
  Vec3<Scalar> point{0, 0, 0};                 ///< where a thrust acts, from the body's origin, body axes, m
  Mat3<Scalar> matrix = Mat3<Scalar>::Zero();  ///< of damping (N m s/rad, or 1/s) and eddy currents
  std::optional<Scalar> gradient;  ///< N = 3 g/R of a field that stands still, 1/s^2; none: that of the orbit
  Table<Scalar> table;             ///< of type table
  Factor<Scalar> factor;
};

/// The orbit of the mass centre about a point mass.
template <Real Scalar>
struct Orbit {
  Scalar radius = 1;                             ///< at t = 0, m
  Scalar mu = 1;                                 ///< m^3/s^2
  Scalar eccentricity = 0;                       ///< in [0, 1)
  Scalar true_anomaly = 0;                       ///< at t = 0, rad
  Vec3<Scalar> radial{1, 0, 0}, along{0, 1, 0};  ///< at t = 0, inertial axes, orthonormal
  Scalar surface = 0;                            ///< radius of the planet, m; 0: not known
};

/// The magnetic field where the body is: none, the same always, turning about an axis, or a dipole that the body orbits.
enum class MagneticField : std::uint8_t { none, uniform, rotating, dipole };
/// Words of the enumerators, in their order.
inline constexpr const char* field_words[] = {"none", "uniform", "rotating", "dipole"};
static_assert(std::size(field_words) == std::size_t(MagneticField::dipole) + 1);

/// Fields, inertial axes.
template <Real Scalar>
struct Field {
  Scalar gravity = 0;           ///< m/s^2
  Vec3<Scalar> down{0, 0, -1};  ///< unit
  MagneticField magnetic = MagneticField::none;
  Vec3<Scalar> flux_density{0, 0, 0};  ///< uniform; rotating: at t = 0, T
  Vec3<Scalar> axis{0, 0, 1};          ///< unit: about which a field rotates; of the dipole
  Scalar rate = 0;                     ///< at which it rotates, right-handed, rad/s
  Scalar strength =
      0;  ///< of the dipole on its equator at distance `radius`: B = -strength (radius/r)^3 (3 (m.r) r - m), T
  Scalar radius = 1;  ///< m
};

/// Body, wheels, what acts on them, and the start at t = 0. Body axes and SI units where nothing else is said.
template <Real Scalar>
struct Problem {
  Mat3<Scalar> inertia = Mat3<Scalar>::Identity();  ///< J, about the reference point, all wheels in it, kg m^2
  Scalar mass = 1;                                  ///< kg
  bool mass_given = true;                           ///< else it is 1, and nothing may ask for it
  Vec3<Scalar> centre_of_mass{0, 0, 0};             ///< from the body's origin, m
  bool fixed = false;                               ///< the origin is held in space and is the reference point
  Vec3<Scalar> rotor_momentum{0, 0, 0};             ///< l0, constant, of wheels that are not listed, N m s
  std::vector<Wheel<Scalar>> wheels;
  std::vector<Torque<Scalar>> torques;
  std::optional<Orbit<Scalar>> orbit;
  Field<Scalar> field;

  Quat<Scalar> attitude{};                 ///< body to inertial, unit
  Vec3<Scalar> angular_velocity{0, 0, 0};  ///< w, rad/s
  Vec3<Scalar> velocity{0, 0, 0};          ///< of the mass centre, inertial axes, m/s
  Vec3<Scalar> position{0, 0, 0};          ///< of the mass centre, inertial axes, m
  /// Where another clock stands at t = 0, by which the times were told that are asked for, s: what is left of them is rounded.
  Scalar clock = 0;
  Scalar retimed = 0;  ///< by how much that has moved the times of tables and of what is on, at most, s
};

/// A motion at one time.
template <Real Scalar>
struct State {
  Quat<Scalar> attitude{};                            ///< body to inertial, unit
  Vec3<Scalar> angular_velocity{0, 0, 0};             ///< body axes, rad/s
  Vec3<Scalar> angular_momentum{0, 0, 0};             ///< M, body axes, N m s
  std::array<Scalar, most_wheels> rotor_rate{};       ///< relative to the body, rad/s
  std::array<Scalar, most_wheels> rotor_angle{};      ///< relative to the body, rad
  Vec3<Scalar> velocity{0, 0, 0}, position{0, 0, 0};  ///< of a free body's mass centre, inertial axes
  Scalar work = 0;                ///< of all torques, those of the motors and of bearings among them, since t = 0, J
  Vec3<Scalar> impulse{0, 0, 0};  ///< of the external torques since t = 0, inertial axes, N m s
};

}  // namespace gyrostat::general
