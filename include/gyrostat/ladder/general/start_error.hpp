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

/// By how much two answers to one question are apart in a column: row after row, differences in its unit, or of a quaternion the turn from the one to the
/// other, rad.
struct Apart {
  std::size_t width;
  std::vector<double> values;

  GYROSTAT_COMPILED_ONCE static Apart of(const Column& one, const Column& other);
  double length(std::size_t row) const noexcept {
    double square = 0;
    for (std::size_t i = 0; i < width; ++i) square += values[row * width + i] * values[row * width + i];
    return std::sqrt(square);
  }
};

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

namespace detail {

/// The times at which displaced motions are compared: the asked ones, of very many of these a part, and of a few some on the way as well.
struct Watch {
  std::vector<double> times;
  std::vector<bool> asked;

  explicit Watch(const std::vector<double>& question) {
    constexpr std::size_t few = 64, parts = 32, most = 4096;
    const std::size_t n = question.size(), kept = std::min(n, most);
    for (std::size_t i = 0; i < kept; ++i) times.push_back(question[kept < n ? i * (n - 1) / (kept - 1) : i]);
    const std::vector<double> told = times;
    if (n < few) {
      for (std::size_t i = 0; i < parts; ++i) times.push_back(question.front() * double(i) / double(parts));
      for (std::size_t i = 1; i < parts; ++i)
        times.push_back(question.front() + (question.back() - question.front()) * double(i) / double(parts));
      std::sort(times.begin(), times.end());
      times.erase(std::unique(times.begin(), times.end()), times.end());
    }
    for (const double t : times) asked.push_back(std::binary_search(told.begin(), told.end(), t));
  }
};

/// What a displacement to both sides makes of the columns of an answer, in their units: for each column the part that is in proportion to it, and
/// the part that is the same to both sides.
struct Response {
  std::vector<Apart> odd, even;
  double stop_time = 0;  ///< the greater change

  /// The greatest change of column i to each side, at the asked times, or at all: the greater and the lesser.
  std::array<double, 2> most(std::size_t i, const std::vector<bool>& asked, bool all) const noexcept {
    std::array<double, 2> sides{};
    const Apart &x = odd[i], &y = even[i];
    for (std::size_t row = 0; row < asked.size(); ++row) {
      if (!all && !asked[row]) continue;
      std::array<double, 2> squares{};
      for (std::size_t k = row * x.width; k < (row + 1) * x.width; ++k) {
        squares[0] += (y.values[k] + x.values[k]) * (y.values[k] + x.values[k]);
        squares[1] += (y.values[k] - x.values[k]) * (y.values[k] - x.values[k]);
      }
      for (const int side : {0, 1}) sides[side] = greater(std::sqrt(squares[side]), sides[side]);
    }
    return {greater(sides[0], sides[1]), std::min(sides[0], sides[1])};
  }
};

/// Signs of the k-th of the joint displacements.
constexpr double joint_sign(std::size_t k, std::size_t way) noexcept {
  constexpr unsigned signs[] = {0b0000'0000'0000, 0b0110'1001'0110, 0b0101'0011'1010, 0b0011'1100'0101};
  return signs[k % 4] >> (way % 12) & 1 ? -1 : 1;
}
inline constexpr std::size_t joint_displacements = 4;

}  // namespace detail

/// Displaces the start in each way by itself, to both sides, and gathers what comes of it, in squares over the directions of one error, or over
/// the wheels: to first order no error of the start within its bounds makes more. Where the two sides differ the greater counts, and their
/// difference once more. What no way makes by itself but two do together shows where the start is displaced in all ways at once.
/// solve(start, times) answers from another start: an optional Answer. A displacement that is larger than the error makes it stand out of
/// the errors of the answers themselves; where it grows so far that nothing is proportional any more, at the asked times or on the way to them, the error
/// itself is taken, and what it makes on the way counts too: motions that part may be near again at an asked time.
template <class Solve>
Carried carried_error(const Scene& scene, const Answer& answer, const Solve& solve) {
  constexpr double small = 0.05;  // of an angle, rad, or of a column
  const std::size_t columns = answer.columns.size();
  const StartError& start = scene.start_error();
  Carried made;
  made.columns.assign(columns, 0);
  const auto lost = [&] {
    std::fill(made.columns.begin(), made.columns.end(), infinity<double>), made.stop_time = infinity<double>;
    return made;
  };
  const std::vector<detail::Displacement> ways = detail::displacements(scene);
  const detail::Watch watch(scene.question().times);
  const std::optional<Answer> middle = ways.empty() ? answer : solve(scene.problem(), watch.times);
  if (!middle) return lost();
  const Quantity* stop = middle->quantity("stop_time");
  std::vector<double> sizes;
  for (const Column& column : answer.columns) {
    const Column* whole = middle->find(column.name());
    if (!whole) return lost();
    sizes.push_back(whole->kind->measure == Measure::angle ? 1.0 : size_of(*whole));
  }
  struct Off {
    std::vector<detail::Apart> columns;
    double stop_time = 0;
  };
  const auto off = [&](const Problem<double>& from) -> std::optional<Off> {
    const std::optional<Answer> other = solve(from, watch.times);
    if (!other) return std::nullopt;
    Off apart;
    for (const Column& column : answer.columns) {
      const Column *one = middle->find(column.name()), *beside = other->find(column.name());
      if (!beside || !one || beside->values.size() != one->values.size()) return std::nullopt;
      apart.columns.push_back(detail::Apart::of(*one, *beside));
    }
    if (const Quantity* its = other->quantity("stop_time"); stop && its)
      apart.stop_time = std::abs(stop->values[0] - its->values[0]);
    return apart;
  };
  bool straight = true;  // all is in proportion to the error, and asked times tell all
  const auto response = [&](const detail::Displacement& way, double by) -> std::optional<detail::Response> {
    const auto more = off(way.applied(scene.problem(), by)), less = off(way.applied(scene.problem(), -by));
    if (!more || !less) return std::nullopt;
    detail::Response of;
    of.stop_time = std::max(more->stop_time, less->stop_time);
    for (std::size_t i = 0; i < columns; ++i) {
      detail::Apart odd = more->columns[i], even = odd;
      for (std::size_t k = 0; k < odd.values.size(); ++k) {
        const double a = odd.values[k], b = less->columns[i].values[k];
        odd.values[k] = (a - b) / 2, even.values[k] = (a + b) / 2;
      }
      of.odd.push_back(std::move(odd)), of.even.push_back(std::move(even));
    }
    return of;
  };
  const auto is_small = [&](const detail::Response& of) noexcept {
    bool all = true;
    for (std::size_t i = 0; i < columns; ++i) all = all && !(over(of.most(i, watch.asked, true)[0], sizes[i]) > small);
    return all;
  };

  std::vector<detail::Response> seen;
  std::vector<double> taken;
  for (const detail::Displacement& way : ways) {
    const double error = way.of(start);
    double by = std::max(error, way.least(scene));
    auto of = response(way, by);
    if (by > error && !(of && is_small(*of))) by = error, of = response(way, by);
    if (!of) return lost();
    straight = straight && is_small(*of);
    seen.push_back(std::move(*of)), taken.push_back(by);
  }
  std::array<Carried, 3> squares;
  squares.fill(made);
  double share = 0;
  for (std::size_t w = 0; w < ways.size(); ++w) {
    const double part = ways[w].of(start) / taken[w];
    share = std::max(share, part);
    Carried& sum = squares[std::size_t(ways[w].what)];
    const auto add = [&](double& square, double more) { square += more * more; };
    for (std::size_t i = 0; i < columns; ++i) {
      const auto [most, least] = seen[w].most(i, watch.asked, !straight);
      add(sum.columns[i], std::isfinite(most) ? part * (2 * most - least) : infinity<double>);
    }
    add(sum.stop_time, part * seen[w].stop_time);
  }
  for (const Carried& sum : squares) {
    for (std::size_t i = 0; i < columns; ++i) made.columns[i] += std::sqrt(sum.columns[i]);
    made.stop_time += std::sqrt(sum.stop_time);
  }
  // all ways at once, each of the directions of one error by a part, so that two of them stay within it
  std::vector<double> together(columns);
  for (std::size_t k = 0; ways.size() > 1 && k < detail::joint_displacements; ++k) {
    const auto part = [&](std::size_t w) {
      return (ways[w].what == detail::Displacement::wheel ? 1 : std::sqrt(0.5)) * detail::joint_sign(k, w);
    };
    Problem<double> from = scene.problem();
    for (std::size_t w = 0; w < ways.size(); ++w) from = ways[w].applied(from, part(w) * taken[w]);
    auto left = off(from);
    if (!left) return lost();
    for (std::size_t i = 0; i < columns; ++i) {
      detail::Apart& rest = left->columns[i];
      for (std::size_t w = 0; w < ways.size(); ++w)
        for (std::size_t n = 0; n < rest.values.size(); ++n)
          rest.values[n] -= part(w) * (seen[w].odd[i].values[n] + part(w) * seen[w].even[i].values[n]);
      double most = 0;
      for (std::size_t row = 0; row < watch.asked.size(); ++row)
        if (!straight || watch.asked[row]) most = greater(rest.length(row), most);
      together[i] += most * most / double(detail::joint_displacements);
    }
  }
  constexpr double margin = 2;  // several pairs may add up as the four displacements do not show
  for (std::size_t i = 0; i < columns; ++i) made.columns[i] += margin * share * share * std::sqrt(together[i]);

  const bool turned = detail::turns_along(scene) && !scene.gives(column::euler);
  for (std::size_t i = 0; i < columns; ++i) {
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
