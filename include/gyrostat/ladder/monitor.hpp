// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "gyrostat/core/level.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Lets a caller watch and stop long work, from another thread or by a function that the work asks.
struct Monitor {
  std::atomic<double> fraction{0};  ///< of the work, in [0, 1]
  std::atomic<bool> cancel{false};
  bool (*stop)() noexcept =
      nullptr;  ///< asked now and then by the thread that works; true ends the work as `cancel` does

  /// Whether the work is to end. What `stop` has said once holds from then on: it may say so only once, as of a signal.
  bool cancelled() noexcept {
    if (stop != nullptr && !cancel.load(std::memory_order_relaxed) && stop())
      cancel.store(true, std::memory_order_relaxed);
    return cancel.load(std::memory_order_relaxed);
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
