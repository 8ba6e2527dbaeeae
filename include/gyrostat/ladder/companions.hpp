// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/pace.hpp"
#include "gyrostat/ode/status.hpp"

/// The full equations and their error: the answer's run and the runs of neighbours side by side.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// A course without changes of law and without events, so that the pace of its steps foretells the rest: `goes_on_alike`.
template <class Course>
concept GoesOnAlike = Course::goes_on_alike;

/// A course whose state can be perturbed by a relative amount.
template <class Course>
concept Kicked = requires(Course course) { course.kick(course.time()); };

/// A writer that tells whether the motions of two rows have diverged for good: `has_parted(a, b)`. That lasts in all columns, or in those that it names:
/// `lasts(column)`.
template <class Writer, class Row>
concept TellsParted = requires(const Writer writer, const Row& row) {
  { writer.has_parted(row, row) } -> std::same_as<bool>;
};
template <class Writer>
concept NamesLasting = requires(const Writer writer) {
  { writer.lasts(std::size_t()) } -> std::same_as<bool>;
};

/// Whether a column keeps the distance of motions that have parted.
template <class Writer>
bool lasts_in(const Writer& writer, std::size_t column) noexcept {
  if constexpr (NamesLasting<Writer>) return writer.lasts(column);
  else return true;
}

/// Result of a walk over the asked times: the errors that the distances of the runs show, in units of the columns, and the sizes of the columns.
template <class Writer>
struct Walk {
  using Scalar = typename Writer::Scalar;
  ode::Status status = ode::Status::reached;
  Comparison<Writer> asked;  ///< the answer alone
  typename Comparison<Writer>::ColumnErrors error;
};

/// The runs side by side: the answer's, its companion's, and, where rounding dominates, a second companion's.
template <class Course>
struct Runs {
  Course &answer, &companion;
  Course* second;
  double stride = honesty::companion_stride;  ///< the longest step of the companion, over that of the answer

  ode::Counts counts() const noexcept {
    ode::Counts all = answer.counts();
    all += companion.counts();
    if (second != nullptr) all += second->counts();
    return all;
  }
};

/// What a walk is to find: the states of the answer at `times`, s, from `start` on; behind a failure they are `nowhere`.
template <class Writer>
struct Sought {
  using Scalar = typename Writer::Scalar;
  using State = typename Writer::State;
  State start;
  std::span<const Scalar> times;
  std::span<State> states;
  State nowhere;
  double progress_from = 0, progress_to = 1;  ///< the part of the progress that is told
};

/// Perturbs a companion that runs alone, once, in the second half of the span.
template <class Course, Real Scalar>
class HalfwayKick {
 public:
  HalfwayKick(const Runs<Course>& runs, Scalar last) noexcept
      : companion_(runs.companion), after_(runs.second == nullptr ? last / 2 : infinity<Scalar>) {}
  void operator()(Scalar now) noexcept {
    if (!(now > after_)) return;
    if constexpr (Kicked<Course>) companion_.kick(Scalar(honesty::kick) * epsilon<Scalar>);
    after_ = infinity<Scalar>;
  }

 private:
  Course& companion_;
  Scalar after_;
};

/// Estimated error of an answer, from its distance to its companions, `away`, and theirs from each other, `between`: 0 with one companion.
template <Real Scalar>
constexpr Scalar error_of_distances(Scalar away, Scalar between) noexcept {
  return Scalar(honesty::side_by_side.margin) * greater(away, between);
}
template <std::size_t N, Real Scalar>
constexpr Errors<N, Scalar> error_of_distances(Errors<N, Scalar> away, const Errors<N, Scalar>& between) noexcept {
  away.raise(between);
  return Scalar(honesty::side_by_side.margin) * away;
}

/// What is stated where distances of the runs show one error and `shared` is what they cannot show: the greater, as the margin of each leaves room for the
/// other; with a lone companion, which may be near by chance, the sum.
template <Real Scalar>
constexpr Scalar stated_error(Scalar shown, Scalar shared, bool lone) noexcept {
  return lone ? shown + shared : greater(shown, shared);
}
template <std::size_t N, Real Scalar>
constexpr Errors<N, Scalar> stated_error(Errors<N, Scalar> shown, const Errors<N, Scalar>& shared, bool lone) noexcept {
  for (std::size_t i = 0; i < N; ++i) shown[i] = stated_error(shown[i], shared[i], lone);
  return shown;
}

/// Relative error that all runs may share: rounding of the evaluation, and a part of `walk`, the accumulated rounding of the steps.
template <Real Scalar>
constexpr Scalar shared_rounding(Scalar walk) noexcept {
  return epsilon<Scalar> + Scalar(honesty::shared_steps) * walk;
}

/// A note(i, error) that does nothing.
inline constexpr auto not_noted = [](std::size_t, const auto&) noexcept {};

/// Steps a course until its last step holds t or ends at t_max. stride: the length of the last step that was made.
template <class Course, Real Scalar>
ode::Status reach(Course& course, Scalar t, Scalar t_max, Scalar& stride) noexcept {
  ode::Status status = ode::Status::reached;
  while (status == ode::Status::reached && course.time() < t && course.time() < t_max) {
    const Scalar before = course.time();
    status = course.step(t_max);
    stride = course.time() - before;
  }
  return status;
}

/// The longest step of the first companion after so many, over that of the answer at the same place: `longest` or up to stride_spread less, evenly strewn
/// (the fractions of the multiples of the golden ratio).
constexpr double companion_stride(double longest, std::uint64_t steps) noexcept {
  // the multiples of the golden ratio in units of 2^-32, which wrap around
  const auto turn = static_cast<std::uint32_t>(steps) * std::uint32_t{2654435769};
  return longest - honesty::stride_spread * (double(turn) * 0x1p-32);
}

/// Where a step of the first companion from `now`, not longer than `longest`, ends at the latest.
template <Real Scalar>
constexpr Scalar companion_reaches(Scalar now, Scalar longest, Scalar last) noexcept {
  const Scalar end = now + longest;
  return end > now && end < last ? end : last;
}

/// Whether times[i] is the last asked time in the step from `begin` to `end`, or the first: there a series errs most, and where the motion is damped
/// its error soon fades.
template <Real Scalar>
bool is_next_to_end(std::span<const Scalar> times, std::size_t i, Scalar begin, Scalar end) noexcept {
  return i + 1 >= times.size() || times[i + 1] > end || i == 0 || times[i - 1] <= begin;
}

/// Lets distances fade with the turns of the body, `turning(row)` of the writer, rad/s, except those of motions that have diverged for good.
template <class Writer>
class Fading {
  using Scalar = typename Writer::Scalar;
  using Row = typename Comparison<Writer>::Row;
  using Kept = typename Comparison<Writer>::ColumnErrors;

 public:
  explicit Fading(const Writer& writer) noexcept : writer_(writer) {}
  void see(const Row& answer) noexcept { rate_ = writer_.turning(answer); }
  void see_apart(const Row& a, const Row& b) noexcept {
    if constexpr (TellsParted<Writer, Row>) parted_ = parted_ || writer_.has_parted(a, b);
  }
  /// `kept` after `time` more, s.
  void fade(Kept& kept, Scalar time) const noexcept {
    const Scalar share = 1 / (1 + time * rate_ / Scalar(honesty::fading_angle));
    if (!parted_) {
      kept *= share;
      return;
    }
    for (std::size_t i = 0; i < std::size(Writer::columns); ++i)
      if (!lasts_in(writer_, i)) kept[i] *= share;
  }

 private:
  const Writer& writer_;
  Scalar rate_ = 0;  ///< when last seen
  bool parted_ = false;
};

/// Steps the answer and its companions over the asked times, and keeps the answer's states there. Companions take tighter steps: their distance from
/// the answer shows its truncation, their distance from each other the effect of rounding and of the last digits of the data.
/// A course has step(t_max), time(), at(t) within the last step, and counts(); one that GoesOnAlike is given up where its steps would overrun their
/// budget (Pace). The first companion leads. All are compared at the ends of its steps and at the asked times: of many at some, and at the first and the
/// last in each step of the answer.
/// The first steps have different lengths, else all runs would take the same polynomial and err alike; a lone companion is kicked at half the span.
/// A distance fades while the body makes some twenty turns, so that one asked time at which all happen to be near does not hide it.
/// States behind a failure are `nowhere`. note(i, error) is called at each asked time.
/// Between two steps the times before told_ have state and error, those before next_ their state, and the last step of every run reaches the
/// companion's time.
template <class Writer, class Course, class Note>
class SideBySide {
  using Scalar = typename Writer::Scalar;
  using Status = ode::Status;
  using Rows = Comparison<Writer>;
  using Row = typename Rows::Row;

 public:
  SideBySide(const Writer& writer, const Runs<Course>& runs, const Sought<Writer>& sought,
             const MotionOptions<Scalar>& options, const Note& note) noexcept
      : runs_(runs),
        sought_(sought),
        options_(options),
        note_(note),
        last_(sought.times.back()),
        walk_{Status::reached, Rows(writer), {}},
        fading_(writer),
        kick_(runs, sought.times.back()) {}

  Walk<Writer> walk() noexcept {
    take_start();
    if (is_going_on()) take_first_steps();
    while (is_going_on()) take_step();
    for (; next_ < sought_.times.size(); ++next_) sought_.states[next_] = sought_.nowhere;
    return walk_;
  }

 private:
  bool is_well() const noexcept { return walk_.status == Status::reached; }
  bool is_going_on() const noexcept { return is_well() && next_ < sought_.times.size(); }

  void take_start() noexcept {
    fading_.see(walk_.asked.row(sought_.start));
    for (; next_ < sought_.times.size() && !(sought_.times[next_] > 0); ++next_) {
      const Row row = keep(sought_.start);
      if (!(last_ > 0)) look(row, last_);  // the start alone is asked: no later time shows what conversions lose
      tell(next_ + 1);
    }
  }

  void take_first_steps() noexcept {
    walk_.status = runs_.answer.step(last_);
    stride_ = runs_.answer.time();
    if (!is_well()) return;
    if (runs_.second != nullptr) walk_.status = runs_.second->step(stride_ / 3);
    longest_ = stride_ / 2;
  }

  /// One of the companion, and what the others make up to its end.
  void take_step() noexcept {
    const Scalar before = runs_.companion.time();
    walk_.status = runs_.companion.step(longest_);
    if (!is_well()) return;
    const Scalar now = runs_.companion.time();
    fading_.fade(kept_, now - before);
    take_times(now);
    if (!is_well() || told_ == sought_.times.size() || !all_reach(now)) return;
    if (told_ < next_ || honesty::is_compared_at_end(trips_)) look(walk_.asked.row(runs_.answer.at(now)), now);
    if (told_ < next_) tell(next_);
    if (!is_going_on()) return;
    kick_(now);
    if (GoesOnAlike<Course> && pace_.is_hopeless(trips_, now, last_, options_.step_cap)) {
      walk_.status = Status::step_limit;
    } else if ((trips_++ & 255U) == 0) {
      const double from = sought_.progress_from, to = sought_.progress_to;
      options_.report(from + static_cast<double>(now / last_) * (to - from));
      if (options_.cancelled()) walk_.status = Status::cancelled;
    }
    longest_ = companion_reaches(now, Scalar(companion_stride(runs_.stride, trips_)) * stride_, last_);
  }

  /// The asked times up to `now`.
  void take_times(Scalar now) noexcept {
    const auto times = sought_.times;
    for (; next_ < times.size() && times[next_] <= now && all_reach(times[next_]); ++next_) {
      const Row row = keep(runs_.answer.at(times[next_]));
      const Scalar end = runs_.answer.time();
      if (!honesty::is_compared(next_, times.size()) && !is_next_to_end(times, next_, end - stride_, end)) continue;
      look(row, times[next_]);
      tell(next_ + 1);
    }
  }

  /// The state of the answer at the next time.
  Row keep(const typename Writer::State& state) noexcept {
    sought_.states[next_] = state;
    const Row row = walk_.asked.row(state);
    walk_.asked.add(row);
    return row;
  }

  bool all_reach(Scalar t) noexcept {
    walk_.status = reach(runs_.answer, t, last_, stride_);
    Scalar unused = 0;
    if (is_well() && runs_.second != nullptr) walk_.status = reach(*runs_.second, t, last_, unused);
    return is_well();
  }

  /// Compares the companions at time t with the answer there.
  void look(const Row& answer, Scalar t) noexcept {
    fading_.see(answer);
    const Row one = walk_.asked.row(runs_.companion.at(t));
    auto away = Rows::apart(answer, one);
    fading_.see_apart(answer, one);
    if (runs_.second == nullptr) return kept_.raise(error_of_distances(away, {}));
    const Row two = walk_.asked.row(runs_.second->at(t));
    fading_.see_apart(answer, two);
    away.raise(Rows::apart(answer, two));
    kept_.raise(error_of_distances(away, Rows::apart(one, two)));
  }

  void tell(std::size_t end) noexcept {
    walk_.error.raise(kept_);
    for (; told_ < end; ++told_) note_(told_, kept_);
  }

  const Runs<Course>& runs_;
  const Sought<Writer>& sought_;
  const MotionOptions<Scalar>& options_;
  const Note& note_;
  Scalar last_;
  Walk<Writer> walk_;
  typename Rows::ColumnErrors kept_;  ///< the error by now: it fades
  Fading<Writer> fading_;
  HalfwayKick<Course, Scalar> kick_;
  Pace<Scalar> pace_;
  std::size_t next_ = 0, told_ = 0;  ///< asked times: the next one, and how many have their error
  std::uint64_t trips_ = 0;
  Scalar stride_ = 0;   ///< the last step of the answer
  Scalar longest_ = 0;  ///< where the next step of the companion ends at the latest
};

template <class Writer, class Course, class Note>
Walk<Writer> walk_beside(const Writer& writer, const Runs<Course>& runs, const Sought<Writer>& sought,
                         const MotionOptions<typename Writer::Scalar>& options, const Note& note) noexcept {
  return SideBySide<Writer, Course, Note>(writer, runs, sought, options, note).walk();
}

/// Solves by a run beside its companions. `rounding(sizes, walk)` gives, in units of the columns, the error that
/// all runs share, so that no distance shows it: rounding of the columns, `walk` being the accumulated rounding of the answer's steps. note(i, error)
/// receives the current estimate of the error at each asked time.
template <class Answer, class Writer, class Course, class Rounding, class Note = decltype(not_noted)>
void solve_beside(Answer& answer, const Writer& writer, const Runs<Course>& runs, const Sought<Writer>& sought,
                  const MotionOptions<typename Writer::Scalar>& options, const Rounding& rounding,
                  const Note& note = not_noted) noexcept {
  using Scalar = typename Writer::Scalar;
  constexpr Scalar eps = epsilon<Scalar>;
  const auto walk = walk_beside(writer, runs, sought, options, note);
  answer.status = walk.status;
  answer.counts = runs.counts();
  const Scalar step_rounding = eps * std::sqrt(static_cast<Scalar>(runs.answer.counts().steps));
  if (answer.status != ode::Status::reached) {
    answer.error = decltype(answer.error)::all(nan<Scalar>);
    return;
  }
  const auto error = stated_error(walk.error, rounding(walk.asked.size(), step_rounding), runs.second == nullptr);
  answer.error = relative_to_truth(walk.asked.relative(error), Writer::columns);
  answer.met = options.excess(answer) <= 1;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
