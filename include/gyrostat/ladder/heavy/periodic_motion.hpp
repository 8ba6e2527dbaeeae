// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
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
    Scalar fastest = 0, steepest = 0, mean = 0;
    for (const State<Scalar>& s : first) {
      once.add(s);
      fastest = std::max(fastest, s.angular_velocity.norm());
      steepest = std::max(steepest, angular_acceleration<Scalar>(problem_, s.angular_velocity, s.down).norm());
    }
    for (const std::size_t node : nodes_) {
      const auto &w = first[node].angular_velocity, &d = first[node].down;
      mean += (w[0] * d[0] + w[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]) / grid;
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
    const Scalar rounding = 8 * epsilon<Scalar> * (1 + periods_ * (1 + std::abs(half)));
    const Scalar turned = error[column::attitude] + start + rounding;
    made.error = relative_to_truth(
        sizes.relative(
            {error[column::angular_velocity] * once.unit(column::angular_velocity) + rate * start + steepest * late,
             error[column::down] + start + fastest * late + rounding, (1 + periods_) * turned + fastest * late}),
        column_kinds);

    // right-handed about DOWN, and the branch from the mean of psi'
    const Scalar branch = std::nearbyint((mean * T + 2 * half) / (2 * pi<Scalar>));
    const Scalar psi = 2 * pi<Scalar> * branch - 2 * half;
    made.precession = std::abs(psi - mean * T) < 1 ? psi / T : nan<Scalar>;
    // at another period the body has turned further about the vertical by its rate about it
    const Scalar about_down = std::abs(orbit_.start.angular_velocity.dot(orbit_.start.down));
    made.precession_error = turned / T + (about_down + std::abs(made.precession)) * orbit_.error.period;
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
