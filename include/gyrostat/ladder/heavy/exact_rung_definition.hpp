// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/heavy/exact_rung.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE Track exact_track(const Scene& scene, Monitor*) {
  const Question& question = scene.question();
  State<double> start = scene.start();
  if (scene.periodic()) {
    const auto plain = plain_start(scene.problem(), *scene.periodic());
    if (!plain)
      return refused<Track>(Errc::not_applicable,
                            "no exact case: the start of this periodic motion is not known in closed form");
    start = *plain;
  }
  const Exact<double> exact(scene.problem(), start);
  if (scene.periodic() && exact.pendulum() && exact.pendulum()->motion() != PendulumMotion::rotation)
    return refused<Track>(Errc::not_applicable,
                          "no exact case: below twice the pendulum rate the body swings, and does not go round");
  if (!exact.applies())
    return refused<Track>(
        Errc::not_applicable,
        "no exact case: the body has weight or gradient, no axis of symmetry through its mass centre, and "
        "does not turn about a horizontal principal axis with weight or gradient alone");
  Track track;
  track.states.reserve(question.times.size());
  Comparison sizes(row_of(scene));
  for (const double t : question.times) {
    track.states.push_back(exact.at(t));
    sizes.add(track.states.back());
  }
  if (!std::isfinite(sizes.size()[column::down]))
    return refused<Track>(Errc::no_convergence,
                          "the closed form is lost in rounding: axis 3 starts too near the vertical, next to at rest");
  auto bound = exact.error(question.times.back());
  if (scene.converts_start() && bound.attitude < infinity<double>) {
    const int k = exact.pendulum() ? exact.pendulum()->axis() : -1;
    const auto off = [&](const Problem<double>& body, int which) -> Result<State<double>> {
      if (scene.periodic()) return plain_start(body, *scene.periodic());
      return off_start(start, which, k);
    };
    bound = conversion_error(scene.problem(), scene.converts_body(), exact, question.times.back(), off);
  }
  track.error = relative_to_truth(sizes.relative({bound.angular_velocity, bound.down, bound.attitude}), column_kinds);
  track.in_domain = bound.attitude < infinity<double>;
  if (!track.in_domain) track.warn(warning_kinds[warning::rounding_decides], question.times.back());

  if (scene.periodic()) track.periodicity = periodicity_of(scene, start, exact);
  return track;
}

}  // namespace gyrostat::heavy
