// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ode/status.hpp"

/// The full equations and their error: the answer's run and the runs of neighbours side by side.
namespace gyrostat {

/// What the walk found: the greatest distance to the companions and the sizes of the columns, over the asked times.
template <class Writer>
struct Walk {
  using Scalar = typename Writer::Scalar;
  ode::Status status = ode::Status::reached;
  Comparison<Writer> asked;  ///< the answer alone
  typename Comparison<Writer>::ColumnErrors distance;
};

/// Steps a course until its last step holds t or ends at t_max.
template <class Course, Real Scalar>
ode::Status reach(Course& course, Scalar t, Scalar t_max) noexcept {
  ode::Status status = ode::Status::reached;
  while (status == ode::Status::reached && course.time() < t && course.time() < t_max) status = course.step(t_max);
  return status;
}

/// Steps `course`, and beside it its two companions, over the asked times, and keeps its states there. A course has step(t_max), time(), at(t)
/// within the last step, and counts(). The first companion leads, and all are compared at the end of each of its steps and at the asked times.
/// Their first steps end apart: from one start all would take the same polynomial, and err alike. A distance that was seen fades while the
/// body, at turning rate `rate` [rad/s], makes some twenty turns, so that one asked time at which all are near by chance does not hide it.
/// States behind a failure are `nowhere`.
template <class Writer, class Course>
Walk<Writer> walk_beside(const Writer& writer, Course& course, Course& companion, Course& second,
                         const typename Writer::State& start, typename Writer::Scalar rate,
                         std::span<const typename Writer::Scalar> times, std::span<typename Writer::State> states,
                         const typename Writer::State& nowhere, const MotionOptions<typename Writer::Scalar>& options,
                         double progress_from, double progress_to) noexcept {
  using Scalar = typename Writer::Scalar;
  using State = typename Writer::State;
  using ode::Status;
  Walk<Writer> walk{Status::reached, Comparison<Writer>(writer), {}};
  typename Comparison<Writer>::ColumnErrors kept;
  const auto look = [&](const State& here, Scalar t) noexcept {
    Comparison<Writer> now(writer);
    now.add(here, companion.at(t));
    now.add(here, second.at(t));
    kept.raise(now.difference());
  };
  const Scalar last = times.back();
  const auto all_reach = [&](Scalar t) noexcept {
    walk.status = reach(course, t, last);
    if (walk.status == Status::reached) walk.status = reach(second, t, last);
    return walk.status == Status::reached;
  };

  std::size_t next = 0;
  for (; next < times.size() && !(times[next] > 0); ++next) {
    states[next] = start;
    walk.asked.add(start);
  }
  if (next < times.size()) walk.status = course.step(last);
  const Scalar first = course.time();
  if (next < times.size() && walk.status == Status::reached) walk.status = second.step(first / 3);
  std::uint32_t trips = 0;
  while (next < times.size() && walk.status == Status::reached) {
    const Scalar before = companion.time();
    walk.status = companion.step(trips == 0 ? first / 2 : last);
    if (walk.status != Status::reached) break;
    const Scalar now = companion.time();
    kept *= 1 / (1 + (now - before) * rate / Scalar(honesty::fading_angle));
    for (; next < times.size() && times[next] <= now && all_reach(times[next]); ++next) {
      states[next] = course.at(times[next]);
      walk.asked.add(states[next]);
      look(states[next], times[next]);
      walk.distance.raise(kept);
    }
    if (next == times.size() || walk.status != Status::reached || !all_reach(now)) break;
    look(course.at(now), now);
    if ((trips++ & 255U) == 0) {
      options.report(progress_from + static_cast<double>(now / last) * (progress_to - progress_from));
      if (options.cancelled()) {
        walk.status = Status::cancelled;
        break;
      }
    }
  }
  for (; next < times.size(); ++next) states[next] = nowhere;
  return walk;
}

/// The answer of a run beside its companions. answer.step_tolerance is set; `rounding(sizes, steps)` gives, in units of the columns, what
/// the runs share and no distance shows: rounding of the columns, where `steps` roundings of the answer's steps have added up.
template <class Answer, class Writer, class Course, class Rounding>
void solve_beside(Answer& answer, const Writer& writer, Course& course, Course& companion, Course& second,
                  const typename Writer::State& start, typename Writer::Scalar rate,
                  std::span<const typename Writer::Scalar> times, std::span<typename Writer::State> states,
                  const typename Writer::State& nowhere, const MotionOptions<typename Writer::Scalar>& options,
                  double progress_from, double progress_to, const Rounding& rounding) noexcept {
  using Scalar = typename Writer::Scalar;
  constexpr Scalar eps = epsilon<Scalar>;
  const auto walk = walk_beside(writer, course, companion, second, start, rate, times, states, nowhere, options,
                                progress_from, progress_to);
  answer.status = walk.status;
  answer.counts = course.counts();
  const Scalar steps = eps * std::sqrt(static_cast<Scalar>(answer.counts.steps));
  answer.counts += companion.counts();
  answer.counts += second.counts();
  if (answer.status != ode::Status::reached) {
    answer.error = decltype(answer.error)::all(nan<Scalar>);
    return;
  }
  const auto error = honesty::margin(answer.step_tolerance) * walk.distance + rounding(walk.asked.size(), steps);
  answer.error = relative_to_truth(walk.asked.relative(error), Writer::columns);
  answer.met = options.excess(answer.error) <= 1;
}

}  // namespace gyrostat
