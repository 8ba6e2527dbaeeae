// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "gyrostat/ladder/heavy/full_rung.hpp"
#include "gyrostat/ladder/honesty.hpp"

namespace gyrostat::heavy {

namespace detail {

GYROSTAT_COMPILED_ONCE Track full_from_start(const Scene& scene, bool converted, Monitor* monitor) {
  const Question& question = scene.question();
  const auto goal = scene.goal();
  if (phase_too_long(rate_size(scene.problem(), scene.start()) * question.times.back(), goal.tightest))
    return refused<Track>(Errc::step_limit, phase_lost);
  if (scene.full_equations) return scene.full_equations(scene, monitor);
  Track track;
  track.states.resize(question.times.size());
  FullMotionOptions<double> options;
  options.tolerance = goal.tightest;
  options.wanted = goal.columns.of;
  options.attitude = question.wants_attitude;
  options.converted = converted;
  options.monitor = monitor;
  const auto answer = full_motion<double>(scene.problem(), scene.start(), question.times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  track.error = answer->error;
  track.counts = answer->counts;
  return track;
}

/// Why there is no periodic motion to be found, and what to do.
inline const char* no_orbit(Errc why, const Scene& scene) noexcept {
  const auto& [spin, cosine] = *scene.periodic();
  const auto scaled = Scaled<double>::make(scene.problem(), spin, cosine);
  switch (why) {
    case Errc::not_applicable:
      return "two principal moments are equal, or the body is a lamina across axis 3, and the torque drives that "
             "resonance: there is no fast periodic motion; spin it about another principal axis, or give a start";
    case Errc::out_of_domain: return "a periodic motion of this family needs a spin, and an axis that is not vertical";
    case Errc::step_limit:
      return "no fast periodic motion with this spin was found within the budget of 50 thousand steps along their "
             "family, which ends or turns back at a spin of about 0.6 to 2 times sqrt(M g l/C), below which there are "
             "only oscillations about the hanging rest: spin it faster, or give a start";
    case Errc::no_convergence:
      if (scaled && fast_over(*scaled) == 1)
        return "no periodic motion was found near that of the first order: the body is too near a resonance (moments 1 "
               "and 3 or 2 and 3 nearly equal, a lamina across axis 3, axis 3 near the vertical); spin it faster or "
               "about another principal axis, or give a start";
      return "no fast periodic motion with this spin was found: the family ends or turns back at a spin of about 0.6 "
             "to 2 times sqrt(M g l/C), below which there are only oscillations about the hanging rest, or the body is "
             "too near a resonance (equal moments, a lamina across axis 3); spin it faster, or give a start";
    default: return message(why);
  }
}

GYROSTAT_COMPILED_ONCE Track periodic_full(const Scene& scene, Monitor* monitor) {
  const auto& [spin, cosine] = *scene.periodic();
  const auto found = periodic_orbit<double>(scene.problem(), spin, cosine);
  if (!found) return refused<Track>(found.error(), no_orbit(found.error(), scene));
  PeriodicOrbit<double> orbit = *found;
  orbit.error.start *= honesty::neighbours_margin;
  const PeriodicMotion<double> motion(scene.problem(), orbit, scene.question().times);

  Question once = scene.question();
  once.times = motion.once();
  once.asked.clear();
  once.wants_attitude = true;
  once.tolerance = std::max(scene.goal().tightest / 4 / (1 + motion.periods()), 1e-300);
  Body body;
  body.problem = scene.problem();
  const auto made_once = Scene::make(body, {orbit.start}, once);
  if (!made_once) return refused<Track>(made_once.error(), message(made_once.error()));
  Scene first = *made_once;
  first.full_equations = scene.full_equations;
  const Track one = full_from_start(first, scene.converts_body(), monitor);
  if (one.failure != Errc::ok) return one;

  Track track;
  track.warnings = one.warnings;
  track.counts = one.counts;
  track.counts += orbit.counts;
  track.states.resize(scene.question().times.size());
  const auto made = motion.carry_on(one.states, one.error, track.states);
  track.error = made.error;
  track.periodicity = {orbit.period,      orbit.error.period, orbit.trace_minus_4,
                       orbit.error.trace, made.precession,    made.precession_error};
  return track;
}

}  // namespace detail

}  // namespace gyrostat::heavy
