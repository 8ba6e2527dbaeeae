// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// What a rung hands back: the answer in its own terms, or why it has none. `fill(answer, scene, track)` turns it into
/// columns; `describe(answer, scene, track)` adds to the answer what belongs to the scene, whichever rung answers.
template <class Track, class Scene>
concept RungResult = requires(const Track& track, const Scene& scene, Answer& answer) {
  { track.failure } -> std::convertible_to<Errc>;
  { track.refusal } -> std::convertible_to<const char*>;
  { track.known_error } -> std::convertible_to<double>;
  { track.in_domain } -> std::convertible_to<bool>;
  { scene.question() } -> std::convertible_to<const Question&>;
  fill(answer, scene, track);
  describe(answer, scene, track);
};

/// A model of a scene: says whether it applies, answers, estimates its own error and counts its work; and before that what an answer would
/// cost where it applies, in seconds of one core of some 3 GHz, to within a factor of a few, for comparison with other rungs. Infinite: the rung is asked only
/// by name or when all others have failed; NaN: it cannot answer this scene, and says why when it is named.
template <class Scene, class Track>
struct Rung {
  Track (*answer)(const Scene&, Monitor*);
  double (*cost)(const Scene&) noexcept;
};

/// Why a climb ended without an answer.
struct Refusal {
  Errc code = Errc::ok;
  const char* model = "";
  const char* why = "";
};

/// Predicted costs hold to a factor of about two, so a rung overtakes one that precedes it in the table only if it is to cost less than
/// this share of it.
inline constexpr double clearly_cheaper = 0.5;

inline constexpr const char* costs_more = "an answer of it is predicted to cost more";

inline constexpr WarningKind no_value{
    "no-value",
    "the motion does not have all that is asked for, or this rung does not give it: that is left without a value"};

namespace detail {

/// A rung that may answer, by its place in the table, and what it would cost, s.
struct Candidate {
  std::size_t rung;
  double cost;
};

/// Puts a rung in the order in which they are asked: behind those that stand before it in the table, unless it is clearly cheaper.
inline void enlist(std::vector<Candidate>& order, const Candidate& candidate) {
  auto place = order.end();
  while (place != order.begin() && candidate.cost < clearly_cheaper * (place - 1)->cost) --place;
  order.insert(place, candidate);
}

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

/// Whether the rung lacks a column that has to be there.
inline bool lacks_needed(const RungKind& kind, const Question& question, const Family& family) noexcept {
  for (std::size_t i = 0; i < family.columns.size(); ++i)
    if (has(kind.lacks, i) && needs_column(question, family, i)) return true;
  return false;
}

/// The rungs that a scene's question may be put to, in the order in which they are asked, and those that lack what is asked for.
struct Order {
  std::vector<Candidate> asked;
  std::vector<std::size_t> lacking;

  template <class Scene, class Track>
  Order(const Family& family, std::span<const Rung<Scene, Track>> rungs, const Scene& scene) {
    const Question& question = scene.question();
    const bool named = question.rung >= 0;
    const int only = named ? question.rung : question.only_rung;
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      if (only >= 0 && i != std::size_t(only)) continue;
      const double cost = rungs[i].cost(scene);
      if (!named && std::isnan(cost)) continue;
      if (!named && lacks_needed(family.rungs[i], question, family)) lacking.push_back(i);
      else enlist(asked, {i, cost});
    }
  }

  const Candidate& highest() const noexcept {
    return *std::max_element(asked.begin(), asked.end(), [](auto a, auto b) { return a.rung < b.rung; });
  }
};

/// The question with its tolerances in units as relative ones, by the sizes that an answer found; nothing where none of them is in a unit.
inline std::optional<Question> in_relative_terms(const Question& question, const Answer& answer, const Family& family) {
  Question made = question;
  bool changed = false;
  for (AskedQuantity& each : made.asked) {
    if (!each.absolute) continue;
    double tolerance = nan<double>;
    if (each.scalar) {
      if (const Quantity* found = answer.quantity(family.scalars[each.place].name)) tolerance = found->tolerance;
    } else if (const Column* found = answer.find(family.columns[each.place].name)) {
      tolerance = found->tolerance;
    }
    if (!(tolerance > 0)) continue;
    each = {each.place, each.scalar, std::min(tolerance, 0.5), false, each.needed};
    changed = true;
  }
  return changed ? std::optional(made) : std::nullopt;
}

/// What the track of a rung comes to, held against what is asked.
template <class Scene, class Track>
Answer answer_of(const Family& family, const char* model, const Scene& scene, const Track& track, bool describes) {
  Answer answer;
  answer.model = model;
  answer.tolerance = scene.question().tolerance;
  fill(answer, scene, track);
  if (describes) describe(answer, scene, track);
  judge(answer, scene.question(), family);
  answer.met = track.in_domain && answer.excess <= 1;
  return answer;
}

/// Leaves the scalars that were asked for, each of them, and says where one has no value.
inline void keep_asked(Answer& answer, const Question& question, const Family& family) {
  const auto without_value = [](const Column& column) {
    return column.error == infinity<double> && (std::isnan(column.values.front()) || std::isnan(column.values.back()));
  };
  bool lacking = std::any_of(answer.columns.begin(), answer.columns.end(), without_value);
  if (!question.asked.empty()) {
    std::vector<Quantity> kept;
    for (const AskedQuantity& each : question.asked) {
      if (!each.scalar) continue;
      const Quantity* found = answer.quantity(family.scalars[each.place].name);
      kept.push_back(found ? *found : Quantity{&family.scalars[each.place], {nan<double>, nan<double>, nan<double>}});
      if (!each.needed || !std::isnan(kept.back().values[0])) continue;
      lacking = true;
      kept.back().tolerance = each.tolerance == each.tolerance ? each.tolerance : question.tolerance;
    }
    answer.quantities = std::move(kept);
  }
  if (lacking) answer.warnings.push_back({&no_value, no_value.text, nan<double>});
}

}  // namespace detail

/// The answer that the track of a rung is, where it meets what is asked; else nothing.
template <class Scene, class Track>
std::optional<Answer> met_by(const Family& family, const char* model, const Scene& scene, const Track& track) {
  const bool describes_all = asks_for_scalars(scene.question());
  Answer answer = detail::answer_of(family, model, scene, track, describes_all);
  if (!answer.met) return std::nullopt;
  if (!describes_all) describe(answer, scene, track);
  detail::keep_asked(answer, scene.question(), family);
  return answer;
}

/// Climbs the ladder of a scene as `climb` does up to the rung `last`. The answer is that of a rung before it which meets what is asked;
/// nothing where there is none. comes: whether the ladder goes on to `last`. What was tried is not told.
template <class Scene, class Track>
std::optional<Answer> climb_to(const Family& family, std::span<const Rung<Scene, Track>> rungs, std::size_t last,
                               const Scene& scene, Monitor* monitor, bool& comes) {
  comes = false;
  for (const detail::Candidate& candidate : detail::Order(family, rungs, scene).asked) {
    comes = candidate.rung == last;
    if (comes) break;
    const Track track = rungs[candidate.rung].answer(scene, monitor);
    if (track.failure == Errc::cancelled) break;
    if (track.failure != Errc::ok) continue;
    if (auto answer = met_by(family, family.rungs[candidate.rung].name, scene, track)) return answer;
  }
  return std::nullopt;
}

namespace detail {

/// A climb on its way: what was tried, and the best answer so far.
template <class Scene, class Track>
class Ascent {
 public:
  Ascent(const Family& family, std::span<const Rung<Scene, Track>> rungs, const Scene& scene, Monitor* monitor,
         Refusal& refusal) noexcept
      : family_(family), rungs_(rungs), scene_(scene), monitor_(monitor), refusal_(refusal) {
    refusal_ = {};
  }

  /// Asks one rung of the scene, or of the same scene with tighter tolerances; false: there is no need to go on.
  bool ask(const Candidate& candidate, const Scene& scene) {
    const Stopwatch watch;
    Track track = rungs_[candidate.rung].answer(scene, monitor_);
    if (track.failure != Errc::ok) return refused(candidate, track, watch);
    const char* const model = family_.rungs[candidate.rung].name;
    Answer answer = answer_of(family_, model, scene, track, describes_all_);
    tried_.push_back({model, answer.error, false, track.in_domain ? nullptr : "the scene leaves its domain",
                      answer.excess, candidate.cost, watch.seconds()});
    if (!answered_ || is_better(candidate.rung, answer, track)) {
      rung_ = candidate.rung;
      accepted_ = tried_.size() - 1;
      best_ = std::move(answer);
      track_ = std::move(track);
    }
    answered_ = true;
    return !best_.met;
  }

  /// Records a rung that is not asked, and why; not where it stands behind the one that answers.
  void leave_out(std::size_t rung, const char* why, double cost) {
    if (best_.met && rung >= rung_) return;
    tried_.insert(tried_.begin(), {family_.rungs[rung].name, nan<double>, false, why, nan<double>, cost});
    ++accepted_;
  }

  bool answered() const noexcept { return answered_; }
  const Answer& best() const noexcept { return best_; }

  /// The best answer, with what was tried; of cancelled work only what was tried.
  Answer end() {
    if (refusal_.code == Errc::cancelled) best_ = {}, answered_ = false;
    best_.tried = std::move(tried_);
    if (!answered_ && refusal_.code == Errc::ok)  // no rung knows what it would cost
      refusal_ = {Errc::not_applicable, "auto", message(Errc::not_applicable)};
    if (!answered_) return std::move(best_);
    refusal_ = {};  // other rungs have refused, but there is an answer
    best_.tried[accepted_].accepted = true;
    if (!describes_all_) describe(best_, scene_, track_);
    keep_asked(best_, scene_.question(), family_);
    return std::move(best_);
  }

 private:
  bool refused(const Candidate& candidate, const Track& track, const Stopwatch& watch) {
    const char* const model = family_.rungs[candidate.rung].name;
    tried_.push_back({model, track.known_error, false, track.refusal, nan<double>, candidate.cost, watch.seconds()});
    // the highest rung says why, in whatever order they are asked
    if (track.failure == Errc::cancelled || candidate.rung >= refused_rung_) {
      refused_rung_ = candidate.rung;
      refusal_ = {track.failure, model, track.refusal ? track.refusal : message(track.failure)};
    }
    return track.failure != Errc::cancelled;
  }

  /// Whether it is better than the best so far: in its domain rather than outside, then by the lesser error; where neither error is known the higher rung is
  /// taken as the more accurate.
  bool is_better(std::size_t rung, const Answer& answer, const Track& track) const noexcept {
    if (answer.met) return true;
    if (track.in_domain != track_.in_domain) return track.in_domain;
    if (answer.excess == infinity<double> && best_.excess == infinity<double>) return rung > rung_;
    return answer.excess < best_.excess || std::isnan(best_.excess);
  }

  const Family& family_;
  std::span<const Rung<Scene, Track>> rungs_;
  const Scene& scene_;
  Monitor* monitor_;
  Refusal& refusal_;
  const bool describes_all_ = asks_for_scalars(scene_.question());
  Answer best_;
  Track track_;  ///< of the best answer
  std::vector<Attempt> tried_;
  std::size_t accepted_ = 0;  ///< of them the one that the best answer is from
  bool answered_ = false;
  std::size_t rung_ = 0, refused_rung_ = 0;
};

}  // namespace detail

/// The answer of the first rung whose own error estimates meet what is asked, in the order of the family's table but for those that predict
/// to be clearly cheaper for this scene; failing that of the rung that comes nearest to it, one in its domain before any outside, with met
/// false. The rung that the question names answers alone, wherever it can. The answer's `tried` lists the rungs that were not asked for a
/// reason, those that stand before the one that answers and would have cost more among them, and then what was asked, in this order; on
/// failure too.
template <class Scene, class Track>
  requires RungResult<Track, Scene>
Answer climb(const Family& family, std::span<const Rung<Scene, Track>> rungs, const Scene& scene, Monitor* monitor,
             Refusal& refusal) {
  const detail::Order order(family, rungs, scene);
  detail::Ascent<Scene, Track> ascent(family, rungs, scene, monitor, refusal);
  std::size_t next = 0;
  bool goes_on = true;
  while (next < order.asked.size() && goes_on) goes_on = ascent.ask(order.asked[next++], scene);
  if (refusal.code == Errc::cancelled) return ascent.end();
  // Only now it is known what the tolerances in units come to.
  if (goes_on && ascent.answered())
    if (const auto tighter = detail::in_relative_terms(scene.question(), ascent.best(), family))
      ascent.ask(order.highest(), scene.asked(*tighter));
  for (const std::size_t i : order.lacking) ascent.leave_out(i, "it does not give all that is asked for", nan<double>);
  for (; next < order.asked.size() && order.asked[next].cost < infinity<double>; ++next)
    ascent.leave_out(order.asked[next].rung, costs_more, order.asked[next].cost);
  return ascent.end();
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
