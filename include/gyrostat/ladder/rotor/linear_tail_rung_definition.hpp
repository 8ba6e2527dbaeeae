// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/rotor/linear_tail_rung.hpp"

namespace gyrostat::rotor {

namespace detail {

/// The distance from which a tail up to t should meet the tolerance: its error goes with the third power of the distance.
inline double wanted_distance(const LinearTail<double>& tail, double t, double tolerance, double fast) noexcept {
  const double error = tail.error(t).attitude;
  const double wanted = error < infinity<double> ? tail.distance() * std::cbrt(tolerance / (4 * error))
                                                 : std::cbrt(tolerance * std::min(1.0, tail.decay_rate() / fast)) / 8;
  return std::min(wanted, 0.05);
}

/// Solves the full equations until the tail from there meets the tolerance, and goes on with it. Not applicable where the times
/// end before, or so soon after that nothing is won.
inline Track tail_after_full_motion(const Scene& scene, const ExponentialAttractors& attractors, Monitor* monitor) {
  const auto& body = scene.gyrostat();
  const auto& times = scene.question().times;
  const double last = times.back(), tolerance = scene.goal().tightest, l = scene.start().momentum.norm();
  const double fast = (l + std::abs(body.target_momentum())) / body.principal()[0];
  // greatest share of the times that the full equations may take: they are solved twice where the first window was too short
  const double worth = scene.question().rung == rung::linear_tail ? 0.9 : 0.25;
  const Row<double> row(body, scene.start());
  const Track not_worth = over_tolerance<Track>(nan<double>);

  const auto time_to_fall = [&](const LinearTail<double>& tail, double from, double wanted) {
    return std::log(std::max(1.0, std::min(from, 1.0) / wanted)) / tail.decay_rate();
  };
  const auto first = attractors.tail(body, scene.start());
  const double wanted = wanted_distance(first, last, tolerance, fast);
  double window = 1.2 * time_to_fall(first, first.distance(), wanted) + 4 / first.decay_rate();
  // the tail makes of an error of its start as much as eps fast/rate times more
  double inner = tolerance / (4 + 16 * wanted * fast / first.decay_rate());
  ode::Counts counts;
  for (int trial = 0; trial < 4; ++trial) {
    if (!(window <= worth * last)) return not_worth;
    Question inside = scene.question();
    inside.tolerance = std::max(inner, 1e-15);
    inside.asked.clear();
    inside.times.resize(std::size_t(std::lower_bound(times.begin(), times.end(), window) - times.begin()));
    inside.times.push_back(window);
    Track track = full_track(scene.asked(inside), monitor);
    if (track.failure != Errc::ok) return track;
    counts += track.counts;

    Comparison sizes(row);
    for (const auto& state : track.states) sizes.add(state);
    const auto tail = attractors.tail(body, track.states.back());
    track.states.pop_back();
    auto bound = tail.error(last - window);
    const auto carried = tail.carried(track.error[column::angular_momentum] * sizes.unit(column::angular_momentum),
                                      track.error[column::rotor_rate] * sizes.unit(column::rotor_rate));
    bound += carried;
    bound.attitude += 4 * epsilon<double> * last * fast;
    if (bound.attitude + track.error[column::attitude] <= tolerance && bound.momentum <= tolerance * l) {
      for (std::size_t i = track.states.size(); i < times.size(); ++i)
        track.states.push_back(tail.at(times[i] - window));
      track.error += state_columns(row, scene.start(), track.states, bound);
      track.counts = counts;
      if (track.error.greatest() <= tolerance) {
        track.warn(warning_kinds[warning::hand_over], window);
        return track;
      }
    }
    const double left = last - window;
    const double fall = time_to_fall(tail, tail.distance(), wanted_distance(tail, left, tolerance, fast));
    window += std::max(window / 2, 1.3 * fall);
    inner /= 4;
  }
  return not_worth;
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Track linear_tail_track(const Scene& scene, Monitor* monitor) {
  const auto& body = scene.gyrostat();
  const auto& start = scene.start();
  const Question& question = scene.question();
  const double l = start.momentum.norm();
  if (!(l > 0))
    return refused<Track>(Errc::not_applicable, "the body has no angular momentum: no steady rotation to tend to");
  if (!(body.slope() > 0))
    return refused<Track>(Errc::not_applicable, "the motor has no slope: nothing decays to a steady rotation");
  const detail::ExponentialAttractors attractors(body, l);
  if (attractors.count == 0)
    return refused<Track>(Errc::not_applicable,
                          "no steady rotation attracts exponentially: the rotor does not feel the nutation");

  const auto tail = attractors.tail(body, start);
  auto bound = tail.error(question.times.back());
  if (const double condition = body.condition(); condition > 1) {
    const auto Omega = body.angular_velocity(start.momentum, start.axial_momentum);
    const double off = 4 * epsilon<double> * condition * Omega.norm();
    bound += tail.carried(4 * epsilon<double> * body.momentum_blur(Omega), off);
    bound.attitude += off * question.times.back();
  }
  const bool near = bound.attitude < infinity<double>;
  const Row<double> row(body, start);
  const auto alone = [&] {
    Track track;
    track.states.reserve(question.times.size());
    for (const double t : question.times) track.states.push_back(tail.at(t));
    track.error = state_columns(row, start, track.states, bound);
    track.in_domain = near;
    if (!near) track.warn(warning_kinds[warning::beyond_validity], tail.distance());
    return track;
  };
  Track track;
  if (near) {
    track = alone();
    if (scene.goal().excess(track.error) <= 1) return track;
  }
  Track handed = detail::tail_after_full_motion(scene, attractors, monitor);
  if (handed.failure == Errc::ok || handed.failure == Errc::cancelled) return handed;
  if (near) return track;
  if (question.rung == rung::linear_tail && tail.distance() < 0.5) return alone();
  return refused<Track>(Errc::not_applicable,
                        "too far from every steady rotation that attracts, and not near one soon enough");
}

}  // namespace gyrostat::rotor
