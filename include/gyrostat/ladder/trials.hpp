// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>

#include "gyrostat/core/real.hpp"
#include "gyrostat/ode/status.hpp"

namespace gyrostat {

/// The tightest step tolerance that a Taylor integrator is asked for.
template <Real Scalar>
inline constexpr Scalar finest_step_tolerance = epsilon<Scalar> / 8;

/// Runs with a step tolerance, and up to twice more with a tighter one while the estimated error exceeds options.tolerance and a
/// tighter one may help. run(step_tolerance, progress_from, progress_to) gives an answer with status, met, error and counts; the
/// last answer is returned, with the counts of all.
template <Real Scalar, class Options, class Run>
auto tightened(const Options& options, Scalar step_tolerance, const Run& run) noexcept {
  constexpr Scalar finest = finest_step_tolerance<Scalar>;
  constexpr double part[] = {0.0, 0.7, 0.9, 1.0};
  ode::Counts counts;
  for (int trial = 0;; ++trial) {
    auto answer = run(step_tolerance, part[trial], part[trial + 1]);
    counts += answer.counts;
    answer.counts = counts;
    if (answer.met || trial == 2 || answer.status != ode::Status::reached || step_tolerance <= finest) {
      if (options.progress != nullptr) options.progress->store(1.0, std::memory_order_relaxed);
      return answer;
    }
    const Scalar excess = answer.error.greatest() / options.tolerance;
    step_tolerance = excess > 1 ? std::max(finest, step_tolerance / (8 * excess)) : finest;
  }
}

}  // namespace gyrostat
