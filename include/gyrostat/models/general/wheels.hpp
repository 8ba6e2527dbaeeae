// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "gyrostat/body/realisability.hpp"
#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/table.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"
#include "gyrostat/rotation/vector_double_double.hpp"

/// A body with its wheels (docs/general.md, section 1): every wheel is one of five kinds of time law, and those that turn by the equations
/// of motion are taken out of the inertia.
namespace gyrostat::general {

/// Why a problem is refused.
struct Fault {
  Errc code = Errc::ok;
  int place = -1;        ///< of the wheel or torque in the problem; -1: of none
  const char* why = "";  ///< what must hold, in words

  explicit operator bool() const noexcept { return code != Errc::ok; }
};

/// What is known of a wheel beforehand.
enum class Follows : std::uint8_t {
  body,      ///< locked
  rate,      ///< held: its rate, a polynomial between breakpoints
  constant,  ///< p stays
  integral,  ///< p is the integral of a torque known in time
  state,     ///< p is a state: dp/dt = T - c (p/I - u.w)
};

/// A wheel as the equations see it.
template <Real Scalar>
struct WheelLaw {
  Follows follows = Follows::body;
  Vec3<Scalar> axis{0, 0, 1};
  Scalar axial_inertia = 0;
  Scalar rate = 0, angle = 0;  ///< at t = 0
  Scalar momentum = 0;         ///< p at t = 0, N m s
  Scalar torque = 0;           ///< T but for what a table adds, N m
  Scalar friction = 0;         ///< c, N m s/rad
  bool tabled = false;         ///< rate or torque goes by the table of the problem's wheel

  bool turns_by_itself() const noexcept { return follows >= Follows::constant; }
};

/// Body and wheels, checked. M = J* w + l + sum of the p u of wheels that turn by themselves, l of the held ones and of those not listed.
template <Real Scalar>
struct Wheels {
  Mat3<Scalar> whole = Mat3<Scalar>::Identity();    ///< J
  Mat3<Scalar> reduced = Mat3<Scalar>::Identity();  ///< J*, J less I u u^T of the wheels that turn by themselves
  Mat3<Scalar> inverse = Mat3<Scalar>::Identity();  ///< of J*
  Vec3<Scalar> rotor_momentum{0, 0, 0};             ///< l0 and that of wheels held at a constant rate
  std::array<WheelLaw<Scalar>, most_wheels> laws{};
  std::size_t count = 0;

  /// What check() finds right.
  static Wheels of(const Problem<Scalar>& problem) noexcept;

  /// p u of all wheels that turn by themselves, and l, at t = 0: in the digits of the equations, so that in a body at rest M is all theirs.
  Vec3<Scalar> momentum_of_wheels() const noexcept {
    Vec3<Scalar> sum = rotor_momentum;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& law = laws[i];
      if (law.turns_by_itself()) sum += law.momentum * law.axis;
      if (law.follows == Follows::rate && law.tabled) sum += law.axial_inertia * law.rate * law.axis;
    }
    return sum;
  }
};

namespace detail {

template <Real Scalar>
Scalar greatest_entry(const Mat3<Scalar>& m) noexcept {
  return m.cwiseAbs().maxCoeff();
}

/// What of a table must hold; `shape` says in words how many values it wants.
template <Real Scalar>
Fault check_table(const Table<Scalar>& table, std::size_t width, int place, const char* shape) noexcept {
  if (const Errc wrong = check(table, width); wrong != Errc::ok) return {wrong, place, shape};
  if (!(swing(table, width) <= Scalar(most_swing)))
    return {Errc::out_of_domain, place,
            "the cubic of its table must not swing beyond 1000 times its values, as it does where some times lie much "
            "closer than others: interpolate linearly, or space the times more evenly"};
  return {};
}

template <Real Scalar>
Fault check_wheel(const Wheel<Scalar>& wheel, int place) noexcept {
  using std::abs;
  for (const Scalar x : {wheel.axial_inertia, wheel.rate, wheel.angle, wheel.torque, wheel.friction, wheel.slope,
                         wheel.no_load_rate, wheel.axis[0], wheel.axis[1], wheel.axis[2]})
    if (!(abs(x) < infinity<Scalar>)) return {Errc::not_finite, place, "its numbers must be finite"};
  if (!(abs(wheel.axis.norm() - 1) <= 8 * epsilon<Scalar>))
    return {Errc::out_of_domain, place, "its axis must have unit length"};
  if (wheel.type == WheelType::locked) {
    if (wheel.axial_inertia < 0) return {Errc::negative, place, "its axial inertia must not be negative"};
    if (wheel.rate != 0) return {Errc::out_of_domain, place, "a locked wheel has no rate"};
  } else if (!(wheel.axial_inertia > 0)) {
    return {Errc::not_positive, place, "its axial inertia must be positive"};
  }
  if (wheel.friction < 0) return {Errc::negative, place, "its friction must not be negative"};
  if (wheel.slope < 0) return {Errc::negative, place, "the slope of its motor must not be negative"};
  const bool tables = wheel.type == WheelType::held || wheel.type == WheelType::torque;
  if (!tables && !wheel.table.times.empty())
    return {Errc::out_of_domain, place, "only a held or driven wheel goes by a table"};
  return check_table(wheel.table, 1, place,
                     "its table must have one finite value for each time, and times that increase");
}

template <Real Scalar>
Fault check_inertia(const Mat3<Scalar>& J) noexcept {
  const Scalar slack = 8 * epsilon<Scalar> * J.trace();
  if (!J.allFinite()) return {Errc::not_finite, -1, "the inertia must be finite"};
  if (!(greatest_entry<Scalar>(J - J.transpose()) <= slack))
    return {Errc::not_symmetric, -1, "the inertia must be symmetric"};
  const Vec3<Scalar> moments = symmetric_eigen<Scalar>((J + J.transpose()) / 2).values;
  if (!(moments[0] > 0)) return {Errc::not_positive, -1, "the moments of inertia must be positive"};
  if (moments[2] - moments[1] - moments[0] > slack)
    return {Errc::triangle_inequality, -1, "a moment of inertia exceeds the sum of the two others"};
  return {};
}

/// Whether a positive part of J is left without the wheels: not below 8 roundings of its trace.
template <Real Scalar>
bool leaves_a_body(const Mat3<Scalar>& reduced, const Mat3<Scalar>& J) noexcept {
  return symmetric_eigen<Scalar>(reduced).values[0] > 8 * epsilon<Scalar> * J.trace();
}

template <Real Scalar>
bool turns_by_itself(const Wheel<Scalar>& wheel) noexcept {
  return wheel.type != WheelType::locked && wheel.type != WheelType::held;
}

/// The driving torque without that of a table and the friction of a wheel that turns by itself.
template <Real Scalar>
std::array<Scalar, 2> drive(const Wheel<Scalar>& wheel) noexcept {
  switch (wheel.type) {
    case WheelType::torque: return {wheel.torque, wheel.friction};
    case WheelType::motor: return {wheel.slope * wheel.no_load_rate, wheel.slope + wheel.friction};
    case WheelType::friction: return {0, wheel.friction};
    default: return {0, 0};
  }
}

}  // namespace detail

/// Whether body and wheels are what the equations can take: J symmetric (8 eps of its trace) and with the triangle inequality; J*
/// positive definite; wheels with unit axes, positive axial inertia (a locked one may have none), c >= 0, a locked one without rate, and
/// tables for held and driven ones alone; at most most_wheels.
template <Real Scalar>
Fault check_wheels(const Problem<Scalar>& problem) noexcept {
  const Mat3<Scalar>& J = problem.inertia;
  if (const Fault wrong = detail::check_inertia(J)) return wrong;
  if (!problem.rotor_momentum.allFinite()) return {Errc::not_finite, -1, "the rotor momentum must be finite"};
  if (problem.wheels.size() > most_wheels) return {Errc::out_of_domain, int(most_wheels), "there are at most 8 wheels"};
  Mat3<Scalar> reduced = (J + J.transpose()) / 2;
  int place = 0;
  for (const Wheel<Scalar>& wheel : problem.wheels) {
    if (const Fault wrong = detail::check_wheel(wheel, place)) return wrong;
    if (detail::turns_by_itself(wheel)) {
      reduced -= wheel.axial_inertia * wheel.axis * wheel.axis.transpose();
      if (!detail::leaves_a_body<Scalar>(reduced, J))
        return {Errc::not_positive, place, "the inertia of the whole must be more than that of its wheels"};
    }
    ++place;
  }
  return {};
}

/// Least eigenvalue of the second moments of mass that body (its mass centre about a fixed point) and wheels leave, kg m^2: clearly
/// negative (below -8 eps of the trace of J) where no distribution of mass is such a body. Wheels count as thin discs, which need the least room.
template <Real Scalar>
Scalar realisability(const Problem<Scalar>& problem) noexcept {
  Mat3<Scalar> known = Mat3<Scalar>::Zero();
  const Vec3<Scalar>& r = problem.centre_of_mass;
  if (problem.fixed) known += problem.mass * r * r.transpose();
  for (const Wheel<Scalar>& wheel : problem.wheels)
    known += wheel.axial_inertia / 2 * (Mat3<Scalar>::Identity() - wheel.axis * wheel.axis.transpose());
  return gyrostat::realisability<Scalar>(problem.inertia, known);
}

/// What the momenta of wheels would be together if none cancelled another at t = 0, N m s.
template <Real Scalar>
Scalar momenta_of_wheels(const Problem<Scalar>& problem) noexcept {
  Scalar sum = problem.rotor_momentum.norm();
  for (const Wheel<Scalar>& wheel : problem.wheels)
    if (wheel.type != WheelType::locked)
      sum += wheel.axial_inertia * (std::abs(wheel.rate) + std::abs(wheel.axis.dot(problem.angular_velocity)));
  return sum;
}

template <Real Scalar>
Wheels<Scalar> Wheels<Scalar>::of(const Problem<Scalar>& problem) noexcept {
  Wheels made;
  using Wide = Wider<Scalar>;  // so that each number is rounded once
  made.whole = (problem.inertia + problem.inertia.transpose()) / 2;
  Mat3<Wide> reduced = matrix_cast<Wide>(made.whole);
  const Vec3<Wide> rate = vector_cast<Wide>(problem.angular_velocity);
  made.rotor_momentum = problem.rotor_momentum;
  made.count = problem.wheels.size();
  for (std::size_t i = 0; i < made.count; ++i) {
    const Wheel<Scalar>& wheel = problem.wheels[i];
    WheelLaw<Scalar>& law = made.laws[i];
    law.axis = wheel.axis, law.axial_inertia = wheel.axial_inertia;
    law.rate = wheel.rate, law.angle = wheel.angle;
    law.tabled = !wheel.table.times.empty();
    if (wheel.type == WheelType::locked) continue;
    if (wheel.type == WheelType::held) {
      law.follows = Follows::rate;
      if (law.tabled) law.rate = piece(wheel.table, 1, 0, Scalar(0))(Scalar(0));
      else made.rotor_momentum += law.axial_inertia * law.rate * law.axis;
      continue;
    }
    const auto [torque, friction] = detail::drive(wheel);
    law.torque = torque, law.friction = friction;
    law.follows = friction > 0 ? Follows::state : torque != 0 || law.tabled ? Follows::integral : Follows::constant;
    const Vec3<Wide> axis = vector_cast<Wide>(law.axis);
    law.momentum = static_cast<Scalar>(law.axial_inertia * (law.rate + axis.dot(rate)));
    reduced -= Wide(law.axial_inertia) * axis * axis.transpose();
  }
  made.reduced = matrix_cast<Scalar>(reduced);
  // of a diagonal tensor entry by entry, so that zeros stay
  made.inverse = made.reduced.isDiagonal(0) ? Mat3<Scalar>(made.reduced.diagonal().cwiseInverse().asDiagonal())
                                            : matrix_cast<Scalar>(Mat3<Wide>(reduced.inverse()));
  made.inverse = ((made.inverse + made.inverse.transpose()) / 2).eval();
  return made;
}

}  // namespace gyrostat::general
