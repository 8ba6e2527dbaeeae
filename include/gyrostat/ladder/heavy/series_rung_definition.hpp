// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/heavy/series_rung.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE Track series_track(const Scene& scene, Monitor*) {
  if (scene.converts_body() && !scene.periodic() && axes_undecided(scene.problem()))
    return refused<Track>(Errc::not_applicable, undecided_axes);
  if (!scene.periodic() && !detail::near_forced(scene))
    return refused<Track>(
        Errc::not_applicable,
        "the start is not that of the periodic motion: it has a free nutation, which the series leave out");
  const auto [spin, cosine] = forced_start(scene);
  // what the series leave out of a given start is a free nutation, wider by what departed() allows for
  const double tolerance = scene.goal().tightest / (scene.periodic() ? 2 : 128);
  const auto motion =
      Series<double>::to_tolerance(scene.problem(), spin, cosine, tolerance, scene.question().times.back());
  if (!motion) return refused<Track>(motion.error(), detail::no_series(motion.error()));
  return detail::forced_track(scene, *motion, rung::series);
}

}  // namespace gyrostat::heavy
