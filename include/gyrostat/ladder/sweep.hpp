// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <semaphore>
#include <span>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/answer.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/ladder/rung.hpp"

/// Many scenes that differ in a few numbers, a row each. What a row comes to depends on its own numbers alone: not on the threads, and not
/// on the rows beside it.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// One number of the scene that is another in every row.
struct Varied {
  std::size_t place;               ///< among the numbers of the scene
  std::span<const double> values;  ///< one a row
};

/// Where the values of one column or scalar go, row after row: arrays of the caller. A row that has none gets NaN.
struct SweepTarget {
  std::size_t place;  ///< in its family's table of columns, or of scalars
  bool scalar;
  std::size_t width;         ///< numbers of one row; of a column at all times
  std::span<double> values;  ///< width a row
  std::span<double> errors;  ///< one a row, as the table measures it; NaN where there is none
};

/// What is known of a row beside its values.
struct SweepRow {
  const char* reason = nullptr;  ///< why there is no answer; nullptr: there is one
  int rung = -1;  ///< that answered, or was the last to refuse: its place in the table; -1: there is no such scene
  bool met = false;
  double excess = nan<double>;  ///< greatest error over its tolerance
  std::uint32_t warnings = 0;   ///< a bit for the place of each in the table; behind them that of no_value
};

/// SweepRow::reason of a row that nobody came to.
inline constexpr const char* not_reached = "the sweep was stopped before this row";

/// More threads than that are no faster on any machine, and a system may give no more.
inline constexpr unsigned most_threads = 1024;

/// Works through rows 0 to rows - 1 on `threads` threads, one to most_threads of them, at most `most` rows at a time. make_worker(monitor), called once on each
/// thread, returns worker(begin, end), which does these rows; long work should look at the monitor, cancelled with that of the caller. After that rows are
/// left out. Returns when all threads have ended.
template <class MakeWorker>
void for_blocks(std::size_t rows, unsigned threads, std::size_t most, Monitor* monitor, const MakeWorker& make_worker) {
  if (rows == 0) return;
  constexpr std::chrono::milliseconds pause{20};
  const unsigned pool_size = unsigned(std::clamp<std::size_t>(threads, 1, std::min<std::size_t>(rows, most_threads)));
  // few rows, so that no thread waits long for the last to end
  const std::size_t block = std::clamp<std::size_t>(rows / (16 * std::size_t(pool_size)), 1, most);
  std::atomic<std::size_t> next{0}, done{0};
  std::vector<Monitor> monitors(pool_size);
  std::counting_semaphore<> ended{0};
  std::vector<std::jthread> pool;
  pool.reserve(pool_size);
  for (Monitor& own : monitors)
    pool.emplace_back([&] {
      auto worker = make_worker(own);
      for (;;) {
        const std::size_t begin = next.fetch_add(block), end = std::min(begin + block, rows);
        if (begin >= rows || own.cancel.load(std::memory_order_relaxed)) break;
        worker(begin, end);
        if (own.cancel.load(std::memory_order_relaxed)) break;
        done.fetch_add(end - begin, std::memory_order_relaxed);
      }
      ended.release();
    });
  for (unsigned running = pool_size; running > 0;) {
    if (ended.try_acquire_for(pause)) --running;
    if (!monitor) continue;
    monitor->fraction.store(double(done.load()) / double(rows), std::memory_order_relaxed);
    if (monitor->cancelled())
      for (Monitor& own : monitors) own.cancel.store(true);
  }
}

/// The same row by row: worker(row).
template <class MakeWorker>
void for_rows(std::size_t rows, unsigned threads, Monitor* monitor, const MakeWorker& make_worker) {
  for_blocks(rows, threads, 8, monitor, [&](Monitor& own) {
    return [worker = make_worker(own), &own](std::size_t begin, std::size_t end) mutable {
      for (std::size_t row = begin; row < end && !own.cancel.load(std::memory_order_relaxed); ++row) worker(row);
    };
  });
}

namespace detail {

inline void store(const SweepTarget& target, std::size_t row, const Answer& answer, const Family& family) noexcept {
  double* const to = target.values.data() + row * target.width;
  if (target.scalar) {
    if (const Quantity* found = answer.quantity(family.scalars[target.place].name)) {
      std::copy_n(found->values.data(), target.width, to);
      target.errors[row] = std::isfinite(found->values[0]) ? found->error : nan<double>;
    }
  } else if (const Column* found = answer.find(family.columns[target.place].name)) {
    std::copy_n(found->values.data(), std::min(target.width, found->values.size()), to);
    target.errors[row] = found->error;
  }
}

/// A bit for each warning, by its place in the table of the family: no_value is behind them, and those of other families have one in common.
inline std::uint32_t warning_bits(const Answer& answer, const Family& family) noexcept {
  std::uint32_t bits = 0;
  for (const Warning& warning : answer.warnings) {
    int place = place_of(family.warnings, warning.code());
    if (place < 0 && warning.code() != no_value.code) place = place_of(family.warnings, warning_of_family);
    bits |= std::uint32_t{1} << (place < 0 ? family.warnings.size() : std::size_t(place));
  }
  return bits;
}

/// Why numbers make no scene: what scene_of.why(numbers) says, where it has words of its own, else what the error means.
template <class SceneOf>
const char* why_none(const SceneOf& scene_of, std::span<const double> numbers, Errc error) {
  if constexpr (requires { scene_of.why(numbers); })
    if (const char* why = scene_of.why(numbers)) return why;
  return message(error);
}

/// Puts an answer into its row.
inline SweepRow told_of(const Family& family, const Answer& answer, std::span<const SweepTarget> targets,
                        std::size_t row) noexcept {
  for (const SweepTarget& target : targets) store(target, row, answer, family);
  return {nullptr, place_of(family.rungs, answer.model), answer.met, answer.excess, warning_bits(answer, family)};
}

/// Solves the scene and puts its answer into the row.
template <class Scene, class Solve>
SweepRow swept(const Family& family, const Scene& scene, const Solve& solve, std::span<const SweepTarget> targets,
               std::size_t row, Monitor* monitor) {
  Refusal refusal;
  const Answer answer = solve(scene, refusal, monitor);
  if (refusal.code == Errc::ok) return told_of(family, answer, targets, row);
  return {.reason = refusal.why, .rung = place_of(family.rungs, refusal.model)};
}

/// A solver that answers up to Solve::width scenes side by side, 32 at most, as far as it can: solve.together(scenes, answers, monitor), a bit
/// for each answer. No answer may depend on the scenes beside it.
template <class Solve, class Scene>
concept SolvesTogether =
    requires(const Solve& solve, std::span<const Scene> scenes, std::span<Answer> answers, Monitor* monitor) {
      { Solve::width } -> std::convertible_to<std::size_t>;
      { solve.together(scenes, answers, monitor) } -> std::same_as<unsigned>;
    };

template <class Solve>
inline constexpr std::size_t solved_at_once = 1;
template <class Solve>
  requires requires { Solve::width; }
inline constexpr std::size_t solved_at_once<Solve> = Solve::width;

/// Scenes that wait to be solved at once, and their rows.
template <class Scene, class Solve>
class Waiting {
 public:
  void add(Scene scene, std::size_t row) noexcept {
    scenes_[count_] = std::move(scene);
    rows_[count_++] = row;
  }
  bool full() const noexcept { return count_ == width; }
  /// Solves them; none waits any longer.
  void solve_all(const Family& family, const Solve& solve, std::span<const SweepTarget> targets,
                 std::span<SweepRow> told, Monitor& own) {
    unsigned answered = 0;
    if constexpr (SolvesTogether<Solve, Scene>)
      answered = solve.together(std::span<const Scene>(scenes_).first(count_), answers_, &own);
    for (std::size_t i = 0; i < count_; ++i) {
      if (answered >> i & 1) told[rows_[i]] = told_of(family, answers_[i], targets, rows_[i]);
      else if (!own.cancel.load(std::memory_order_relaxed))
        told[rows_[i]] = swept(family, scenes_[i], solve, targets, rows_[i], &own);
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t width = solved_at_once<Solve>;
  std::array<Scene, width> scenes_;
  std::array<std::size_t, width> rows_{};
  std::array<Answer, SolvesTogether<Solve, Scene> ? width : 0> answers_;
  std::size_t count_ = 0;
};

}  // namespace detail

/// Answers a row for each element of `told`: the scene of `numbers` (inputs.hpp), with what is varied in place. scene_of(numbers) gives a
/// Result<Scene>, and where it has a member why(numbers) words for why there is none, or nullptr; solve(scene, refusal, monitor) gives the
/// Answer, and solve.together, where it has that, several at once. All are called on several threads. A row that is no scene, or has no answer,
/// says why.
template <class SceneOf, class Solve>
void sweep(const Family& family, std::span<const double> numbers, std::span<const Varied> varied,
           const SceneOf& scene_of, const Solve& solve, std::span<const SweepTarget> targets, std::span<SweepRow> told,
           unsigned threads, Monitor* monitor = nullptr) {
  for (const SweepTarget& target : targets) {
    std::fill(target.values.begin(), target.values.end(), nan<double>);
    std::fill(target.errors.begin(), target.errors.end(), nan<double>);
  }
  for (SweepRow& row : told) row = {.reason = not_reached};
  using Scene = std::remove_cvref_t<decltype(*scene_of(numbers))>;
  constexpr std::size_t at_once = detail::solved_at_once<Solve>;
  for_blocks(told.size(), threads, std::max<std::size_t>(at_once, 8), monitor, [&](Monitor& own) {
    return [&, scene = std::vector<double>(numbers.begin(), numbers.end()), waiting = detail::Waiting<Scene, Solve>()](
               std::size_t begin, std::size_t end) mutable {
      for (std::size_t row = begin; row < end && !own.cancel.load(std::memory_order_relaxed); ++row) {
        bool finite = true;
        for (const Varied& each : varied) {
          scene[each.place] = each.values[row];
          finite = finite && std::isfinite(each.values[row]);
        }
        if (!finite) {
          told[row] = {.reason = message(Errc::not_finite)};
          continue;
        }
        const std::span<const double> all(scene);
        if (auto made = scene_of(all)) waiting.add(std::move(made).value(), row);
        else told[row] = {.reason = detail::why_none(scene_of, all, made.error())};
        if (waiting.full()) waiting.solve_all(family, solve, targets, told, own);
      }
      waiting.solve_all(family, solve, targets, told, own);
    };
  });
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
