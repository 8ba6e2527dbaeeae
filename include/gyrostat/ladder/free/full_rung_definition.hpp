// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "gyrostat/ladder/free/full_rung.hpp"

namespace gyrostat::free {

GYROSTAT_COMPILED_ONCE Track full_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  const auto& times = question.times;
  const auto goal = scene.goal();
  // the momenta of wheels may nearly cancel: their sum is rounded once
  const Problem<double> problem =
      scene.wheels() > 0 ? scene.precise().problem.cast<double>() : scene.gyrostat().problem;
  const double phase = turning_rate(scene.principal()) * times.back();
  if (phase_too_long(phase, goal.tightest)) return refused<Track>(Errc::step_limit, phase_lost);
  if (phase > (question.rung == any_rung ? costly_angle : unreachable_angle))
    return refused<Track>(
        Errc::step_limit,
        "the body turns so often that the full equations would take too many steps: the closed form takes none");
  std::vector<FullState<double>> found(times.size());
  // what the wheels turned through hangs on the integral of omega
  const Errors<std::size(full_columns)> wanted{
      {goal.columns[column::attitude],
       std::min(goal.columns[column::angular_velocity], goal.columns[column::rotor_rate]),
       goal.columns[column::angular_momentum],
       scene.needs_turned() ? goal.columns[column::rotor_angle] : infinity<double>}};
  MotionOptions<double> options;
  options.tolerance = goal.tightest;
  options.wanted = wanted.of;
  options.monitor = monitor;
  const auto answer = full_motion<double>(problem, times, found, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));

  Track track;
  track.counts = answer->counts;
  double angle = 1e-3, turned = scene.needs_turned() ? 1e-3 : 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    track.states.push_back({found[i].angular_velocity, found[i].angular_momentum, found[i].attitude});
    track.turned.push_back(found[i].turned);
    if (scene.needs_turned()) turned = std::max(turned, found[i].turned.norm());
    double square = 0;
    for (const auto& wheel : scene.gyrostat().wheels)
      square += std::pow(rotor_angle(wheel, times[i], found[i].turned), 2);
    angle = std::max(angle, std::sqrt(square));
  }
  track.error[column::attitude] = answer->error[0];
  track.error[column::angular_velocity] = answer->error[1];
  track.error[column::angular_momentum] = answer->error[2];
  if (const std::size_t n = scene.wheels(); n > 0) {
    track.error[column::rotor_rate] = detail::rate_error(scene, track.states, answer->error[1]);
    const double rates = 8 * epsilon<double> * angle;
    track.error[column::rotor_angle] =
        relative_to_truth((std::sqrt(double(n)) * answer->error[3] * turned + rates) / angle);
  }
  if (tells_scalars(question)) {  // they come from the closed form
    track.form = quick_form_of(scene);
    if (!track.form)
      if (const auto made = closed_form_of(scene)) track.form = *made;
    if (track.form) detail::warn_of_motion(track, track.form->motion, track.form->error.kinds_agree());
  } else if (const auto motion = Motion<double>::make(problem)) {
    detail::warn_of_motion(track, *motion, true);
  }
  return track;
}

}  // namespace gyrostat::free
