// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstring>

#include "gyrostat/ladder/heavy/exact_rung.hpp"
#include "gyrostat/ladder/heavy/full_rung.hpp"
#include "gyrostat/ladder/heavy/series_2_rung.hpp"
#include "gyrostat/ladder/heavy/series_rung.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "gyrostat/models/heavy/sleeping_top.hpp"

namespace gyrostat::heavy {

namespace detail {

/// Warnings of a fast periodic motion (docs/heavy.md, section 10).
inline void warn_of_periodic(Answer& answer, const Scaled<double>& s) {
  const auto warn = [&](const char* code, const char* text, double value) {
    answer.warnings.push_back({code, text, value});
  };
  const Doubts doubt = doubts(s);
  if (doubt.slow)
    warn("slow-spin",
         "the spin is below three times sqrt(M g l/C): series are poor, and below 0.6 to 2 times there is no such "
         "motion; the "
         "ratio is",
         1 / std::sqrt(s.load.norm()));
  if (doubt.strong_gradient)
    warn("strong-gradient", "the gravity gradient is strong beside the spin; N/r0^2 is", s.gradient);
  // a slow spin is near everything
  if (!doubt.slow && doubt.near_a)
    warn("near-equal-moments-1", "moments 1 and 3 are nearly equal and the weight drives that resonance; 1 - A/C is",
         s.off_a);
  if (!doubt.slow && doubt.near_b)
    warn("near-equal-moments-2", "moments 2 and 3 are nearly equal and the weight drives that resonance; 1 - B/C is",
         s.off_b);
  if (!doubt.slow && doubt.near_lamina)
    warn("near-lamina",
         "the body is nearly a lamina across axis 3, whose free nutation keeps pace with the spin; A/C + B/C - 1 is",
         s.flatness);
  if (doubt.upright)
    warn("upright",
         "axis 3 may pass near the vertical: its precession loses its meaning; the sine of its inclination is", s.M3);
  const Floquet<double> floquet(s);
  const double off = std::sqrt(std::max(floquet.squared, 0.0)) - 0.5;
  if (floquet.tongue > 0 && std::abs(off) < 2 * floquet.tongue + floquet.squared_error)
    warn("resonance",
         "the free nutation is near half the spin rate, where a parametric resonance may make it grow; they differ, "
         "over the spin, by",
         off);
}

/// Warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene) {
  const Problem<double>& problem = scene.problem();
  if (scene.question().periodic) {
    const auto& [spin, cosine] = *scene.question().periodic;
    if (const auto scaled = Scaled<double>::make(problem, spin, cosine)) warn_of_periodic(answer, *scaled);
    double stable = 1, trace = nan<double>;
    for (const Quantity& q : answer.quantities) {
      if (std::strcmp(q.name, "stable") == 0) stable = q.values[0];
      if (std::strcmp(q.name, "floquet_trace") == 0) trace = q.values[0];
    }
    if (stable == 0)
      answer.warnings.push_back({"unstable", "a free nutation beside this motion grows over a period by the factor",
                                 multipliers(trace).first.re});
  } else if (const auto top = SymmetricTop<double>::of(problem)) {
    const Vec3<double> down = top->axes.transpose() * scene.start().down;
    const double spin = top->axes.col(2).dot(scene.start().angular_velocity);
    const auto sleep = sleeping_top(*top, down[2] > 0, spin);
    if (std::hypot(down[0], down[1]) < 0.1 && sleep.verdict == SleepVerdict::unstable)
      answer.warnings.push_back(
          {"unstable-sleep",
           "the top spins too slowly to stay upright: its tilt grows; the least spin that holds it, rad/s",
           sleep.threshold});
  }
  if (problem.gradient() > 0) {
    const double distance = 3 * problem.gravity() / problem.gradient();
    const double size = std::sqrt(problem.inertia().sum() / (2 * problem.mass()));
    if (!(distance > 100 * size))
      answer.warnings.push_back(
          {"gradient",
           "gravity and gravity gradient belong to a centre at 3 g/N, which is not far beside the body's size: give "
           "them on purpose only; m",
           distance});
  }
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  static constexpr std::array<Rung<Scene, Track>, 4> rungs{
      {{"exact", &exact_track}, {"series-2", &series_2_track}, {"series", &series_track}, {"full", &full_track}}};
  static constexpr int place[] = {-1, 1, 2, 0, 3};
  const int only = place[int(scene.question().model)];
  Answer answer = climb<Scene, Track>(rungs, scene, scene.question().tolerance, only, monitor, refusal);
  if (refusal.code == Errc::ok) detail::describe(answer, scene);
  return answer;
}

}  // namespace gyrostat::heavy
