// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"
#include "gyrostat/models/general/prepared.hpp"
#include "gyrostat/models/general/problem.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/surroundings.hpp"
#include "gyrostat/models/general/wheels.hpp"
#include "gyrostat/rotation/vector.hpp"

/// General problems that differ from a given one by what rounding makes of it.
namespace gyrostat::general::detail {

/// By how much the inverse of the tensor without its wheels magnifies its rounding; 1 where it is diagonal.
template <Real Scalar>
Scalar condition_of(const Wheels<Scalar>& wheels) noexcept {
  if (wheels.reduced.isDiagonal(0)) return 1;
  return wheels.whole.cwiseAbs().maxCoeff() * wheels.inverse.cwiseAbs().maxCoeff();
}

/// Whether a body all but rests where torques that change with its attitude all but balance (honesty::next_to_balance).
template <Real Scalar>
bool is_next_to_balance(const Prepared<Scalar>& of, const State<Scalar>& start) noexcept {
  const auto turns_with_body = [](const Torque<Scalar>& torque) noexcept {
    return torque.type == TorqueType::weight || torque.type == TorqueType::gravity_gradient ||
           torque.type == TorqueType::magnetic || torque.axes != Axes::body;
  };
  const auto& torques = of.problem.torques;
  if (std::none_of(torques.begin(), torques.end(), turns_with_body)) return false;
  const Vec3<Scalar>&M = start.angular_momentum, &w = start.angular_velocity;
  const Scalar share = Scalar(honesty::next_to_balance), torque = of.sizes.external, speed = w.norm();
  if (!(of.sizes.least * speed * speed <= share * share * torque)) return false;
  const Pose<Scalar> pose{start.attitude, w, M};
  const Vec3<Scalar> rate = cross<Scalar>(M, w) + load_at(of.problem, pose, Scalar(0), Scalar(0)).torque;
  return rate.norm() <= share * (M.norm() * speed + torque);
}

/// By how much the tensor and the start magnify errors.
template <Real Scalar>
Condition<Scalar> condition_of(const Prepared<Scalar>& of, const State<Scalar>& start) noexcept {
  const Scalar steady = start_sensitivity<Scalar>(start.angular_momentum, start.angular_velocity, of.wheels.inverse);
  return {condition_of(of.wheels),
          is_next_to_balance(of, start) ? std::max(steady, Scalar(honesty::unstable_condition)) : steady};
}

/// By how much the numbers of a companion's data differ, one after the other.
template <Real Scalar>
class Shifts {
 public:
  explicit Shifts(Aside aside) noexcept : aside_(aside) {}
  Scalar operator()() noexcept {
    turn_ = (turn_ + 1) % std::size(honesty::number_shifts[0]);
    return displacement<Scalar>(honesty::number_shifts, aside_, turn_);
  }
  Vec3<Scalar> vector() noexcept { return {(*this)(), (*this)(), (*this)()}; }

 private:
  Aside aside_;
  std::size_t turn_ = 3;
};

/// Whether zeros of the data stay zero by a symmetry: rotation about one axis of a diagonal tensor, along which all wheels and torques
/// are.
template <Real Scalar>
bool keeps_axis(const Problem<Scalar>& of) noexcept {
  if (!of.inertia.isDiagonal(0)) return false;
  const auto along = [](const Vec3<Scalar>& v, int k) noexcept { return v[(k + 1) % 3] == 0 && v[(k + 2) % 3] == 0; };
  for (int k = 0; k < 3; ++k) {
    bool kept = along(of.angular_velocity, k) && along(of.rotor_momentum, k);
    for (const auto& wheel : of.wheels) kept = kept && along(wheel.axis, k);
    for (const auto& torque : of.torques) {
      const bool fixed = torque.type == TorqueType::constant || torque.type == TorqueType::charge;
      const bool diagonal = torque.type == TorqueType::damping || torque.type == TorqueType::brake;
      kept = kept && ((fixed && torque.axes == Axes::body && along(torque.vector, k)) ||
                      (diagonal && torque.matrix.isDiagonal(0)));
    }
    if (kept) return true;
  }
  return false;
}

/// An attitude that is turned by what vectors round to that it turns, some times `amount`, about `axis`: where its products are small or zeros, they
/// lose less or nothing.
template <Real Scalar>
Quat<Scalar> attitude_beside(const Quat<Scalar>& of, Scalar amount, const Vec3<Scalar>& axis) noexcept {
  const Quat<Scalar> q = as_unit(of);
  const Vec3<Scalar> v{q.x, q.y, q.z};
  Vec3<Scalar> half;
  for (int i = 0; i < 3; ++i) {
    const Scalar products = std::abs(q.w * v[i]) + std::abs(v[(i + 1) % 3] * v[(i + 2) % 3]);
    half[i] = Scalar(honesty::attitude_turn) * amount * axis[i] *
              std::min(Scalar(1), Scalar(honesty::attitude_products) * products);
  }
  return half.isZero(0) ? of : q * Quat<Scalar>{1, half[0], half[1], half[2]};
}

/// Times off by `by`, s, so that what is on is so for longer, or shorter where it is negative.
template <Real Scalar>
void retime(std::vector<std::array<Scalar, 2>>& on, Scalar by) noexcept {
  Scalar before = -infinity<Scalar>;
  for (auto& [from, to] : on) {
    from = std::max(before, from - by);
    before = to = std::max(from, to + by);
  }
}
/// And so that what a table gives adds up to more, or less: its steps and slopes come later where they fall.
template <Real Scalar>
void retime(Table<Scalar>& table, Scalar by) noexcept {
  const std::size_t count = table.times.size(), width = count > 0 ? table.values.size() / count : 0;
  const auto sum_at = [&](std::size_t i) noexcept {
    Scalar sum = 0;
    for (std::size_t j = 0; i < count && j < width; ++j) sum += table.values[i * width + j];
    return sum;
  };
  Scalar before = -infinity<Scalar>;
  for (std::size_t i = 0; i < count; ++i) {
    const Scalar last = i > 0 ? sum_at(i - 1) : Scalar(0), next = sum_at(table.between == Between::step ? i : i + 1);
    const Scalar moved = table.times[i] + (last < next ? -by : by);
    before = table.times[i] = std::max(std::nextafter(before, infinity<Scalar>), moved);
  }
}

/// A problem that differs from the given one by about `amount`: by what rounding makes of data and arithmetic. What is exactly zero of a
/// wheel or torque stays so, and so do a body at rest and zeros that a symmetry keeps.
template <Real Scalar>
Problem<Scalar> beside(const Problem<Scalar>& of, Scalar amount, Aside aside) noexcept {
  Shifts<Scalar> shift(aside);
  Problem<Scalar> near = of;
  const bool kept = keeps_axis(of);
  const auto scale = [&](Scalar& x) noexcept { x *= 1 + amount / 2 * shift(); };
  const auto scale_vector = [&](Vec3<Scalar>& v) noexcept {
    for (int i = 0; i < 3; ++i) scale(v[i]);
  };
  const auto move = [&](Vec3<Scalar>& v) noexcept {
    const Scalar by = amount * v.cwiseAbs().maxCoeff();
    for (int i = 0; i < 3; ++i)
      if (const Scalar s = shift(); v[i] != 0 || !kept) v[i] += by * s;
  };
  Mat3<Scalar> change = moment_shifts<Scalar>(aside).asDiagonal();
  if (of.inertia.isDiagonal(0)) {
    near.inertia += amount * of.inertia * change;
  } else {
    for (int i = 0; i < 3; ++i) change(i, (i + 1) % 3) = change((i + 1) % 3, i) = shift();
    near.inertia += amount * of.inertia.cwiseAbs().maxCoeff() * change;
  }
  move(near.rotor_momentum), move(near.angular_velocity);
  // the equations keep M, which rounds beside what rotors hold: of a slow body that is most of its rate
  if (const Scalar held = momenta_of_wheels(of); held > 0 && !of.angular_velocity.isZero(0)) {
    const Vec3<Scalar> lost = Wheels<Scalar>::of(of).inverse * Vec3<Scalar>(amount / 2 * held * shift.vector());
    for (int i = 0; i < 3; ++i)
      if (of.angular_velocity[i] != 0 || !kept) near.angular_velocity[i] += lost[i];
  }
  if (!kept) {
    const auto wheels = Wheels<Scalar>::of(of);
    const Vec3<Scalar>& w = of.angular_velocity;
    const Vec3<Scalar> own = wheels.reduced * w, of_wheels = wheels.momentum_of_wheels();
    const Vec3<Scalar> leaving = leaving_direction<Scalar>(own + of_wheels, w, wheels.inverse);
    const Scalar size = std::max(own.cwiseAbs().maxCoeff(), of_wheels.cwiseAbs().maxCoeff());
    near.angular_velocity += wheels.inverse * leaving_shift(leaving, size, amount, aside);
  }
  for (auto& wheel : near.wheels) {
    if (!kept) {
      Vec3<Scalar> axis = wheel.axis + amount * cross<Scalar>(shift.vector(), wheel.axis);
      wheel.axis = axis.normalized();
    }
    scale(wheel.axial_inertia), scale(wheel.rate), scale(wheel.torque), scale(wheel.friction);
    scale(wheel.slope), scale(wheel.no_load_rate);
    for (Scalar& v : wheel.table.values) scale(v);
  }
  for (auto& torque : near.torques) {
    scale_vector(torque.vector), scale_vector(torque.point);
    for (int i = 0; i < 9; ++i) scale(torque.matrix(i));
    if (torque.gradient) scale(*torque.gradient);
    for (Scalar& v : torque.table.values) scale(v);
    for (Scalar& v : torque.factor.table.values) scale(v);
    scale(torque.factor.mean), scale(torque.factor.amplitude), scale(torque.factor.rate), scale(torque.factor.phase);
  }
  scale_vector(near.centre_of_mass), scale_vector(near.field.flux_density);
  scale(near.field.gravity), scale(near.field.rate), scale(near.field.strength), scale(near.mass);
  if (near.orbit) {
    scale(near.orbit->radius), scale(near.orbit->mu), scale(near.orbit->true_anomaly);
    if (Scalar e = of.orbit->eccentricity; scale(e), e < 1) near.orbit->eccentricity = e;
  }
  near.attitude = attitude_beside(of.attitude, amount, shift.vector());
  if (of.clock != 0) {
    // what went on before by rates that are known to rounding
    const auto late = [&]() noexcept { return amount / 2 * shift() * of.clock; };
    if (near.orbit) near.orbit = orbit_from(*near.orbit, late());
    // a rounding of theirs at least
    const Scalar by = aside == Aside::first ? 2 * of.retimed : -2 * of.retimed;
    for (auto& torque : near.torques) {
      if (torque.factor.amplitude != 0) torque.factor.phase += torque.factor.rate * late();
      if (by != 0) retime(torque.factor.on, by), retime(torque.factor.table, by), retime(torque.table, by);
    }
    // where a rate that is held steps the motion jumps, at asked times too
    for (auto& wheel : near.wheels)
      if (by != 0 && (wheel.type != WheelType::held || wheel.table.between != Between::step)) retime(wheel.table, by);
    if (near.field.magnetic == MagneticField::rotating)
      near.field.flux_density = field_at<Scalar>(near, late()).flux_density;
  }
  return near;
}

}  // namespace gyrostat::general::detail
