// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "gyrostat/ladder/rotor/closed_form_rung.hpp"
#include "gyrostat/ladder/rotor/cost.hpp"
#include "gyrostat/ladder/rotor/full_lanes.hpp"
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

GYROSTAT_COMPILED_ONCE double cost_of(const Scene& scene, int rung) noexcept { return models[rung].cost(scene); }

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, models, scene, monitor, refusal);
}

GYROSTAT_COMPILED_ONCE unsigned solve_together(std::span<const Scene> scenes, std::span<Answer> answers,
                                               Monitor* monitor) {
  unsigned answered = 0;
  const auto take = [&](std::size_t i, std::optional<Answer>&& answer) {
    if (!answer) return;
    answers[i] = *std::move(answer);
    answered |= 1U << i;
  };
  std::array<LaneTask, SweepSolver::width> tasks;
  std::array<Track, SweepSolver::width> tracks;
  std::array<Goal<std::size(column_kinds)>, SweepSolver::width> goals;
  std::array<std::size_t, SweepSolver::width> places{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    const Question& question = scene.question();
    if (scene.full_equations ||
        !suits_lanes(scene.gyrostat(), scene.start(), question.times.back(), question.integrator))
      continue;
    bool comes = false;
    take(i, climb_to<Scene, Track>(tables, models, std::size_t(rung::full), scene, monitor, comes));
    if (!comes) continue;
    goals[count] = scene.goal();
    tracks[count].states.resize(question.times.size());
    LaneTask& task = tasks[count];
    task.gyrostat = &scene.gyrostat();
    task.start = scene.start();
    task.times = question.times;
    task.states = tracks[count].states;
    task.options.tolerance = goals[count].tightest;
    task.options.wanted = goals[count].columns.of;
    task.options.monitor = monitor;
    places[count++] = i;
  }
  full_in_lanes(std::span(tasks).first(count));
  for (std::size_t n = 0; n < count; ++n) {
    const FullMotionAnswer<double>& found = tasks[n].answer;
    if (found.status != ode::Status::reached) continue;
    tracks[n].error = found.error;
    tracks[n].counts = found.counts;
    take(places[n], met_by(tables, rung_kinds[rung::full].name, scenes[places[n]], tracks[n]));
  }
  return answered;
}

}  // namespace gyrostat::rotor
