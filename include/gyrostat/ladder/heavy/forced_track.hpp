// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/heavy/forced_start.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/floquet.hpp"
#include "gyrostat/models/heavy/series.hpp"

/// What the rungs of the series share.
namespace gyrostat::heavy::detail {

GYROSTAT_COMPILED_ONCE const char* no_series(Errc why) noexcept;

/// Whether the start may be that of a forced motion: d2 = 0 < d1, and rates near those of the first order.
GYROSTAT_COMPILED_ONCE bool near_forced(const Scene& scene) noexcept;

/// Of a forced motion against the motion that the scene asks for.
template <class Motion>
MotionError<double> forced_error(const Scene& scene, const Motion& motion) noexcept {
  const double end = scene.question().times.back();
  MotionError<double> error = motion.error(end);
  if (scene.periodic()) return error;
  // the periodic motion starts where the formula says but for its error
  const auto first = motion.error(0);
  const double off =
      departure(scene.start(), motion.at(0)) + std::hypot(first.angular_velocity / motion.scaled().spin, first.down);
  const auto added = departed(motion.scaled(), off, end);
  error.angular_velocity += added.angular_velocity;
  error.down += added.down;
  error.attitude = std::min(error.attitude + added.attitude, pi<double>);
  return error;
}

/// The states, and errors relative to the greatest norms. Gives up beforehand where another rung may answer.
template <class Motion>
Track series_track(const Scene& scene, const Motion& motion, const MotionError<double>& error, int rung) {
  const Question& question = scene.question();
  const double spin = motion.scaled().spin;
  const ColumnErrors<double> known{{error.angular_velocity / std::abs(spin), error.down, error.attitude}};
  const double greatest = std::max({known[0], known[1], question.wants_attitude ? known[2] : 0.0});
  // |w| may exceed the spin
  if (question.rung != rung && !(scene.goal().excess(known) <= 4)) return over_tolerance<Track>(greatest);
  Track track;
  track.states.resize(question.times.size());
  motion.at(question.times, track.states, question.wants_attitude);
  Comparison sizes(row_of(scene));
  for (const State<double>& state : track.states) sizes.add(state);
  track.error = relative_to_truth(sizes.relative({error.angular_velocity, error.down, error.attitude}), column_kinds);
  track.in_domain = greatest < series_domain;
  if (!track.in_domain) track.warn(warning_kinds[warning::beyond_validity], greatest);
  return track;
}

/// Of a motion that repeats.
template <class Motion>
Track forced_track(const Scene& scene, const Motion& motion, int rung) {
  const Floquet<double> floquet(motion.scaled());
  // the motion must not depend on the rung, and so on the tolerance
  if (scene.periodic() && !floquet.alone && scene.question().rung != rung)
    return refused<Track>(Errc::not_applicable,
                          "another periodic motion may be near, and the full equations say which one is meant");
  Track track = series_track(scene, motion, forced_error(scene, motion), rung);
  if (track.failure != Errc::ok) return track;
  if (!scene.periodic()) {
    const Quat<double> turned = scene.start().attitude * conjugate(motion.at(0).attitude);
    for (State<double>& state : track.states) state.attitude = turned * state.attitude;
    return track;
  }
  // trace = 2 cos sqrt y, y = 4 pi^2 nu^2; 4: twice the largest of 3000 bodies
  const double low = std::sqrt(std::max(floquet.squared_error - floquet.squared, 0.0));  // nu may be i low
  const double growth = std::max(floquet.growth, 2 * pi<double> * low);
  const double steep = growth > 700 ? infinity<double> : growth > 0 ? std::sinh(growth) / growth : 1.0;
  const double trace_error = 4 * 4 * pi<double> * pi<double> * (floquet.squared_error + 32 * epsilon<double>)*steep;
  // what the series leave out may be small in one number by chance
  const double beyond = track.in_domain ? 0 : infinity<double>;
  track.periodicity = {motion.period(),      motion.period_error() + beyond, floquet.trace_minus_4,
                       trace_error + beyond, motion.precession_rate(),       motion.precession_error() + beyond};
  // next to nu = 1/2 the tongue decides, whose half width, though a small part of nu, may be many of its errors
  if (floquet.verdict != FastStability::undecided)
    track.periodicity.stable = floquet.verdict == FastStability::stable ? 1 : 0;
  return track;
}

}  // namespace gyrostat::heavy::detail

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/heavy/forced_track_definition.hpp"
#endif
