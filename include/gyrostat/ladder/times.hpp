// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <span>

#include "gyrostat/core/result.hpp"

namespace gyrostat {

/// Whether an answer can be asked for at these times, s, to this tolerance. Errc::not_finite; out_of_domain: no times, or a
/// tolerance outside (0, 1); negative: a time before the start; not_increasing.
inline Errc check_times(std::span<const double> times, double tolerance) noexcept {
  if (!std::isfinite(tolerance)) return Errc::not_finite;
  if (!(tolerance > 0 && tolerance < 1) || times.empty()) return Errc::out_of_domain;
  double last = -1;
  for (const double t : times) {
    if (!std::isfinite(t)) return Errc::not_finite;
    if (t < 0) return Errc::negative;
    if (!(t > last)) return Errc::not_increasing;
    last = t;
  }
  return Errc::ok;
}

}  // namespace gyrostat
