// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/general/scene.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/rotation/quaternion.hpp"

/// What an error of the start makes of an answer.
namespace gyrostat::general {

namespace detail {

/// The greatest distance of two answers to one question in a column, in its unit, or rad.
GYROSTAT_COMPILED_ONCE double apart(const Column& one, const Column& other) noexcept;

/// The ways in which a start may be off: turned about an axis of the body, turning faster about one, a wheel turning faster. The path and the
/// angles of wheels only go along.
struct Displacement {
  enum : std::uint8_t { turn, rate, wheel } what;
  int place;

  double of(const StartError& error) const noexcept {
    return what == turn ? error.attitude : what == rate ? error.angular_velocity : error.rotor_rate;
  }
  /// The least displacement that shows well over rounding, and makes no large angle in the time.
  double least(const Scene& scene) const noexcept {
    constexpr double angle = 1e-4;
    return what == turn ? angle : angle / std::max(scene.question().times.back(), 1 / scene.sizes().turning);
  }
  Problem<double> applied(const Problem<double>& to, double by) const noexcept {
    Problem<double> made = to;
    if (what == rate) made.angular_velocity[place] += by;
    if (what == wheel) made.wheels[std::size_t(place)].rate += by;
    if (what == turn) {
      const Vec3<double> half = by / 2 * Vec3<double>::Unit(place);
      made.attitude = normalised(to.attitude * Quat<double>{1, half[0], half[1], half[2]});
    }
    return made;
  }
};

/// Whether no torque or force knows how the body is turned: then the whole motion only is turned with its start.
GYROSTAT_COMPILED_ONCE bool turns_along(const Problem<double>& problem) noexcept;

inline bool turns_along(const Scene& scene) noexcept {
  return !scene.own_torque().any() && turns_along(scene.problem());
}

GYROSTAT_COMPILED_ONCE std::vector<Displacement> displacements(const Scene& scene);

}  // namespace detail

/// By how much the columns of an answer, and its stop time, may be off because its start is, in their units.
struct Carried {
  std::vector<double> columns;
  double stop_time = 0;
};

/// Displaces the start in each way by itself, to both sides, and gathers what comes of it, in squares over the directions of one error, or over
/// the wheels: to first order no error of the start within its bounds makes more. Where the two sides differ the greater counts, and their
/// difference once more.
/// solve(scene) answers from another start: an optional Answer. A displacement that is larger than the error makes it stand out of
/// the errors of the answers themselves; where it grows so far that nothing is proportional any more the error itself is taken.
template <class Solve>
Carried carried_error(const Scene& scene, const Answer& answer, const Solve& solve) {
  constexpr double small = 0.05;  // of an angle, rad, or of a column
  const StartError& start = scene.start_error();
  Carried made;
  made.columns.assign(answer.columns.size(), 0);
  const Quantity* stop = answer.quantity("stop_time");
  std::array<Carried, 3> squares;
  squares.fill(made);
  for (const detail::Displacement& way : detail::displacements(scene)) {
    const double error = way.of(start);
    std::vector<double> apart(answer.columns.size()), least(apart.size(), infinity<double>);
    double stop_apart = 0;
    // false: nothing to be read from it
    const auto to_one_side = [&](double by) {
      const std::optional<Answer> other = solve(way.applied(scene.problem(), by));
      if (!other) return false;
      bool proportional = true;
      for (std::size_t i = 0; i < answer.columns.size(); ++i) {
        const Column& column = answer.columns[i];
        const Column* beside = other->find(column.name());
        if (!beside || beside->values.size() != column.values.size()) return false;
        const double off = detail::apart(column, *beside);
        proportional =
            proportional && !(over(off, column.kind->measure == Measure::angle ? 1.0 : size_of(column)) > small);
        const double made_of_it = std::isfinite(off) ? off * error / std::abs(by) : infinity<double>;
        apart[i] = std::max(apart[i], made_of_it);
        least[i] = std::min(least[i], made_of_it);
      }
      if (const Quantity* its = other->quantity("stop_time"); stop && its)
        stop_apart = std::max(stop_apart, std::abs(stop->values[0] - its->values[0]) * error / std::abs(by));
      return proportional || std::abs(by) == error;
    };
    const auto displaced = [&](double by) {
      std::fill(apart.begin(), apart.end(), 0), std::fill(least.begin(), least.end(), infinity<double>), stop_apart = 0;
      if (!to_one_side(by) || !to_one_side(-by)) return false;
      for (std::size_t i = 0; i < apart.size(); ++i)
        if (apart[i] < infinity<double>) apart[i] += apart[i] - least[i];
      return true;
    };
    const double by = std::max(error, way.least(scene));
    if (!displaced(by) && !(by > error && displaced(error)))
      std::fill(apart.begin(), apart.end(), infinity<double>), stop_apart = infinity<double>;
    Carried& sum = squares[std::size_t(way.what)];
    const auto add = [&](double& square, double more) { square += more * more; };
    for (std::size_t i = 0; i < apart.size(); ++i) add(sum.columns[i], apart[i]);
    add(sum.stop_time, stop_apart);
  }
  for (const Carried& sum : squares) {
    for (std::size_t i = 0; i < sum.columns.size(); ++i) made.columns[i] += std::sqrt(sum.columns[i]);
    made.stop_time += std::sqrt(sum.stop_time);
  }
  const bool turned = detail::turns_along(scene) && !scene.gives(column::euler);
  for (std::size_t i = 0; i < answer.columns.size(); ++i) {
    const auto place = std::size_t(answer.columns[i].kind - column_kinds);
    if (turned && answer.columns[i].kind->measure == Measure::angle) made.columns[i] += start.attitude;
    if (turned && place == column::angular_momentum_inertial)
      made.columns[i] += start.attitude * size_of(answer.columns[i]);
    if (place == column::rotor_angle) made.columns[i] += start.rotor_angle;
    if (place == column::velocity) made.columns[i] += start.velocity;
    if (place == column::position) made.columns[i] += start.position + start.velocity * scene.question().times.back();
  }
  return made;
}

/// Adds what was carried on to the errors that an answer states.
GYROSTAT_COMPILED_ONCE void add_carried(Answer& answer, const Carried& carried) noexcept;

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/start_error_definition.hpp"
#endif
