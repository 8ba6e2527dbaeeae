// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/deceleration/scene.hpp"
#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/ladder/general/motion.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/rotor/scene.hpp"
#include "gyrostat/ladder/spinning/scene.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/symmetric.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Of which families a scene is exactly an instance (docs/general.md, section 3): what must vanish is below 8 roundings of the terms that
/// were summed, what must be equal is so to 8 roundings of the greatest entry.
namespace gyrostat::general {

/// A scene of the family `heavy`, and the way back. The body turns relative to that of the family at `turn` about a fixed axis: of a
/// symmetric gyrostat, which is a top that spins faster.
struct HeavyInstance {
  heavy::Scene scene;
  Quat<double> q_HI;           ///< inertial axes to those of the family, 3 up
  Vec3<double> turn{0, 0, 0};  ///< l/C, rad/s, body axes
};

/// A scene of the family `rotor`, and the way back: rates of its rotor are greater by `shift`.
struct RotorInstance {
  rotor::Scene scene;
  std::size_t driven;  ///< the wheel that is the rotor
  double shift;        ///< rad/s
};

/// A scene of the family `spinning`, and the way back.
struct SpinningInstance {
  spinning::Scene scene;
  Mat3<double> R_SB;  ///< body axes to those of the family, axis 3 the one that wheels and charge are along
  Quat<double> q_IS;  ///< inertial axes of the family, the body's at t = 0, to inertial axes
};

/// What a scene is an instance of, and of each family that it is none why not.
struct Instances {
  std::optional<free::Scene> free;
  std::optional<deceleration::Scene> deceleration;
  std::optional<HeavyInstance> heavy;
  std::optional<RotorInstance> rotor;
  std::optional<SpinningInstance> spinning;
  bool pushed = false;           ///< forces move the mass centre, which `spinning` alone knows
  Vec3<double> charge{0, 0, 0};  ///< e_H of charges, which is no special of the momentum of `free` and `rotor`, N m s
  std::array<const char*, specials> why = {"families are not looked for", "families are not looked for",
                                           "families are not looked for", "families are not looked for",
                                           "families are not looked for"};

  bool has(Special special) const noexcept { return special != Special::none && why[std::size_t(special)] == nullptr; }
};

namespace detail {

inline constexpr double slack = 8 * epsilon<double>;

/// Every component is below 8 roundings of the greatest of `size`.
template <class Value, class Size>
bool vanishes(const Value& value, const Size& size) noexcept {
  return value.cwiseAbs().maxCoeff() <= slack * size.maxCoeff();
}

/// To 8 roundings; a vector of no length is parallel to all.
inline bool parallel(const Vec3<double>& a, const Vec3<double>& b) noexcept {
  return cross<double>(a, b).norm() <= slack * a.norm() * b.norm();
}

/// Symmetric about the axis e, a principal one.
inline bool symmetric_about(const Mat3<double>& J, const Vec3<double>& e) noexcept {
  const double size = J.cwiseAbs().maxCoeff(), C = e.dot(J * e);
  const Vec3<double> across = symmetric_eigen<double>(J - C * e * e.transpose()).values;  // 0 and the two others
  Vec3<double> sizes = across.cwiseAbs();
  std::sort(sizes.data(), sizes.data() + 3);
  return (J * e - C * e).cwiseAbs().maxCoeff() <= slack * size && sizes[2] - sizes[1] <= slack * size;
}

/// What is summed and does not change, sorted by what a family may have; what is below rounding is dropped.
struct Loads {
  Vec3<double> body{0, 0, 0}, charge{0, 0, 0};
  Mat3<double> damping = Mat3<double>::Zero(), by_momentum = Mat3<double>::Zero();  ///< without charge
  Mat3<double> damping_size = Mat3<double>::Zero(), by_momentum_size = Mat3<double>::Zero();
  Vec3<double> brake_total{0, 0, 0}, brake_carrier{0, 0, 0};
  Vec3<double> moment{0, 0, 0}, direction{0, 0, -1};  ///< tau = moment x direction, body and inertial axes
  double gradient = 0;
  bool weighs = false;  ///< a moment or a gradient
  Vec3<double> force{0, 0, 0}, force_I{0, 0, 0};
  const char* other = nullptr;  ///< something that no family has

  bool damps() const noexcept { return !damping.isZero(0) || !by_momentum.isZero(0); }
  bool brakes() const noexcept { return !brake_total.isZero(0) || !brake_carrier.isZero(0); }
  bool quiet() const noexcept { return !other && body.isZero(0) && !damps() && !brakes() && !weighs; }

  static Loads of(const Problem<double>& problem, const Collected<double>& torques) noexcept;
};

/// Of torques that are linear in the inertial axes, sum A_j e_j: the moment m and direction d with A_j = d_j [m]x. False: there are none.
inline bool one_direction(const Terms<double>& sum, const Terms<double>& size, Loads& loads) noexcept {
  Mat3<double> outer, most = Mat3<double>::Zero();  // m d^T
  for (int j = 0; j < 3; ++j) {
    const Mat3<double>& A = sum.inertial[std::size_t(j)];
    most = most.cwiseMax(size.inertial[std::size_t(j)]);
    if (!vanishes((A + A.transpose()) / 2, size.inertial[std::size_t(j)])) return false;
    outer.col(j) = Vec3<double>(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)) / 2;
  }
  if (vanishes(outer, most)) return true;
  int longest = 0;
  outer.colwise().norm().maxCoeff(&longest);
  const Vec3<double> along = outer.col(longest).normalized();
  const Vec3<double> direction = outer.transpose() * along;
  if ((outer - along * direction.transpose()).cwiseAbs().maxCoeff() > slack * most.maxCoeff()) return false;
  const double length = direction.norm();
  loads.direction = direction / length;
  loads.moment = length * along;
  loads.weighs = true;
  return true;
}

inline Loads Loads::of(const Problem<double>& problem, const Collected<double>& torques) noexcept {
  Loads made;
  const Terms<double>&sum = torques.steady().sum, &size = torques.steady().size;
  const auto outside = [&](const char* what) noexcept {
    if (!made.other) made.other = what;
  };
  if (!torques.is_steady()) outside("a torque changes with time");
  for (std::size_t j = 0; j < 3; ++j)
    if (!vanishes(sum.orbital[j], size.orbital[j])) outside("a torque is given in the axes of an orbit");
  if (sum.orbit_gradient != 0) outside("the gravity gradient turns with an orbit");
  if (!sum.dipole.isZero(0)) outside("the magnetic field moves");
  if (!sum.eddy.isZero(0)) outside("no family has eddy currents");
  if (!vanishes(sum.body, size.body)) made.body = sum.body;
  const Mat3<double> skew = (sum.by_rate - sum.by_rate.transpose()) / 2;
  if (!vanishes(skew, size.by_rate)) made.charge = {skew(2, 1), skew(0, 2), skew(1, 0)};
  const Mat3<double> damping = (sum.by_rate + sum.by_rate.transpose()) / 2;
  if (!vanishes(damping, size.by_rate)) made.damping = damping, made.damping_size = size.by_rate;
  if (!vanishes(sum.by_momentum, size.by_momentum))
    made.by_momentum = sum.by_momentum, made.by_momentum_size = size.by_momentum;
  made.brake_total = sum.brake_total;
  made.brake_carrier = sum.brake_carrier;
  if (!one_direction(sum, size, made)) outside("torques are constant along more than one direction of space");
  if (sum.gradient != 0) {
    if (made.weighs && !parallel(made.direction, problem.field.down))
      outside("weight and gravity gradient have different directions");
    made.gradient = sum.gradient;
    if (!made.weighs) made.direction = problem.field.down;
    else if (made.direction.dot(problem.field.down) < 0) made.direction *= -1, made.moment *= -1;
    made.weighs = true;
  }
  if (!vanishes(sum.force_body, size.force_body)) made.force = sum.force_body;
  if (!vanishes(sum.force_inertial, size.force_inertial)) made.force_I = sum.force_inertial;
  return made;
}

/// The wheels as families may have them.
struct Spinners {
  Vec3<double> kept{0, 0, 0};  ///< l and the p u that stay
  bool spare = true;           ///< all rates or momenta stay
  bool free = false;           ///< one of them turns freely
  int driven = -1;             ///< the wheel with friction or a motor; -2: more than one
  const char* why = nullptr;   ///< not nullptr: no family has them

  static Spinners of(const Wheels<double>& wheels) noexcept {
    Spinners made;
    made.kept = wheels.rotor_momentum;
    for (std::size_t i = 0; i < wheels.count; ++i) {
      const auto& law = wheels.laws[i];
      if (law.follows == Follows::rate && law.tabled) made.why = "the rate of a held wheel changes";
      if (law.follows == Follows::integral) made.why = "a wheel is driven by a torque that does not depend on its rate";
      if (law.follows == Follows::constant) made.kept += law.momentum * law.axis, made.free = true;
      if (law.follows == Follows::state && law.tabled) made.why = "the torque of a wheel changes with time";
      if (law.follows == Follows::state) made.driven = made.driven == -1 ? int(i) : -2;
    }
    made.spare = !made.why && made.driven == -1;
    return made;
  }
};

/// Whether a column is asked for that is made of the attitude.
inline bool wants_attitude(const Question& question) noexcept {
  for (std::size_t c = 0; c < std::size(column_kinds); ++c)
    if (has(made_of[c], primitive::attitude) && aim_of(question, tables, false, c)) return true;
  return false;
}

/// What all families are asked first, until a rung is asked: the times and whether the attitude matters.
inline Question plain(const Question& question) {
  Question made;
  made.times = question.times;
  made.tolerance = question.tolerance;
  made.wants_attitude = wants_attitude(question);
  return made;
}

}  // namespace detail

}  // namespace gyrostat::general
