// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/core/real.hpp"
#include "gyrostat/math/quadrature.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/table.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/quaternion.hpp"
#include "gyrostat/rotation/vector.hpp"

/// Energy and momentum against what torques and motors have done (docs/general.md, section 1.5): a check of formulas and of the steps from
/// piece to piece, no estimate of an error.
namespace gyrostat::general {

/// E = w.J* w/2 + sum of p^2/(2 I) of wheels that turn by themselves, J.
template <Real Scalar>
Scalar energy(const Wheels<Scalar>& wheels, const State<Scalar>& state) noexcept {
  const Vec3<Scalar>& w = state.angular_velocity;
  Scalar sum = w.dot(wheels.reduced * w) / 2;
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    if (!law.turns_by_itself()) continue;
    const Scalar absolute = state.rotor_rate[i] + law.axis.dot(w);
    sum += law.axial_inertia * absolute * absolute / 2;
  }
  return sum;
}

/// dE/dt by what does the work, W.
template <Real Scalar>
struct Power {
  Scalar torques = 0;  ///< external ones
  Scalar motors = 0;   ///< and bearings, and what changes a held rate
  constexpr Scalar whole() const noexcept { return torques + motors; }
};

/// Power of a state under an external torque. inside: as in load_at.
template <Real Scalar>
Power<Scalar> power(const Problem<Scalar>& problem, const Wheels<Scalar>& wheels, const State<Scalar>& state,
                    const Vec3<Scalar>& torque, Scalar t, Scalar inside) noexcept {
  const Vec3<Scalar>& w = state.angular_velocity;
  Power<Scalar> sum{torque.dot(w), 0};
  for (std::size_t i = 0; i < wheels.count; ++i) {
    const auto& law = wheels.laws[i];
    const Cubic<Scalar> table = law.tabled ? piece(problem.wheels[i].table, 1, 0, inside) : Cubic<Scalar>{};
    if (law.follows == Follows::rate) sum.motors -= law.axial_inertia * table.about(t).c[1] * law.axis.dot(w);
    if (!law.turns_by_itself()) continue;
    const Scalar rate = state.rotor_rate[i];
    sum.motors += (law.torque + table(t) - law.friction * rate) * rate;
  }
  return sum;
}

/// The integrals of power and torque along a motion, and what they should have changed.
template <Real Scalar>
class Balances {
 public:
  Balances(const Problem<Scalar>& problem, const Wheels<Scalar>& wheels) noexcept : problem_(problem), wheels_(wheels) {
    for (std::size_t i = 0; i < wheels.count; ++i)
      steps_ = steps_ || (wheels.laws[i].tabled && wheels.laws[i].follows == Follows::rate);
  }

  /// A part of the motion without a breakpoint inside; at(t): the state, at both ends by the laws that hold between them.
  template <class At>
  void add(Scalar from, Scalar to, const At& at) noexcept {
    using std::abs;
    const Scalar half = (to - from) / 2, middle = from + half;
    for (const auto& point : math::kronrod_points<Scalar>) {
      const Scalar t = middle + half * point.node, share = half * point.weight;
      const State<Scalar> state = at(t);
      const Pose<Scalar> pose{state.attitude, state.angular_velocity, state.angular_momentum};
      const Vec3<Scalar> torque = load_at(problem_, pose, t, middle).torque;
      const Power<Scalar> gain = power(problem_, wheels_, state, torque, t, middle);
      work_.torques += share * gain.torques, work_.motors += share * gain.motors;
      all_work_.torques += share * abs(gain.torques), all_work_.motors += share * abs(gain.motors);
      impulse_ += share * rotate<Scalar>(state.attitude, torque), all_impulse_ += share * torque.norm();
    }
    const State<Scalar> first = at(from), last = at(to);
    const Scalar E0 = general::energy(wheels_, first), E1 = general::energy(wheels_, last);
    if (steps_ && reached_ == from) stepped_ += E0 - reached_energy_, all_work_.motors += abs(E0 - reached_energy_);
    reached_ = to, reached_energy_ = E1;
    gained_ += E1 - E0, most_energy_ = std::max({most_energy_, E0, E1});
    turned_ +=
        rotate<Scalar>(last.attitude, last.angular_momentum) - rotate<Scalar>(first.attitude, first.angular_momentum);
    most_momentum_ = std::max({most_momentum_, first.angular_momentum.norm(), last.angular_momentum.norm()});
  }

  /// What is missing in the energy over the integral of the sizes of power and the greatest energy; 0 where nothing moves.
  Scalar energy() const noexcept {
    using std::abs;
    return over(abs(gained_ - work_.whole()), size());
  }
  /// What is missing in R M over the integral of |torque| and the greatest |M|.
  Scalar momentum() const noexcept { return over((turned_ - impulse_).norm(), all_impulse_ + most_momentum_); }
  /// The work done, J, what motors do in no time where a held rate steps counted in.
  Power<Scalar> work() const noexcept { return {work_.torques, work_.motors + stepped_}; }
  /// The same of its size, and with the greatest energy what residuals are told of, J.
  const Power<Scalar>& all_work() const noexcept { return all_work_; }
  Scalar size() const noexcept { return all_work_.whole() + most_energy_; }

 private:
  static Scalar over(Scalar missing, Scalar size) noexcept { return missing == 0 ? Scalar(0) : missing / size; }

  const Problem<Scalar>& problem_;
  const Wheels<Scalar>& wheels_;
  bool steps_ = false;             ///< a held rate may step, and the energy with it
  Power<Scalar> work_, all_work_;  ///< integrals of power and of its size
  Scalar gained_ = 0, most_energy_ = 0;
  Scalar reached_ = nan<Scalar>, reached_energy_ = 0, stepped_ = 0;
  Vec3<Scalar> impulse_{0, 0, 0}, turned_{0, 0, 0};
  Scalar all_impulse_ = 0, most_momentum_ = 0;
};

}  // namespace gyrostat::general
