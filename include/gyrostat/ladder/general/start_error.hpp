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

/// By how much the columns of an answer, and its stop time, may be off because its start is, in their units.
struct Carried {
  std::vector<double> columns;
  double stop_time = 0;
};

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
  double by = 0;         ///< the displacement
  double stop_time = 0;  ///< the greater change

  /// The greatest change of column i to each side, at the asked times, or at all: the greater and the lesser.
  std::array<double, 2> most(std::size_t i, const std::vector<bool>& asked, bool all) const noexcept {
    double sides[2] = {};
    const Apart &x = odd[i], &y = even[i];
    for (std::size_t row = 0; row < asked.size(); ++row) {
      if (!all && !asked[row]) continue;
      double squares[2] = {};
      for (std::size_t k = row * x.width; k < (row + 1) * x.width; ++k) {
        squares[0] += (y.values[k] + x.values[k]) * (y.values[k] + x.values[k]);
        squares[1] += (y.values[k] - x.values[k]) * (y.values[k] - x.values[k]);
      }
      for (const int side : {0, 1}) sides[side] = greater(std::sqrt(squares[side]), sides[side]);
    }
    return {greater(sides[0], sides[1]), std::min(sides[0], sides[1])};
  }
};

/// A displaced answer against the one of the start as it is.
struct Off {
  std::vector<Apart> columns;
  double stop_time = 0;
};

/// Answers from displaced starts. solve(start, times): an optional Answer.
template <class Solve>
class Displaced {
 public:
  Displaced(const Scene& scene, const Answer& answer, const Solve& solve)
      : scene_(scene),
        answer_(answer),
        solve_(solve),
        watch_(scene.question().times),
        middle_(solve(scene.problem(), watch_.times)) {
    for (const Column& column : answer.columns) {
      const Column* whole = middle_ ? middle_->find(column.name()) : nullptr;
      if (whole == nullptr) {
        middle_.reset();
        return;
      }
      sizes_.push_back(whole->kind->measure == Measure::angle ? 1.0 : size_of(*whole));
    }
  }
  /// Whether there is an answer of the start as it is.
  bool known() const noexcept { return middle_.has_value(); }
  const std::vector<bool>& asked() const noexcept { return watch_.asked; }

  std::optional<Off> off(const Problem<double>& from) const {
    const std::optional<Answer> other = solve_(from, watch_.times);
    if (!other) return std::nullopt;
    Off apart;
    for (const Column& column : answer_.columns) {
      const Column *one = middle_->find(column.name()), *beside = other->find(column.name());
      if (!beside || beside->values.size() != one->values.size()) return std::nullopt;
      apart.columns.push_back(Apart::of(*one, *beside));
    }
    const Quantity *stop = middle_->quantity("stop_time"), *its = other->quantity("stop_time");
    if (stop && its) apart.stop_time = std::abs(stop->values[0] - its->values[0]);
    return apart;
  }
  std::optional<Response> response(const Displacement& way, double by) const {
    auto more = off(way.applied(scene_.problem(), by));
    const auto less = off(way.applied(scene_.problem(), -by));
    if (!more || !less) return std::nullopt;
    Response of{std::move(more->columns), {}, by, std::max(more->stop_time, less->stop_time)};
    of.even = of.odd;
    for (std::size_t i = 0; i < of.odd.size(); ++i)
      for (std::size_t k = 0; k < of.odd[i].values.size(); ++k) {
        const double a = of.odd[i].values[k], b = less->columns[i].values[k];
        of.odd[i].values[k] = (a - b) / 2, of.even[i].values[k] = (a + b) / 2;
      }
    return of;
  }
  /// Whether all changes are small, on the way too, so that they are in proportion to the error and asked times tell all.
  bool is_small(const Response& of) const noexcept {
    constexpr double small = 0.05;  // of an angle, rad, or of a column
    for (std::size_t i = 0; i < sizes_.size(); ++i)
      if (over(of.most(i, watch_.asked, true)[0], sizes_[i]) > small) return false;
    return true;
  }
  /// By the error itself, or by more where that stands out of the errors of the answers and is small still.
  std::optional<Response> response(const Displacement& way) const {
    const double error = way.of(scene_.start_error()), more = way.least(scene_);
    if (more > error) {
      auto of = response(way, more);
      if (of && is_small(*of)) return of;
    }
    return response(way, error);
  }

 private:
  const Scene& scene_;
  const Answer& answer_;
  const Solve& solve_;
  Watch watch_;
  std::optional<Answer> middle_;
  std::vector<double> sizes_;
};

/// Of a displacement in all ways at once, the k-th of some, by what part of that of one way it goes along this one: two of the directions of one error
/// stay within it.
inline constexpr std::size_t joint_displacements = 4;
inline double joint_part(std::size_t k, const Displacement& way, std::size_t place) noexcept {
  constexpr unsigned signs[joint_displacements] = {0b0000'0000'0000, 0b0110'1001'0110, 0b0101'0011'1010,
                                                   0b0011'1100'0101};
  const double part = way.what == Displacement::wheel ? 1 : std::sqrt(0.5);
  return signs[k] >> (place % 12) & 1 ? -part : part;
}

/// What displacements in all ways at once do to column after column beyond what each does: the root of the mean square, in their units, of displacements
/// as they were made. Nothing where one has no answer.
template <class Solve>
std::optional<std::vector<double>> done_together(const Scene& scene, const Displaced<Solve>& displaced,
                                                 const std::vector<Displacement>& ways,
                                                 const std::vector<Response>& alone, bool on_the_way) {
  std::vector<double> made(alone[0].odd.size());
  for (std::size_t k = 0; k < joint_displacements; ++k) {
    Problem<double> from = scene.problem();
    for (std::size_t w = 0; w < ways.size(); ++w) from = ways[w].applied(from, joint_part(k, ways[w], w) * alone[w].by);
    auto left = displaced.off(from);
    if (!left) return std::nullopt;
    for (std::size_t i = 0; i < made.size(); ++i) {
      Apart& rest = left->columns[i];
      for (std::size_t w = 0; w < ways.size(); ++w) {
        const double part = joint_part(k, ways[w], w);
        for (std::size_t n = 0; n < rest.values.size(); ++n)
          rest.values[n] -= part * (alone[w].odd[i].values[n] + part * alone[w].even[i].values[n]);
      }
      double most = 0;
      for (std::size_t row = 0; row < displaced.asked().size(); ++row)
        if (on_the_way || displaced.asked()[row]) most = greater(rest.length(row), most);
      made[i] += most * most / double(joint_displacements);
    }
  }
  for (double& square : made) square = std::isfinite(square) ? std::sqrt(square) : infinity<double>;
  return made;
}

/// What of a start's errors only goes along.
GYROSTAT_COMPILED_ONCE void add_what_goes_along(Carried& carried, const Scene& scene, const Answer& answer) noexcept;

}  // namespace detail

/// Displaces the start in each way by itself, to both sides, and gathers what comes of it, in squares over the directions of one error, or over
/// the wheels: to first order no error of the start within its bounds makes more. Where the two sides differ the greater counts, and their
/// difference once more. What no way makes by itself but two do together shows where the start is displaced in all ways at once.
/// solve(start, times) answers from another start: an optional Answer. A displacement that is larger than the error makes it stand out of
/// the errors of the answers themselves; where it grows so far that nothing is proportional any more, at the asked times or on the way to them, the error
/// itself is taken, and what it makes on the way counts too: motions that part may be near again at an asked time.
template <class Solve>
Carried carried_error(const Scene& scene, const Answer& answer, const Solve& solve) {
  const std::size_t columns = answer.columns.size();
  Carried made{std::vector<double>(columns, 0.0), 0};
  const Carried lost{std::vector<double>(columns, infinity<double>), infinity<double>};
  const std::vector<detail::Displacement> ways = detail::displacements(scene);
  if (!ways.empty()) {
    const detail::Displaced displaced(scene, answer, solve);
    if (!displaced.known()) return lost;
    std::vector<detail::Response> alone;
    bool on_the_way = false;
    for (const auto& way : ways) {
      auto of = displaced.response(way);
      if (!of) return lost;
      on_the_way = on_the_way || !displaced.is_small(*of);
      alone.push_back(std::move(*of));
    }
    std::array<Carried, 3> squares;
    squares.fill(made);
    double share = 0;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const double part = ways[w].of(scene.start_error()) / alone[w].by;
      share = std::max(share, part);
      Carried& sum = squares[std::size_t(ways[w].what)];
      const auto add = [&](double& square, double more) { square += more * more; };
      for (std::size_t i = 0; i < columns; ++i) {
        const auto [most, least] = alone[w].most(i, displaced.asked(), on_the_way);
        add(sum.columns[i], std::isfinite(most) ? part * (2 * most - least) : infinity<double>);
      }
      add(sum.stop_time, part * alone[w].stop_time);
    }
    for (const Carried& sum : squares) {
      for (std::size_t i = 0; i < columns; ++i) made.columns[i] += std::sqrt(sum.columns[i]);
      made.stop_time += std::sqrt(sum.stop_time);
    }
    if (ways.size() > 1) {
      const auto together = detail::done_together(scene, displaced, ways, alone, on_the_way);
      if (!together) return lost;
      constexpr double margin = 2;  // several pairs may add up as these displacements do not show
      for (std::size_t i = 0; i < columns; ++i) made.columns[i] += margin * share * share * (*together)[i];
    }
  }
  detail::add_what_goes_along(made, scene, answer);
  return made;
}

/// Adds what was carried on to the errors that an answer states.
GYROSTAT_COMPILED_ONCE void add_carried(Answer& answer, const Carried& carried) noexcept;

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/start_error_definition.hpp"
#endif
