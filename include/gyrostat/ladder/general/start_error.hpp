// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/general/scene.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/rotation/quaternion.hpp"

/// What an error of the start makes of an answer.
namespace gyrostat::general {

namespace detail {

/// The greatest distance of two answers to one question in a column, in its unit, or rad.
inline double apart(const Column& one, const Column& other) noexcept {
  const auto width = std::size_t(one.row_width());
  double most = 0;
  for (std::size_t at = 0; at + width <= one.values.size(); at += width) {
    const double *x = &one.values[at], *y = &other.values[at];
    double square = 0;
    for (std::size_t i = 0; i < width; ++i) square += (x[i] - y[i]) * (x[i] - y[i]);
    const bool turns = one.kind->measure == Measure::angle && width == 4;
    most = greater(
        turns ? angle_between<double>({x[3], x[0], x[1], x[2]}, {y[3], y[0], y[1], y[2]}) : std::sqrt(square), most);
  }
  return most;
}

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
inline bool turns_along(const Problem<double>& problem) noexcept {
  return std::all_of(problem.torques.begin(), problem.torques.end(), [](const auto& torque) {
    switch (torque.type) {
      case TorqueType::constant:
      case TorqueType::table: return torque.axes == Axes::body;
      case TorqueType::damping:
      case TorqueType::brake:
      case TorqueType::charge: return true;
      default: return false;
    }
  });
}

inline bool turns_along(const Scene& scene) noexcept {
  return !scene.own_torque().any() && turns_along(scene.problem());
}

inline std::vector<Displacement> displacements(const Scene& scene) {
  std::vector<Displacement> made;
  const auto& error = scene.start_error();
  const bool turns = error.attitude > 0 && !turns_along(scene);
  for (int i = 0; i < 3; ++i) {
    if (turns) made.push_back({Displacement::turn, i});
    if (error.angular_velocity > 0) made.push_back({Displacement::rate, i});
  }
  if (error.rotor_rate > 0)
    for (std::size_t i = 0; i < scene.wheels().count; ++i)
      if (const auto& law = scene.wheels().laws[i]; law.follows != Follows::body && !law.tabled)
        made.push_back({Displacement::wheel, int(i)});
  return made;
}

}  // namespace detail

/// By how much the columns of an answer, and its stop time, may be off because its start is, in their units.
struct Carried {
  std::vector<double> columns;
  double stop_time = 0;
};

/// Displaces the start in each way by itself, and gathers what comes of it, in squares over the directions of one error: to first order no
/// error of the start within its bounds makes more.
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
    std::vector<double> apart(answer.columns.size());
    double stop_apart = 0;
    // false: nothing to be read from it
    const auto displaced = [&](double by) {
      const std::optional<Answer> other = solve(way.applied(scene.problem(), by));
      if (!other) return false;
      bool proportional = true;
      for (std::size_t i = 0; i < answer.columns.size(); ++i) {
        const Column& column = answer.columns[i];
        const Column* beside = other->find(column.name());
        if (!beside || beside->values.size() != column.values.size()) return false;
        apart[i] = detail::apart(column, *beside);
        proportional =
            proportional && !(over(apart[i], column.kind->measure == Measure::angle ? 1.0 : size_of(column)) > small);
        apart[i] *= error / by;
      }
      if (const Quantity* its = other->quantity("stop_time"); stop && its)
        stop_apart = std::abs(stop->values[0] - its->values[0]) * error / by;
      return proportional || by == error;
    };
    const double by = std::max(error, way.least(scene));
    if (!displaced(by) && !(by > error && displaced(error)))
      std::fill(apart.begin(), apart.end(), infinity<double>), stop_apart = infinity<double>;
    Carried& sum = squares[std::size_t(way.what)];
    for (std::size_t i = 0; i < apart.size(); ++i) sum.columns[i] += apart[i] * apart[i];
    sum.stop_time += stop_apart * stop_apart;
  }
  for (const Carried& sum : squares) {
    for (std::size_t i = 0; i < sum.columns.size(); ++i) made.columns[i] += std::sqrt(sum.columns[i]);
    made.stop_time += std::sqrt(sum.stop_time);
  }
  const bool turned = detail::turns_along(scene);
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
inline void add_carried(Answer& answer, const Carried& carried) noexcept {
  for (std::size_t i = 0; i < answer.columns.size(); ++i) {
    Column& column = answer.columns[i];
    const bool relative = column.kind->measure == Measure::relative;
    column.error += relative ? over(carried.columns[i], size_of(column)) : carried.columns[i];
  }
  for (Quantity& quantity : answer.quantities)
    if (quantity.kind == &scalar_kinds[scalar::stop_time])
      quantity.error += over(carried.stop_time, std::abs(quantity.values[0]));
}

}  // namespace gyrostat::general
