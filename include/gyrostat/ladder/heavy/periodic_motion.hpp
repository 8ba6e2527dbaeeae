// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/heavy/periodic_orbit.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/models/heavy/problem.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace gyrostat::heavy {

/// What a periodic motion at many periods comes to beside its states.
template <Real Scalar>
struct CarriedOn {
  ColumnErrors<Scalar> error;  ///< over the times, each relative to the greatest norm of its column
  Scalar precession =
      0;  ///< mean turn about the vertical, right-handed about DOWN, rad/s; NaN where the axis passes through it
  Scalar precession_error = 0;  ///< rad/s
};

/// Turn of axis 3 about the vertical from one state to another, right-handed about DOWN, rad: its tip goes along the cubic with their
/// positions and velocities. NaN where that comes nearer to the vertical than it is known.
template <Real Scalar>
Scalar axis_turn(const State<Scalar>& from, const State<Scalar>& to, Scalar time) noexcept {
  constexpr int parts = 32;
  const auto tip = [](const State<Scalar>& s) { return rotate<Scalar>(s.attitude, Vec3<Scalar>(0, 0, 1)); };
  const auto speed = [](const State<Scalar>& s) {
    return rotate<Scalar>(s.attitude, Vec3<Scalar>(s.angular_velocity[1], -s.angular_velocity[0], 0));
  };
  const Vec3<Scalar> a = tip(from), b = tip(to), u = time * speed(from), v = time * speed(to);
  const Scalar angle = time * std::max(from.angular_velocity.norm(), to.angular_velocity.norm());
  const Scalar unknown = 4 * std::pow(angle, 4) / 384 + Scalar(1e-5L);
  Scalar turned = 0, nearest = infinity<Scalar>;
  Vec3<Scalar> last = a;
  for (int i = 1; i <= parts; ++i) {
    const Scalar x = Scalar(i) / parts, rest = 1 - x;
    const Vec3<Scalar> now = rest * rest * (1 + 2 * x) * a + x * x * (3 - 2 * x) * b + x * rest * (rest * u - x * v);
    turned -= std::atan2(last[0] * now[1] - last[1] * now[0], last[0] * now[0] + last[1] * now[1]);
    nearest = std::min(nearest, std::hypot(now[0], now[1]));
    last = now;
  }
  return nearest > unknown ? turned : nan<Scalar>;
}

/// A periodic motion at times of many periods from the full equations over the first one: rates and down repeat, and the attitude gains the
/// same turn about the vertical in each. So errors grow in proportion to time, also where the motion is unstable.
template <Real Scalar>
class PeriodicMotion {
 public:
  /// @param times s, increasing, the first >= 0
  PeriodicMotion(const Problem<Scalar>& problem, const PeriodicOrbit<Scalar>& orbit, std::span<const Scalar> times)
      : problem_(problem), orbit_(orbit), place_(times.size()), turns_(times.size()) {
    const Scalar T = orbit.period;
    std::vector<Scalar> within(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      Scalar n = std::floor(times[i] / T), rest = std::fma(-n, T, times[i]);
      if (rest < 0) n -= 1, rest = std::max(rest + T, Scalar(0));
      if (!(rest < T)) n += 1, rest = 0;
      within[i] = rest;
      turns_[i] = n;
    }
    once_ = within;
    once_.reserve(times.size() + grid + 1);
    for (int k = 0; k <= grid; ++k) once_.push_back(T * Scalar(k) / grid);
    std::sort(once_.begin(), once_.end());
    once_.erase(std::unique(once_.begin(), once_.end()), once_.end());
    const auto find = [&](Scalar t) noexcept {
      return std::size_t(std::lower_bound(once_.begin(), once_.end(), t) - once_.begin());
    };
    for (std::size_t i = 0; i < times.size(); ++i) place_[i] = find(within[i]);
    for (int k = 0; k < grid; ++k) nodes_[k] = find(T * Scalar(k) / grid);
    periods_ = times.empty() ? Scalar(0) : times.back() / T;
  }

  /// In the first period, increasing, its start and end among them: where the motion from the orbit's start is needed, with attitude.
  const std::vector<Scalar>& once() const noexcept { return once_; }
  Scalar periods() const noexcept { return periods_; }  ///< up to the last time

  /// @param first the motion at once()   @param error of it, as its columns measure it   @param states at the times
  CarriedOn<Scalar> carry_on(std::span<const State<Scalar>> first, const ColumnErrors<Scalar>& error,
                             std::span<State<Scalar>> states) const noexcept {
    CarriedOn<Scalar> made;
    const Row<Scalar> row{scales(problem_, orbit_.start.angular_velocity[2])};
    Comparison<Row<Scalar>> once(row), sizes(row);
    Scalar fastest = 0, steepest = 0, turned_axis = 0;
    for (const State<Scalar>& s : first) {
      once.add(s);
      fastest = std::max(fastest, s.angular_velocity.norm());
      steepest = std::max(steepest, angular_acceleration<Scalar>(problem_, s.angular_velocity, s.down).norm());
    }
    for (int k = 0; k < grid; ++k) {
      const std::size_t next = k + 1 < grid ? nodes_[k + 1] : first.size() - 1;
      turned_axis += axis_turn(first[nodes_[k]], first[next], orbit_.period / grid);
    }
    const Quat<Scalar> gained = first.back().attitude * conjugate(first.front().attitude);
    const Scalar half = std::atan2(gained.z, gained.w), T = orbit_.period;

    for (std::size_t i = 0; i < states.size(); ++i) {
      states[i] = first[place_[i]];
      const Scalar by = turns_[i] * half;
      states[i].attitude = Quat<Scalar>{std::cos(by), 0, 0, std::sin(by)} * states[i].attitude;
      sizes.add(states[i]);
    }
    const Scalar rate = rate_size(problem_, orbit_.start);
    // what an error of the start becomes within a period
    const Scalar start = orbit_.error.start * (16 + 4 * std::abs(orbit_.trace_minus_4));
    const Scalar late = orbit_.error.period * T * (1 + periods_);
    const Scalar of_turn = 8 * epsilon<Scalar> * (1 + std::abs(half)), rounding = (1 + periods_) * of_turn;
    const Scalar turned = error[column::attitude] + start;
    made.error =
        relative_to_truth(sizes.relative({error[column::angular_velocity] * once.unit(column::angular_velocity) +
                                              rate * start + steepest * late,
                                          error[column::down] + start + fastest * late + rounding,
                                          (1 + periods_) * turned + fastest * late + rounding}),
                          column_kinds);

    // right-handed about DOWN, and the whole turns from the path of the axis
    const Scalar branch = std::nearbyint((turned_axis + 2 * half) / (2 * pi<Scalar>));
    const Scalar psi = 2 * pi<Scalar> * branch - 2 * half;
    made.precession = std::abs(psi - turned_axis) < Scalar(0.1L) ? psi / T : nan<Scalar>;
    // at another period the body has turned further about the vertical by its rate about it
    const Scalar about_down = std::abs(orbit_.start.angular_velocity.dot(orbit_.start.down));
    made.precession_error = (turned + of_turn) / T + (about_down + std::abs(made.precession)) * orbit_.error.period;
    return made;
  }

 private:
  static constexpr int grid = 128;
  const Problem<Scalar>& problem_;
  const PeriodicOrbit<Scalar>& orbit_;
  std::vector<Scalar> once_;
  std::vector<std::size_t> place_;
  std::vector<Scalar> turns_;
  std::size_t nodes_[grid] = {};
  Scalar periods_ = 0;
};

}  // namespace gyrostat::heavy
