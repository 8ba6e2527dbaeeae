// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/heavy/forced_track.hpp"
#include "gyrostat/models/heavy/nutating.hpp"
#include "gyrostat/models/heavy/series_2.hpp"

namespace gyrostat::heavy {

/// Rung `series-2`: the forced motion of a fast spin to second order (docs/heavy.md, section 3) where the scene asks for the periodic
/// motion; from another start with the free nutation, to first order (section 5), or without it where that errs less.
inline Track series_2_track(const Scene& scene, Monitor*) {
  const auto [spin, cosine] = forced_start(scene);
  if (scene.periodic()) {
    const auto motion = Series2<double>::make(scene.problem(), spin, cosine);
    if (!motion) return refused<Track>(motion.error(), detail::no_series(motion.error()));
    return detail::forced_track(scene, *motion, rung::series_2);
  }
  const double end = scene.question().times.back();
  auto nutating = Nutating<double>::make(scene.problem(), scene.start());
  // of a lamina across axis 3 the mean of psi' is lost in rounding
  if (nutating && !(nutating->scaled().flatness > 1e-6)) nutating = Errc::not_applicable;
  const double first = nutating ? nutating->error(end).relative(spin) : infinity<double>;
  if (detail::near_forced(scene)) {
    const auto motion = Series2<double>::make(scene.problem(), spin, cosine);
    if (motion && detail::forced_error(scene, *motion).relative(spin) < first)
      return detail::forced_track(scene, *motion, rung::series_2);
  }
  if (!nutating)
    return refused<Track>(
        Errc::not_applicable,
        "the start is not that of the periodic motion, and there is no formula for its free nutation: axis 3 is "
        "that of the intermediate moment, of one equal to it, or does not spin");
  return detail::series_track(scene, *nutating, nutating->error(end), rung::series_2);
}

}  // namespace gyrostat::heavy
