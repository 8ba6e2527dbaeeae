// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/exact.hpp"

namespace gyrostat::heavy {

/// Rung `exact`: the cases that are known in closed form or by quadrature (docs/heavy.md, section 7).
inline Track exact_track(const Scene& scene, Monitor*) {
  const Question& question = scene.question();
  if (question.periodic)
    return refused<Track>(Errc::not_applicable,
                          "no exact case: the start is that of a periodic motion still to be found");
  const Exact<double> exact(scene.problem(), scene.start());
  if (!exact.applies())
    return refused<Track>(
        Errc::not_applicable,
        "no exact case: the body has weight or gradient, no axis of symmetry through its mass centre, and "
        "does not turn about a horizontal principal axis with weight or gradient alone");
  Track track;
  track.states.reserve(question.times.size());
  Comparison<double> sizes;
  for (const double t : question.times) {
    track.states.push_back(exact.at(t));
    sizes.add(track.states.back(), track.states.back());
  }
  const auto bound = exact.error(question.times.back());
  track.error = sizes.relative({bound.angular_velocity, bound.down, bound.attitude});
  track.in_domain = bound.attitude < infinity<double>;
  if (!track.in_domain)
    track.warn(
        "rounding-decides",
        "before the last time rounding of the data has grown to the size of the motion (a separatrix, a start off the "
        "plane of a pendulum, or a very long time)",
        question.times.back());

  const auto one_turn = [&](double period) { return exact.error(period).attitude; };
  if (const auto* pendulum = exact.pendulum(); pendulum && pendulum->motion() != PendulumMotion::separatrix) {
    track.periodicity.period = pendulum->period();
    track.periodicity.period_error = one_turn(pendulum->period());
  }
  const auto precession = [&](const auto& top) {
    const double rate = top.mean_precession(), period = top.nutation_period();
    if (!(period < infinity<double>)) return;
    track.periodicity.precession = rate;
    track.periodicity.precession_error = one_turn(period) / std::abs(rate * period);
  };
  if (exact.top()) precession(*exact.top());
  if (exact.top_in_gradient()) precession(*exact.top_in_gradient());
  return track;
}

}  // namespace gyrostat::heavy
