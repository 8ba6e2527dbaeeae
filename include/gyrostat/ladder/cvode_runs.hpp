// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/companions.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/cvode_walk.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/trials.hpp"

/// The full equations by CVODE, for comparison: one run at a tolerance and, for its error, neighbours at looser ones. Needs the library gyrostat::cvode.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// The states of one run at the asked times.
template <class State>
struct CvodeRun {
  std::vector<State> states;
  Errc failure = Errc::ok;
  ode::Counts counts;
};

/// Why CVODE has not come to the last time.
constexpr const char* why_cvode_failed(Errc failure) noexcept {
  return failure == Errc::no_convergence ? "the steps of CVODE come to nothing before the last time: leave integrator "
                                           "to auto, or ask for a looser tolerance"
                                         : message(failure);
}

/// One run from t = 0. `equations` gives start(), the numbers at the start; state(numbers), a state that is kept; and system(). It must stay
/// where it is meanwhile.
template <class State, class Equations>
CvodeRun<State> run_cvode(Equations& equations, const State& start, std::span<const double> times,
                          const ode::CvodeOptions& options, Monitor* monitor) {
  CvodeRun<State> run;
  run.states.reserve(times.size());
  if (!(times.front() > 0)) run.states.push_back(start);
  if (!(times.back() > 0)) return run;
  auto numbers = equations.start();
  auto made = ode::Cvode::create(equations.system(), 0, numbers, options);
  if (!made) return run.failure = made.error(), run;
  auto cvode = std::move(made).value();
  std::size_t next = run.states.size();
  run.failure = walk(
      cvode, times, next, run.counts, monitor,
      [&](double t) {
        if (!cvode.at(t, numbers)) return false;
        run.states.push_back(equations.state(numbers.data()));
        return true;
      },
      [] { return true; });
  return run;
}

/// One run. longest: the share of the span that a step may take; change: by how much the data of a companion differ, 0 for the answer:
/// by what its steps may err, which a slim tensor or an unstable axis makes more of.
struct CvodeTask {
  double tolerance, longest;
  double change = 0;
  Aside aside = Aside::first;
};

/// The answer's run and how far its companions' are off.
template <class Writer>
struct CvodeRuns {
  std::vector<typename Writer::State> states;  ///< of the answer, at the asked times
  Errc failure = Errc::ok;
  ode::Counts counts;                        ///< of all
  double tolerance;                          ///< of the answer
  double margin[honesty::cvode_companions];  ///< stated error over the distance of each
  Comparison<Writer> asked;
  typename Comparison<Writer>::ColumnErrors error;  ///< in units of the columns
};

/// The asked times and others: where these are few some before the last one, `late`, as what runs differ by may swing, and be small there by chance; and some
/// over the whole span, at which runs are seen to part that have come back by then.
struct WatchedTimes {
  std::vector<double> times;
  double late;

  explicit WatchedTimes(std::span<const double> asked) : times(asked.begin(), asked.end()), late(infinity<double>) {
    const double last = asked.back();
    for (std::size_t i = 1; i < honesty::cvode_parted_looks; ++i)
      times.push_back(last * double(i) / honesty::cvode_parted_looks);
    if (asked.size() < honesty::cvode_looks) {
      late = last * (1 - honesty::cvode_watched);
      for (std::size_t i = 1; i < honesty::cvode_looks; ++i)
        times.push_back(last * (1 - honesty::cvode_watched * double(i) / honesty::cvode_looks));
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
  }
};

/// What lasts of a distance between motions that have parted (TellsParted); nothing of others.
template <class Writer>
typename Comparison<Writer>::ColumnErrors what_lasts(const Writer& writer, const typename Comparison<Writer>::Row& a,
                                                     const typename Comparison<Writer>::Row& b) noexcept {
  typename Comparison<Writer>::ColumnErrors lasting{};
  if constexpr (TellsParted<Writer, typename Comparison<Writer>::Row>) {
    if (!writer.has_parted(a, b)) return lasting;
    lasting = Comparison<Writer>::apart(a, b);
    for (std::size_t i = 0; i < std::size(Writer::columns); ++i)
      if (!lasts_in(writer, i)) lasting[i] = 0;
  }
  return lasting;
}

/// run(times, task) gives a CvodeRun: first the answer's, then the companions' in turn. `share`: of the answer's tolerance, what its run is asked for:
/// what one step errs adds up over many.
template <class Writer, class Run>
CvodeRuns<Writer> cvode_runs(const Writer& writer, std::span<const double> asked, double tolerance, double share,
                             const Run& run) {
  tolerance = std::max(honesty::cvode_tightest, tolerance * share);
  const double margin =
      tolerance > honesty::cvode_rounding_below ? honesty::cvode_margin : honesty::cvode_margin_of_rounding;
  CvodeRuns<Writer> runs{{}, Errc::ok, {}, tolerance, {}, Comparison<Writer>(writer), {}};
  const WatchedTimes all(asked);
  const std::vector<double>& times = all.times;
  const std::span<const double> watched = times;
  const auto answer = run(watched, CvodeTask{tolerance, honesty::cvode_longest[0]});
  if (answer.failure != Errc::ok) return runs.failure = answer.failure, runs;
  runs.counts = answer.counts;
  runs.states.reserve(asked.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    for (std::size_t k; (k = runs.states.size()) < asked.size() && asked[k] == times[i];) {
      runs.asked.add(answer.states[i]);
      runs.states.push_back(answer.states[i]);
    }
  const double change = std::max(honesty::alone_change * epsilon<double>, tolerance);
  for (int c = 0; c < honesty::cvode_companions; ++c) {
    const double looser = honesty::cvode_looser[c];
    const auto companion = run(watched, CvodeTask{looser * tolerance, honesty::cvode_longest[1 + c], change,
                                                  c == 0 ? Aside::first : Aside::second});
    if (companion.failure != Errc::ok) return runs.states.clear(), runs.failure = companion.failure, runs;
    runs.counts += companion.counts;
    runs.margin[c] = margin * honesty::cvode_looser[0] / looser;
    typename Comparison<Writer>::ColumnErrors distance;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto a = runs.asked.row(answer.states[i]), b = runs.asked.row(companion.states[i]);
      const bool counts = times[i] >= all.late || std::binary_search(asked.begin(), asked.end(), times[i]);
      distance.raise(counts ? runs.asked.apart(a, b) : what_lasts(writer, a, b));
    }
    runs.error.raise(runs.margin[c] * distance);
  }
  return runs;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
