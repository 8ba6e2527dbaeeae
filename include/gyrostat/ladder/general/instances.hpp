// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "gyrostat/core/linkage.hpp"
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
#include "gyrostat/models/general/sizes.hpp"
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
  bool down_alone = false;     ///< of what the attitude makes down alone is asked for, and is that of the family
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

  /// The greatest of what was dropped to find each family, in roundings of what it is part of.
  std::array<double, specials> dropped{};

  bool has(Special special) const noexcept { return special != Special::none && why[std::size_t(special)] == nullptr; }
};

namespace detail {

inline constexpr double slack = 8 * epsilon<double>;

/// Whether a residue is below 8 roundings of `size`; then it is dropped, and raises `dropped`, in roundings, where that is wanted.
inline bool drops(double residue, double size, double* dropped) noexcept {
  if (!(residue <= slack * size)) return false;
  if (dropped != nullptr && residue > 0) *dropped = std::max(*dropped, residue / (epsilon<double> * size));
  return true;
}

/// Every component is below 8 roundings of the greatest of `size`.
template <class Value, class Size>
bool vanishes(const Value& value, const Size& size, double* dropped = nullptr) noexcept {
  return drops(value.cwiseAbs().maxCoeff(), size.maxCoeff(), dropped);
}

/// To 8 roundings; a vector of no length is parallel to all.
inline bool parallel(const Vec3<double>& a, const Vec3<double>& b, double* dropped = nullptr) noexcept {
  return drops(cross<double>(a, b).norm(), a.norm() * b.norm(), dropped);
}

/// Symmetric about the axis e, a principal one.
GYROSTAT_COMPILED_ONCE bool symmetric_about(const Mat3<double>& J, const Vec3<double>& e,
                                            double* dropped = nullptr) noexcept;

/// How large a motion is, by which what torques that all but cancel leave is judged: it may be a rounding of them, and yet turn the body.
struct Extent {
  double rate = 0, momentum = 0;     ///< rad/s, N m s
  double torque = infinity<double>;  ///< that comes to a rounding of the momentum in the span, N m
  double force = infinity<double>;   ///< that comes to a rounding of the mass centre's, N

  static Extent of(const Problem<double>& problem, const Sizes<double>& sizes, double span) noexcept {
    if (!(span > 0)) return {sizes.turning, sizes.momenta};
    const double rounding = epsilon<double> / span;
    return {sizes.turning, sizes.momenta, rounding * sizes.momenta, rounding * problem.mass * problem.velocity.norm()};
  }
};

/// What is summed and does not change, sorted by what a family may have; what is below rounding, and comes to no more in the span, is dropped.
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
  double dropped = 0;           ///< the greatest of what was dropped, in roundings
  Extent extent;                ///< with the torque and the force that may be dropped beside what is there

  bool damps() const noexcept { return !damping.isZero(0) || !by_momentum.isZero(0); }
  bool brakes() const noexcept { return !brake_total.isZero(0) || !brake_carrier.isZero(0); }
  bool quiet() const noexcept { return !other && body.isZero(0) && !damps() && !brakes() && !weighs; }

  /// Whether a residue may be dropped: a torque, N m, or what gives one times `per`.
  template <class Value, class Size>
  bool drop(const Value& residue, const Size& size, double per = 1) noexcept {
    return drop(residue, size, per, &dropped);
  }
  template <class Value, class Size>
  bool drop(const Value& residue, const Size& size, double per, double* raised) const noexcept {
    return residue.cwiseAbs().maxCoeff() * per <= extent.torque && vanishes(residue, size, raised);
  }

  GYROSTAT_COMPILED_ONCE static Loads of(const Problem<double>& problem, const Collected<double>& torques,
                                         const Extent& extent = {}) noexcept;
};

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

/// Whether a column is asked for that is made of the attitude, another than this one.
GYROSTAT_COMPILED_ONCE bool wants_attitude(const Question& question,
                                           std::size_t but = std::size(column_kinds)) noexcept;

/// A rotation that takes the unit vector d to -e3; the identity where it is that.
inline Quat<double> to_heavy_axes(const Vec3<double>& d) noexcept {
  if (d[0] == 0 && d[1] == 0 && d[2] < 0) return {};
  // half way between d and -e3, or any axis across where they are opposite
  const Vec3<double> target(0, 0, -1);
  const double cosine = d.dot(target);
  if (cosine < -0.5) {
    const Quat<double> flip{0, 1, 0, 0};
    return to_heavy_axes(rotate<double>(flip, d)) * flip;
  }
  const Vec3<double> axis = cross<double>(d, target);
  return normalised(Quat<double>{1 + cosine, axis[0], axis[1], axis[2]});
}

/// What all families are asked first, until a rung is asked: the times and whether the attitude matters.
GYROSTAT_COMPILED_ONCE Question plain(const Question& question);

}  // namespace detail

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/instances_definition.hpp"
#endif
