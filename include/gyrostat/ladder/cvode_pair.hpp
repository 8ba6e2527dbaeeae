// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/cvode_walk.hpp"
#include "gyrostat/ladder/honesty.hpp"

/// The full equations by CVODE, the trusted outsider, twice: at a tolerance, and a neighbour's looser for the error. Needs the library gyrostat::cvode.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// The states of one run at the asked times.
template <class State>
struct CvodeRun {
  std::vector<State> states;
  Errc failure = Errc::ok;
  ode::Counts counts;
};

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

/// Two runs and their distance.
template <class Writer>
struct CvodePair {
  std::vector<typename Writer::State> states;  ///< of the tighter run, at the asked times
  Errc failure = Errc::ok;
  ode::Counts counts;  ///< of both
  double tolerance;    ///< of the tighter run
  double margin;       ///< stated error over the distance
  Comparison<Writer> asked;
  typename Comparison<Writer>::ColumnErrors distance;  ///< in units of the columns
};

/// The asked times, and where these are few some before the last one: what runs differ by may swing, and be small there by chance.
inline std::vector<double> watched_times(std::span<const double> asked) {
  std::vector<double> times(asked.begin(), asked.end());
  if (asked.size() >= honesty::cvode_looks) return times;
  for (std::size_t i = 1; i < honesty::cvode_looks; ++i)
    times.push_back(asked.back() * (1 - honesty::cvode_watched * double(i) / honesty::cvode_looks));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// run(times, tolerance, longest, change) gives a CvodeRun; longest: the share of the span that a step may take; change: by how much the data of the
/// looser run differ, 0 for the tighter one: by what its steps may err, which a slim tensor or an unstable axis makes more of. `share`: of the
/// answer's tolerance, what the tighter run is asked for: what one step errs adds up over many.
template <class Writer, class Run>
CvodePair<Writer> cvode_pair(const Writer& writer, std::span<const double> asked, double tolerance, double share,
                             const Run& run) {
  tolerance = std::max(honesty::cvode_tightest, tolerance * share);
  const double margin = tolerance > honesty::cvode_rounding_below ? honesty::cvode_margin : honesty::cvode_margin_of_rounding;
  CvodePair<Writer> pair{{}, Errc::ok, {}, tolerance, margin, Comparison<Writer>(writer), {}};
  const auto times = watched_times(asked);
  const std::span<const double> watched = times;
  const auto tight = run(watched, tolerance, honesty::cvode_longest[0], 0.0);
  if (tight.failure != Errc::ok) return pair.failure = tight.failure, pair;
  const double change = std::max(honesty::alone_change * epsilon<double>, tolerance);
  const auto looser = run(watched, honesty::cvode_looser * tolerance, honesty::cvode_longest[1], change);
  if (looser.failure != Errc::ok) return pair.failure = looser.failure, pair;
  pair.states.reserve(asked.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto row = pair.asked.row(tight.states[i]);
    pair.distance.raise(pair.asked.apart(row, pair.asked.row(looser.states[i])));
    for (std::size_t k; (k = pair.states.size()) < asked.size() && asked[k] == times[i];) {
      pair.asked.add(row);
      pair.states.push_back(tight.states[i]);
    }
  }
  pair.counts = tight.counts;
  pair.counts += looser.counts;
  return pair;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
