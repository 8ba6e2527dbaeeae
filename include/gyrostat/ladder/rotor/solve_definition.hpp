// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/rotor/closed_form_rung.hpp"
#include "gyrostat/ladder/rotor/cost.hpp"
#include "gyrostat/ladder/rotor/full_rung.hpp"
#include "gyrostat/ladder/rotor/linear_tail_rung.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/attractor.hpp"
#include "gyrostat/models/rotor/exceptional.hpp"
#include "gyrostat/models/rotor/steady.hpp"
#include "gyrostat/models/rotor/steady_stability.hpp"

namespace gyrostat::rotor {

/// Where the motion tends to, and warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  const auto& body = scene.gyrostat();
  const auto warn = [&](std::size_t which, double value = nan<double>, const char* text = nullptr) {
    answer.warnings.push_back({&warning_kinds[which], text ? text : warning_kinds[which].text, value});
  };
  if (!body.realisable()) warn(warning::not_realisable, body.realisability());

  const State<double>& last = track.states.back();
  const double l = last.momentum.norm();
  double index = nan<double>, rate = nan<double>;
  const auto steady = steady_rotations(body, l);
  const auto attractor = certify(body, steady, last.momentum, last.axial_momentum);
  if (attractor.index >= 0) {
    index = attractor.index;
    rate = stability_of(body, l, steady[attractor.index]).decay_rate;
  }
  answer.quantities.push_back({&scalar_kinds[scalar::attractor], {index}});
  answer.quantities.push_back({&scalar_kinds[scalar::decay_rate], {rate}});

  const auto family = exceptional_distance(body, l).family;
  if (body.slope() == 0) {
    warn(warning::no_motor);
  } else if (family == Exceptional::axisymmetric) {
    warn(warning::no_attractor);
  } else if (family == Exceptional::principal_axis && attractor.index >= 0 && std::isnan(rate)) {
    warn(warning::marginal);
  } else if (attractor.certificate == Certificate::undecided && l > 0) {
    warn(warning::attractor_undecided, attractor.margin,
         steady.count > 0 && attractor.margin > 0
             ? nullptr
             : "the motion stands on an unstable steady rotation or a barrier: rounding decides where it goes");
  }
}

/// In the order of rung_kinds.
inline constexpr Rung<Scene, Track> models[] = {{&closed_form_track, &cost_of_closed_form},
                                                {&linear_tail_track, &cost_of_linear_tail},
                                                {&full_track, &cost_of_full}};

GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept {
  return models[rung].cost(scene);
}

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

}  // namespace gyrostat::rotor
