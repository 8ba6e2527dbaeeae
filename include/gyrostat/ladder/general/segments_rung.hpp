// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/general/full_rung.hpp"
#include "gyrostat/ladder/general/special_rung.hpp"
#include "gyrostat/ladder/general/start_error.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/rung.hpp"
#include "gyrostat/models/general/collected.hpp"
#include "gyrostat/models/general/right_side.hpp"
#include "gyrostat/models/general/table.hpp"

/// A motion in segments between the times at which torques or wheels change, where each of them is an instance of a family: each begins at the end
/// of the one before, and carries its error on.
namespace gyrostat::general {

inline constexpr std::size_t most_segments = 64;

inline constexpr const char* not_in_segments =
    "not steady between the times at which something changes, or no instance of a family there";

inline constexpr const char* too_many_segments =
    "something changes at more than 63 times, and each segment carries the error of the one before: ask for full";

/// Segments that are foreseen to take longer, s, are not begun.
inline constexpr double longest_segments = 30;
inline constexpr const char* too_long_in_segments =
    "the body turns so often that its segments, each with its neighbours, would take minutes: ask for full, or for a "
    "shorter span";

inline constexpr const char* errors_grew =
    "the error of one segment leaves too little known of where the next begins; the full equations go through all at "
    "once";

/// What holds between two breakpoints, by a clock that begins with it. The start is that of the whole.
struct Segment {
  double from, to;  ///< s
  Problem<double> problem;
};

/// Costs beyond those of the full equations, measured: `each`, s a segment, for its scene, for finding families and for handing
/// errors on; `share`, the factor on what its rungs cost alone, as tighter tolerances are asked of them.
struct SegmentCost {
  double each, share;
};
inline constexpr SegmentCost segment_cost{300e-6, 6};

namespace detail {

using gyrostat::detail::Candidate;
using gyrostat::detail::enlist;

/// The segments of a motion up to `span`; none where a law is not steady within one, or nothing changes, or too often.
GYROSTAT_COMPILED_ONCE std::vector<Segment> segments_of(const Problem<double>& problem, double span);

/// Sets the start of a segment to the end of the one before: the momentum stays, also where the rate at which a wheel is held has stepped. By how
/// much the rate of the body may be off by that, rad/s: it is a difference of momenta then.
GYROSTAT_COMPILED_ONCE double begin_at(const State<double>& end, const Segment& before, Segment& next) noexcept;

/// The asked times in a segment, from `next` on, and its end, by its clock; the last of the whole is in the last one.
GYROSTAT_COMPILED_ONCE std::vector<double> times_in(const Segment& segment, const std::vector<double>& asked,
                                                    std::size_t& next);

/// What is asked of a segment: all that the next one begins with, so well that what is left of it grows to a share of the tolerance: with the angle
/// that the body turns through from there on.
GYROSTAT_COMPILED_ONCE Question question_of(const Scene& scene, std::vector<double> times, double from,
                                            std::size_t segments);

/// So many rungs at the head of rung_kinds are closed forms.
inline constexpr std::size_t closed_forms = 3;

/// The rungs of families that may answer a segment, in the order of their costs.
template <std::size_t... Place>
std::vector<Candidate> candidates_of(const Scene& scene, std::index_sequence<Place...>) {
  std::vector<Candidate> order;
  const auto look = [&](std::size_t place, double cost) {
    if (!has(rung_kinds[place].lacks, column::attitude) && cost < infinity<double>) enlist(order, {place, cost});
  };
  (look(Place, cost_of_special<Place>(scene)), ...);
  return order;
}
inline std::vector<Candidate> candidates_of(const Scene& scene) {
  return candidates_of(scene, std::make_index_sequence<std::size_t(rung::segments)>{});
}

/// What a segment costs, s, its start that of the whole or, displaced, off by what the one before errs.
GYROSTAT_COMPILED_ONCE double cost_of_one(const Scene& segment, const std::vector<Candidate>& candidates,
                                          bool displaced) noexcept;

/// The ladder, which answers a segment.
using Solve = Answer (*)(const Scene&, Refusal&, Monitor*);

/// One motion in segments, as it grows.
class SegmentedMotion {
 public:
  SegmentedMotion(const Scene& scene, std::vector<Segment> segments, Solve solve)
      : scene_(scene), segments_(std::move(segments)), solve_(solve) {
    track_.states.resize(scene.question().times.size());
    track_.off.fill(nan<double>);
  }

  /// Errc::ok, or why there is no motion: why().
  Errc run(Monitor* monitor) {
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      if (k > 0) error_.angular_velocity += begin_at(end_, segments_[k - 1], segments_[k]);
      if (const Errc wrong = solve_one(k, monitor); wrong != Errc::ok) return wrong;
    }
    return Errc::ok;
  }
  /// The last reason why a segment, or a rung that was asked of it, has no answer; nullptr: none but the code's.
  const char* why() const noexcept { return why_; }
  Track take() noexcept { return std::move(track_); }

 private:
  Errc solve_one(std::size_t k, Monitor* monitor) {
    const Segment& segment = segments_[k];
    const auto& asked = scene_.question().times;
    const std::size_t first = next_;
    const auto times = times_in(segment, asked, next_);
    const auto made = Scene::make(segment.problem, question_of(scene_, times, segment.from, segments_.size()));
    if (!made) return made.error();
    const auto candidates = candidates_of(*made);
    if (!is_alone() && cost_of_one(*made, candidates, k > 0) > cost_of_full(scene_)) {
      why_ = costs_more;
      return Errc::not_applicable;
    }
    auto found = best_of(*made, candidates, monitor);
    if (found && error_.any()) found = carried(*made, *found, monitor);
    if (!found) return found.error();
    const Answer& answer = *found;
    track_.counts += answer.counts;
    for (std::size_t i = first, row = 0; i < next_; ++i) {
      while (times[row] < asked[i] - segment.from) ++row;
      track_.states[i] = state_of(answer, row);
    }
    end_ = state_of(answer, times.size() - 1);
    hand_on(answer, segment.to);
    if (next_ == asked.size() || !lost(answer)) return Errc::ok;
    why_ = errors_grew;
    return Errc::not_applicable;
  }

  bool is_alone() const noexcept { return scene_.question().rung != any_rung; }
  /// Whether it is useless to go on from the end of a segment: the rates err by more than half of their size, or the attitude by more than is asked while other
  /// rungs remain.
  bool lost(const Answer& answer) const noexcept {
    const Column* rates = answer.find(column_kinds[column::angular_velocity].name);
    return (rates && !(error_.angular_velocity <= size_of(*rates) / 2)) ||
           (!is_alone() && track_.off[primitive::attitude] > scene_.goal().columns[column::attitude]);
  }

  /// The first answer of a rung of a family that meets what is asked of the segment, or else comes nearest to it, were the start exact: what counts is
  /// the whole. The full equations of a family are asked where nothing else is of use.
  Result<Answer> best_of(const Scene& segment, const std::vector<Candidate>& candidates, Monitor* monitor) {
    Result<Answer> best = Errc::not_applicable;
    why_ = not_in_segments;
    for (const Candidate& candidate : candidates) {
      if (candidate.rung >= std::size_t(rung::family_full) && best && useful(*best)) continue;
      auto answer = by_rung(segment, int(candidate.rung), monitor);
      if (answer.error() == Errc::cancelled) return answer;
      if (answer && (!best || answer->excess < best->excess)) best = std::move(answer);
      if (best && best->met) break;
    }
    return best;
  }

  /// The same answer with what the error of the start makes of it.
  Result<Answer> carried(const Scene& segment, const Answer& answer, Monitor* monitor) {
    return by_rung(segment.known_within(error_), place_of(tables.rungs, answer.model), monitor);
  }

  Result<Answer> by_rung(const Scene& segment, int rung, Monitor* monitor) {
    Question question = segment.question();
    question.rung = rung;
    Refusal refusal;
    Answer answer = solve_(segment.asked(question), refusal, monitor);
    if (refusal.code == Errc::ok) return answer;
    why_ = refusal.why;
    return refusal.code == Errc::cancelled ? Errc::cancelled : Errc::not_applicable;
  }

  /// Whether an answer may be good enough for the whole, whatever is asked of the segment.
  bool useful(const Answer& answer) const noexcept { return answer.error < scene_.goal().tightest; }

  static State<double> state_of(const Answer& answer, std::size_t row) noexcept {
    State<double> made;
    for (const Column& column : answer.columns) {
      const double* x = column.values.data() + row * std::size_t(column.row_width());
      const auto vector = [x]() noexcept { return Vec3<double>(x[0], x[1], x[2]); };
      switch (std::size_t(column.kind - column_kinds)) {
        case column::attitude: made.attitude = {x[3], x[0], x[1], x[2]}; break;
        case column::angular_velocity: made.angular_velocity = vector(); break;
        case column::angular_momentum: made.angular_momentum = vector(); break;
        case column::rotor_rate: std::copy_n(x, column.row_width(), made.rotor_rate.begin()); break;
        case column::rotor_angle: std::copy_n(x, column.row_width(), made.rotor_angle.begin()); break;
        case column::velocity: made.velocity = vector(); break;
        case column::position: made.position = vector(); break;
        default: break;
      }
    }
    return made;
  }

  /// The errors of an answer, which hold for all its times, as those of the start of the next segment.
  void hand_on(const Answer& answer, double at) noexcept {
    // a clock that begins anew tells times to a rounding of the old one
    const double clock = epsilon<double> * at, omega = end_.angular_velocity.norm();
    const auto& sizes = scene_.sizes();
    // where that has moved the times between which torques act, they have acted for longer or shorter
    const double retimed = 2 * scene_.problem().retimed;
    const double pushed = retimed * (sizes.torque / sizes.least + sizes.damping * omega);
    const double driven = retimed > 0 ? retimed * greatest_drive() : 0;
    for (const Column& column : answer.columns) {
      const double off = absolute_error(column);
      const auto take = [&](std::size_t p, double* start, double rounding) noexcept {
        track_.off[p] = std::isnan(track_.off[p]) ? off : greater(off, track_.off[p]);
        if (start) *start = off + rounding;
      };
      switch (std::size_t(column.kind - column_kinds)) {
        case column::attitude: take(primitive::attitude, &error_.attitude, clock * omega); break;
        case column::angular_velocity:
          take(primitive::angular_velocity, &error_.angular_velocity, clock * omega * omega + pushed);
          break;
        case column::angular_momentum: take(primitive::angular_momentum, nullptr, 0); break;
        case column::rotor_rate:
          take(primitive::rotor_rate, &error_.rotor_rate, clock * omega * omega + pushed + driven);
          break;
        case column::rotor_angle: take(primitive::rotor_angle, &error_.rotor_angle, clock * size_of(column)); break;
        case column::velocity: take(primitive::velocity, &error_.velocity, 0); break;
        default: take(primitive::position, &error_.position, clock * end_.velocity.norm()); break;
      }
    }
  }

  /// Of the wheels' own torques over their moments, rad/s^2.
  double greatest_drive() const noexcept {
    double most = 0;
    for (const auto& wheel : scene_.problem().wheels)
      if (wheel.type == WheelType::torque)
        for (const double value : wheel.table.values)
          most = std::max(most, (std::abs(wheel.torque) + std::abs(value)) / wheel.axial_inertia);
    return most;
  }

  const Scene& scene_;
  std::vector<Segment> segments_;
  Solve solve_;
  StartError error_;
  State<double> end_;
  std::size_t next_ = 0;  ///< of the asked times
  Track track_;
  const char* why_ = nullptr;
};

}  // namespace detail

/// What the rung `segments` costs, s: every segment by the rungs up to the first that is sure, with those that carry errors on; NaN: one of
/// them is no instance of a family.
GYROSTAT_COMPILED_ONCE double cost_of_segments(const Scene& scene) noexcept;

/// Rung `segments`; solve: the ladder, which answers each.
GYROSTAT_COMPILED_ONCE Track segments_track(const Scene& scene, Monitor* monitor, detail::Solve solve);

}  // namespace gyrostat::general

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/general/segments_rung_definition.hpp"
#endif
