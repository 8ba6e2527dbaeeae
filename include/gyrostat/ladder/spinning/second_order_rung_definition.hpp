// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>

#include "gyrostat/ladder/spinning/second_order_rung.hpp"

namespace gyrostat::spinning {

GYROSTAT_COMPILED_ONCE Track second_order_track(const Scene& scene, Monitor*) {
  const Problem<double>& problem = scene.problem();
  if (problem.torque[2] != 0)
    return refused<Track>(Errc::not_applicable,
                          "a torque acts about the spin axis: the spin is not constant to first order");
  const auto& times = scene.question().times;
  const double end = times.back();
  auto error = second_order_errors(problem, end);
  if (detail::worth_a_closer_look(scene, rung::second_order, error) && end > 0) {
    const TiltOrders<double> orders(problem, end);
    const bool named = scene.question().rung == rung::second_order;
    const double of_use = named ? infinity<double> : scene.goal().columns[column::attitude];
    if (orders.knows_tilt() && orders.tilt(end) <= of_use)
      error = second_order_errors(problem, end, Look::close, orders.third_order());
    error.attitude = detail::looked_at(scene, error, [&](std::span<const double> at) {
      return second_order_attitude_error<double>(error, orders, at);
    });
  }
  if (detail::gives_up(scene, rung::second_order, error)) return detail::given_up(error);
  const SecondOrder<double> motion(problem, end > 0 ? end : 1e-6);  // of the start alone any span will do
  if (!motion.applies())
    return refused<Track>(
        Errc::not_applicable,
        "more than 1e8 rad at the fastest rate of the motion: too many turns for the integrals of second order");
  if (!motion.helps())
    return refused<Track>(Errc::not_applicable,
                          "the corrections of second order would harm: they turn the body by more than 0.5 rad, or the "
                          "tilt exceeds 0.3 rad");
  Track track;
  track.states.resize(times.size());
  if (goes_along_grid(times)) {
    detail::linear_states(problem, times, track.states);
    motion.correct(times.front(), (end - times.front()) / double(times.size() - 1), track.states);
  } else {
    std::transform(times.begin(), times.end(), track.states.begin(), [&](double t) { return motion.at(t); });
  }
  return detail::judged(std::move(track), scene, error, detail::linear_conversion_errors(scene));
}

}  // namespace gyrostat::spinning
