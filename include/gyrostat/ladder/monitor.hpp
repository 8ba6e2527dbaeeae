// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "gyrostat/core/level.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// Lets a caller watch and stop long work from another thread.
struct Monitor {
  std::atomic<double> fraction{0};  ///< of the work, in [0, 1]
  std::atomic<bool> cancel{false};
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
