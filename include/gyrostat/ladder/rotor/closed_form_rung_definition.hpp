// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/rotor/closed_form_rung.hpp"

namespace gyrostat::rotor {

GYROSTAT_COMPILED_ONCE Track closed_form_track(const Scene& scene, Monitor*) {
  const ClosedForm<double> form(scene.gyrostat(), scene.start());
  if (form.kind() == ClosedFormKind::none)
    return refused<Track>(
        Errc::not_applicable,
        "no closed form: the body has momentum, is not symmetric about the rotor's axis, and starts neither in a "
        "steady rotation nor on the circle of a circular section");
  const auto bound = form.error(scene.question().times.back());
  Track track;
  track.states.reserve(scene.question().times.size());
  for (const double t : scene.question().times) track.states.push_back(form.at(t));
  track.error = state_columns({scene.gyrostat(), scene.start()}, scene.start(), track.states, bound);
  track.in_domain = bound.attitude < infinity<double>;
  if (!track.in_domain) track.warn(warning_kinds[warning::leaves_closed_form], form.defect());
  return track;
}

}  // namespace gyrostat::rotor
