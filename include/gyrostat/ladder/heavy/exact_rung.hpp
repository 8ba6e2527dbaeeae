// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/heavy/forced_start.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/exact.hpp"

namespace gyrostat::heavy {

namespace detail {

/// Of a fast periodic motion that is known exactly.
inline Periodicity exact_periodicity(const Scene& scene, const State<double>& start, const Exact<double>& exact) {
  const auto& [spin, cosine] = *scene.periodic();
  const auto s = *Scaled<double>::make(scene.problem(), spin, cosine);
  constexpr double rounding = 64 * epsilon<double>;
  Periodicity known;
  if (const auto* pendulum = exact.pendulum()) {
    // with the gradient alone half a round repeats the rates, not down
    known.period = pendulum->period() * (scene.problem().moment().isZero(0) ? 2 : 1);
    known.period_error = rounding + exact.error(known.period).attitude;
    known.precession = known.precession_error = 0;
    return known;
  }
  const auto top = SymmetricTop<double>::of(scene.problem());
  if (!exact.euler() && !(top && top->axes(2, 2) == 1)) return known;
  // regular precession, or none
  known.precession = start.angular_velocity[0] / s.M3;
  known.precession_error = rounding * std::abs(known.precession);
  const double turning = start.angular_velocity[2] - known.precession * cosine;
  known.period = 2 * pi<double> / std::abs(turning);
  known.period_error = rounding * (1 + std::abs(known.precession * cosine / turning));
  const double nutation = exact.euler()        ? s.nutation_squared()
                          : exact.period() > 0 ? std::pow(known.period / exact.period(), 2)
                                               : nan<double>;
  const double angle = 2 * pi<double> * std::sqrt(std::abs(nutation));
  known.trace = nutation < 0 ? 2 * std::cosh(angle) : 2 * std::cos(angle);
  known.trace_error = rounding * (1 + angle * (nutation < 0 ? std::sinh(angle) : 1.0));
  return known;
}

}  // namespace detail

/// Rung `exact`: the cases that are known in closed form or by quadrature (docs/heavy.md, section 7).
inline Track exact_track(const Scene& scene, Monitor*) {
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
  const auto bound = exact.error(question.times.back());
  track.error = relative_to_truth(sizes.relative({bound.angular_velocity, bound.down, bound.attitude}), column_kinds);
  track.in_domain = bound.attitude < infinity<double>;
  if (!track.in_domain) track.warn(warning_kinds[warning::rounding_decides], question.times.back());

  if (scene.periodic()) {
    track.periodicity = detail::exact_periodicity(scene, start, exact);
    return track;
  }
  const auto one_turn = [&](double period) { return exact.error(period).attitude; };
  if (const auto* pendulum = exact.pendulum(); pendulum && pendulum->motion() != PendulumMotion::separatrix) {
    track.periodicity.period = pendulum->period();
    track.periodicity.period_error = one_turn(pendulum->period());
  }
  const auto precession = [&](const auto& top) {
    const double rate = top.mean_precession(), period = top.nutation_period();
    if (!(period < infinity<double>)) return;
    track.periodicity.precession = rate;
    track.periodicity.precession_error = one_turn(period) / period;
  };
  if (exact.top()) precession(*exact.top());
  if (exact.top_in_gradient()) precession(*exact.top_in_gradient());
  return track;
}

}  // namespace gyrostat::heavy
