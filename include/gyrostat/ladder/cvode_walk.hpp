// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <span>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/outcome.hpp"
#include "gyrostat/ladder/pace.hpp"
#include "gyrostat/ode/cvode.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Steps CVODE from its time over times[next] and all behind it. keep(t) takes the state at an asked time inside the last step and says
/// whether CVODE gave it; moved() looks at the end of each step and says whether to go on. Returns why it failed, or ok; next is
/// the first time not kept, counts the work. Steps that would overrun their budget, as beside a jump that holds the motion, are given up early (Pace).
template <class Keep, class Moved>
Errc walk(ode::Cvode& cvode, std::span<const double> times, std::size_t& next, ode::Counts& counts, Monitor* monitor,
          const Keep& keep, const Moved& moved) {
  Pace<double> pace;
  while (next < times.size()) {
    if (pace.is_hopeless(counts.steps, cvode.time(), times.back(), ode::CvodeOptions{}.step_cap))
      return Errc::step_limit;
    const auto status = cvode.step(times.back());
    counts = cvode.counts();
    if (status != ode::Status::reached) return failure_of(status);
    for (; next < times.size() && times[next] <= cvode.time(); ++next)
      if (!keep(times[next])) return Errc::no_convergence;
    if (!moved()) return Errc::ok;
    if (monitor) {
      if (monitor->cancelled()) return Errc::cancelled;
      monitor->fraction.store(cvode.time() / times.back(), std::memory_order_relaxed);
    }
  }
  return Errc::ok;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
