// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/heavy/forced_track.hpp"

namespace gyrostat::heavy::detail {

GYROSTAT_COMPILED_ONCE const char* no_series(Errc why) noexcept {
  switch (why) {
    case Errc::not_applicable:
      return "a divisor 1 - A/C, 1 - B/C or A/C + B/C - 1 of the series vanishes, and what it divides does not";
    case Errc::no_convergence:
      return "the terms of the series do not fall: the spin is too slow, or too near a resonance";
    case Errc::out_of_domain: return "the series need a spin about axis 3, and an axis that is not vertical";
    default: return message(why);
  }
}

GYROSTAT_COMPILED_ONCE bool near_forced(const Scene& scene) noexcept {
  const State<double>& start = scene.start();
  const auto [spin, cosine] = forced_start(scene);
  if (!(std::abs(start.down[1]) < 1e-3) || !(start.down[0] > 0)) return false;
  const auto scaled = Scaled<double>::make(scene.problem(), spin, cosine);
  if (!scaled) return false;
  const FirstOrder<double> first(*scaled);
  const double p = start.angular_velocity[0] / spin - first.X - first.chi * scaled->M3;
  return std::hypot(p, start.angular_velocity[1] / spin - first.Y) < 0.02;
}

}  // namespace gyrostat::heavy::detail
