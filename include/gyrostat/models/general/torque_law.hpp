// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// A torque of the caller's own, added to those of a problem (docs/general.md, section 7).
namespace gyrostat::general {

/// The motion as a torque sees it.
template <Real Scalar>
struct Seen : Pose<Scalar> {
  std::array<Scalar, most_wheels> rotor_rate{};  ///< of the wheels in their order, relative to the body, rad/s
};

/// A torque f(t, seen) about the reference point, body axes, N m, at t in s. It must be a function: the same numbers give the same torque,
/// whenever and in whatever order it is asked. Where it has no value it gives NaN.
template <class F, class Scalar>
concept TorqueLaw = requires(const F& f, Scalar t, const Seen<Scalar>& seen) {
  { f(t, seen) } noexcept -> std::convertible_to<Vec3<Scalar>>;
};

/// No torque.
struct NoTorque {
  template <Real Scalar>
  Vec3<Scalar> operator()(Scalar, const Seen<Scalar>&) const noexcept {
    return {0, 0, 0};
  }
};

/// A law of any type in double precision, by a pointer to it, and the times at which it is not smooth.
struct OwnTorque {
  Vec3<double> (*call)(const void* law, double t, const Seen<double>& seen) noexcept = nullptr;
  const void* law = nullptr;        ///< must outlive what holds this
  std::vector<double> breakpoints;  ///< s
  double* lost_at = nullptr;  ///< receives the time when a law that a motion needs has no value; nullptr: not wanted

  /// `law` must outlive what is made.
  template <TorqueLaw<double> Law>
  static OwnTorque of(const Law& law, std::vector<double> breakpoints = {}) {
    const auto call = [](const void* its, double t, const Seen<double>& seen) noexcept -> Vec3<double> {
      return (*static_cast<const Law*>(its))(t, seen);
    };
    return {call, &law, std::move(breakpoints), nullptr};
  }
  template <TorqueLaw<double> Law>
  static OwnTorque of(const Law&&, std::vector<double> = {}) = delete;

  bool any() const noexcept { return call != nullptr; }
  Vec3<double> operator()(double t, const Seen<double>& seen) const noexcept {
    return any() ? call(law, t, seen) : Vec3<double>(0, 0, 0);
  }
};

/// What a torque sees of a state.
template <Real Scalar>
Seen<Scalar> seen_of(const State<Scalar>& state) noexcept {
  return {{state.attitude, state.angular_velocity, state.angular_momentum}, state.rotor_rate};
}

/// What a torque sees as numbers, one behind the other: attitude [x, y, z, w], angular velocity, angular momentum, rates of the wheels.
inline std::array<double, 10 + most_wheels> numbers_of(const Seen<double>& seen) noexcept {
  std::array<double, 10 + most_wheels> made{seen.attitude.x, seen.attitude.y, seen.attitude.z, seen.attitude.w};
  std::copy_n(seen.angular_velocity.data(), 3, made.begin() + 4);
  std::copy_n(seen.angular_momentum.data(), 3, made.begin() + 7);
  std::copy_n(seen.rotor_rate.begin(), most_wheels, made.begin() + 10);
  return made;
}

/// The equations of Flow with a law beside the torques of the problem, between two breakpoints.
template <Real Scalar, TorqueLaw<Scalar> Law>
class DrivenFlow {
 public:
  using Numbers = typename Flow<Scalar>::Numbers;
  static constexpr std::size_t width = Flow<Scalar>::width;

  /// share: of the law's components, which are multiplied by it. problem, wheels and law must outlive this.
  DrivenFlow(const Problem<Scalar>& problem, const Wheels<Scalar>& wheels, const Law& law,
             const Vec3<Scalar>& share = {1, 1, 1}) noexcept
      : flow_(problem, wheels), law_(&law), share_(share) {}

  /// The piece that is integrated: the law is asked from its begin on and just not at its end, where another may hold.
  void enter(Scalar from, Scalar to) noexcept {
    from_ = from;
    last_ = std::nextafter(to, from);
    flow_.inside = std::min(from + (to - from) / 2, last_);  // between two times one rounding apart there is none
  }

  /// The law at t; NaN where the numbers are, without asking.
  Vec3<Scalar> law_at(Scalar t, const Numbers& y) noexcept {
    constexpr Scalar no = nan<Scalar>;
    if (!std::all_of(y.begin(), y.end(), [](Scalar x) { return std::isfinite(x); })) return {no, no, no};
    const Scalar when = std::min(std::max(t, from_), last_);
    const Vec3<Scalar> torque = (*law_)(when, seen_of(flow_.state(when, y)));
    if (!torque.allFinite()) lost_at_ = when;
    return torque.cwiseProduct(share_);
  }

  /// dy/dt
  void operator()(Scalar t, const Numbers& y, Numbers& rate) noexcept {
    flow_(t, y, rate);
    const Vec3<Scalar> torque = law_at(t, y);
    for (std::size_t i = 0; i < 3; ++i) rate[Flow<Scalar>::momentum + i] += torque[int(i)];
  }

  /// A time in the piece that is integrated.
  Scalar inside() const noexcept { return flow_.inside; }
  Numbers start() const noexcept { return flow_.start(); }
  State<Scalar> state(Scalar t, const Numbers& y) const noexcept { return flow_.state(t, y); }
  /// When the law was last asked and had no finite value, s; NaN: it always had one.
  Scalar lost_at() const noexcept { return lost_at_; }

 private:
  Flow<Scalar> flow_;
  const Law* law_;
  Vec3<Scalar> share_;
  Scalar from_ = 0, last_ = infinity<Scalar>, lost_at_ = nan<Scalar>;
};

}  // namespace gyrostat::general
