// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "gyrostat/ladder/heavy/series_2_rung.hpp"
#include "gyrostat/ladder/honesty.hpp"

namespace gyrostat::heavy {

namespace detail {

/// The error of a nutating motion with that of conversions: four times the distance to the motions of two bodies and starts that are off by
/// what they err.
inline MotionError<double> nutating_error(const Scene& scene, const Nutating<double>& motion, double end) {
  MotionError<double> error = motion.error(end);
  if (!scene.converts_start()) return error;
  // on the ladder a motion that misses the tolerance by far more than any conversion is passed over as it is
  constexpr double clear = 1e-6;
  const auto goal = scene.goal().columns;
  const auto misses = [&](double off, std::size_t place) { return off > std::max(clear, goal[place]); };
  if (scene.question().rung == any_rung &&
      (misses(error.down, column::down) || misses(error.attitude, column::attitude)))
    return error;
  constexpr double open = infinity<double>;
  constexpr int looks = 32;
  Comparison apart(Row<double>{});
  for (const int which : {0, 1}) {
    const Problem<double> body = scene.converts_body() ? off_body(scene.problem(), which) : scene.problem();
    const auto other = Nutating<double>::make(body, off_start(scene.start(), which, -1));
    if (!other) return {open, open, pi<double>};
    for (int i = 0; i <= looks; ++i) apart.add(motion.at(end * i / looks), other->at(end * i / looks));
  }
  constexpr double margin = honesty::neighbours_margin;
  const auto& off = apart.difference();
  error.angular_velocity += margin * off[column::angular_velocity];
  error.down += margin * off[column::down];
  error.attitude = std::min(error.attitude + margin * off[column::attitude], pi<double>);
  return error;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track series_2_track(const Scene& scene, Monitor*) {
  if (scene.converts_body() && !scene.periodic() && axes_undecided(scene.problem()))
    return refused<Track>(Errc::not_applicable, undecided_axes);
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
  const MotionError<double> error = nutating ? detail::nutating_error(scene, *nutating, end) : MotionError<double>{};
  const double first = nutating ? error.relative(spin) : infinity<double>;
  if (detail::near_forced(scene)) {
    const auto motion = Series2<double>::make(scene.problem(), spin, cosine);
    if (motion && detail::forced_error(scene, *motion).relative(spin) < first)
      return detail::forced_track(scene, *motion, rung::series_2);
  }
  if (!nutating)
    return refused<Track>(
        Errc::not_applicable,
        nutating.error() == Errc::out_of_domain
            ? detail::no_series(nutating.error())
            : "the start is not that of the periodic motion, and there is no formula for its free nutation: axis 3 is "
              "that of the intermediate moment, of one equal to it, or across a lamina");
  return detail::series_track(scene, *nutating, error, rung::series_2);
}

}  // namespace gyrostat::heavy
