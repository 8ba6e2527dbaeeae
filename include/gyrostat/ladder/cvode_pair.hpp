// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/ladder/comparison.hpp"
#include "gyrostat/ladder/cvode_walk.hpp"
#include "gyrostat/ladder/honesty.hpp"

/// The full equations by CVODE, the trusted outsider, twice: at a tolerance, and looser for the error. Needs the library gyrostat::cvode.
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
  std::vector<typename Writer::State> states;  ///< of the tighter run
  Errc failure = Errc::ok;
  ode::Counts counts;  ///< of both
  double tolerance;    ///< of the tighter run
  double margin;       ///< stated error over the distance
  Comparison<Writer> both;
};

/// run(tolerance, longest) gives a CvodeRun; longest: the share of the span that a step may take. `share`: of the answer's tolerance, what the
/// tighter run is asked for: what one step errs adds up over many.
template <class Writer, class Run>
CvodePair<Writer> cvode_pair(const Writer& writer, double tolerance, double share, const Run& run) {
  tolerance = std::max(honesty::cvode_tightest, tolerance * share);
  const double margin = tolerance > honesty::cvode_tightest ? honesty::cvode_margin : honesty::cvode_margin_of_rounding;
  CvodePair<Writer> pair{{}, Errc::ok, {}, tolerance, margin, Comparison<Writer>(writer)};
  auto tight = run(tolerance, honesty::cvode_longest[0]);
  if (tight.failure != Errc::ok) return pair.failure = tight.failure, pair;
  const auto looser = run(honesty::cvode_looser * tolerance, honesty::cvode_longest[1]);
  if (looser.failure != Errc::ok) return pair.failure = looser.failure, pair;
  for (std::size_t i = 0; i < tight.states.size(); ++i) pair.both.add(tight.states[i], looser.states[i]);
  pair.states = std::move(tight.states);
  pair.counts = tight.counts;
  pair.counts += looser.counts;
  return pair;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
