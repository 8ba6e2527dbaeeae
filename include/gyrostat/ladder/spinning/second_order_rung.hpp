// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/spinning/linear_rung.hpp"
#include "gyrostat/ladder/spinning/track.hpp"
#include "gyrostat/models/spinning/second_order.hpp"

namespace gyrostat::spinning {

/// Whether the times are worth going along as an even grid: what that begins with costs as much as some forty of them.
inline bool goes_along_grid(std::span<const double> times) noexcept { return times.size() >= 64 && even(times); }

/// Rung `second-order`: the linear motion with spin rate, spin angle, momentum and thrust right to the next order (docs/spinning.md,
/// section 6.1). Passed over where that would not make it better.
GYROSTAT_COMPILED_ONCE Track second_order_track(const Scene& scene, Monitor*);

}  // namespace gyrostat::spinning

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/spinning/second_order_rung_definition.hpp"
#endif
