// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/ladder/cost.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/general/full_motion.hpp"
#include "gyrostat/ladder/general/track.hpp"
#include "gyrostat/ladder/goal.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ladder/trials.hpp"

namespace gyrostat::general {

inline constexpr const char* too_stiff =
    "wheels and damping both settle so fast that the full equations would take too many steps: leave out what hardly "
    "matters, or ask for a shorter span";

inline constexpr const char* forcing_lost =
    "a wave, the magnetic field or the orbit goes through more than 1e8 rad up to the last time, and its phase is "
    "lost: "
    "ask for a shorter span or take it out";

namespace detail {

/// Primitives stand first in full_columns, in the same order.
static_assert(std::size_t{primitive::attitude} == std::size_t{full_column::attitude} &&
              std::size_t{primitive::position} == std::size_t{full_column::position});

/// What is asked of the primitives so that the columns made of them are as asked.
inline FullErrors<double> wanted_of(const Scene& scene, const Goal<std::size(column_kinds)>& goal,
                                    const FullRow<double>& row) noexcept {
  const auto scale = scene.scales();
  auto wanted = FullErrors<double>::all(infinity<double>);
  constexpr std::size_t own[] = {column::attitude,   column::angular_velocity, column::angular_momentum,
                                 column::rotor_rate, column::rotor_angle,      column::velocity,
                                 column::position};
  for (std::size_t c = 0; c < std::size(column_kinds); ++c) {
    if (!(goal.columns[c] < infinity<double>) || !scene.has_column(c)) continue;
    for (std::size_t p = 0; p < primitive::count; ++p) {
      if (!has(made_of[c], p) || (p == primitive::rotor_rate && scene.wheels().count == 0)) continue;
      // what is made of others shares its tolerance among them; one scale may be below the other
      const double share = own[p] == c ? 1.0 : 0.5;
      const double finer = row.scale[p] > 0 && scale[own[p]] < row.scale[p] ? scale[own[p]] / row.scale[p] : 1.0;
      wanted[p] = std::min(wanted[p], goal.columns[c] * share * std::max(finer, 1e-3));
    }
  }
  return wanted;
}

/// The absolute errors of the primitives.
inline std::array<double, primitive::count> off_of(const Track& track, const FullErrors<double>& error,
                                                   const FullRow<double>& row, const Scene& scene) noexcept {
  std::array<double, primitive::count> off;
  std::array<double, primitive::count> size{};
  const auto norm = [](const auto& values) noexcept {
    double square = 0;
    for (const double x : values) square += x * x;
    return std::sqrt(square);
  };
  for (const auto& s : track.states) {
    const double sizes[] = {1,
                            s.angular_velocity.norm(),
                            s.angular_momentum.norm(),
                            norm(s.rotor_rate),
                            norm(s.rotor_angle),
                            s.velocity.norm(),
                            s.position.norm()};
    for (std::size_t p = 0; p < primitive::count; ++p) size[p] = std::max(size[p], sizes[p]);
  }
  for (std::size_t p = 0; p < primitive::count; ++p)
    off[p] = p == primitive::attitude || error[p] == 0 ? error[p] : error[p] * std::max(size[p], row.scale[p]);
  if (scene.wheels().count == 0) off[primitive::rotor_rate] = off[primitive::rotor_angle] = nan<double>;
  return off;
}

/// Where it is asked for: how well energy and momentum at the last time agree with all power and torque on the way, by a run of its own.
inline void balance(Track& track, const Scene& scene, double step_tolerance) noexcept {
  const Question& question = scene.question();
  if (!aim_of(question, tables, true, scalar::energy_balance) &&
      !aim_of(question, tables, true, scalar::momentum_balance))
    return;
  const auto residuals = balance_residuals<double>(scene.problem(), question.times.back(), step_tolerance);
  track.energy_balance = residuals.energy;
  track.momentum_balance = residuals.momentum;
}

/// Steps that a run takes so that wheels settle as they should, or by Radau, which need not follow them, what damping there is.
inline double settling_steps(const Scene& scene) noexcept {
  const double rate = scene.is_stiff() ? scene.sizes().damping : scene.settling_rate();
  return rate * scene.question().times.back() / 8;
}

}  // namespace detail

/// Of wheels and torques that need no states of their own; and of the others, and of a path that forces bend.
inline constexpr SeriesCost small_series_cost{15e-6, 12e-6, 1e-6, 0.7}, large_series_cost{40e-6, 40e-6, 2e-6, 0.7};
/// Of wheels that settle fast, by Radau: some forty short steps until they follow, then those that the body asks for.
inline constexpr SeriesCost stiff_cost{800e-6, 20e-6, 3e-6, 1};

inline double cost_of_full(const Scene& scene) noexcept {
  const auto& times = scene.question().times;
  const double phase = (scene.sizes().turning + scene.sizes().forcing) * times.back();
  const double tolerance = first_step_tolerance(scene.goal().tightest, phase, honesty::loosest_step);
  const auto& cost = scene.is_stiff() ? stiff_cost : scene.is_large() ? large_series_cost : small_series_cost;
  const double again = scene.is_stiff() ? 10 : 2;  // steps that a breakpoint costs
  return cost(phase + detail::settling_steps(scene), tolerance, times.size()) +
         double(scene.breaks()) * again * cost.step;
}

namespace detail {

/// The refusal of a scene whose phases no integrator keeps; of others no failure.
inline Track unless_lost(const Scene& scene) {
  const double span = scene.question().times.back();
  if (phase_too_long(scene.sizes().turning * span, scene.goal().tightest))
    return refused<Track>(Errc::step_limit, phase_lost);
  if (!(scene.sizes().forcing * span <= most_forcing)) return refused<Track>(Errc::out_of_domain, forcing_lost);
  return {};
}

}  // namespace detail

/// Rung `full`: the full equations by Taylor series, or by Radau where wheels settle fast.
inline Track full_track(const Scene& scene, Monitor* monitor) {
  const Question& question = scene.question();
  const auto& times = question.times;
  const auto goal = scene.goal();
  Track track = detail::unless_lost(scene);
  if (track.failure != Errc::ok) return track;
  if (detail::settling_steps(scene) > double(step_budget)) return refused<Track>(Errc::step_limit, too_stiff);
  const FullRow<double> row(Prepared<double>(scene.problem(), times.back()));
  const auto wanted = detail::wanted_of(scene, goal, row);
  track.states.resize(times.size());
  FullMotionOptions<double> options;
  options.integrator = question.integrator;
  options.tolerance = goal.tightest;
  options.wanted = wanted.of;
  if (monitor) options.progress = &monitor->fraction, options.cancel = &monitor->cancel;
  const auto answer = full_motion<double>(scene.problem(), times, track.states, options);
  if (!answer) return refused<Track>(answer.error(), message(answer.error()));
  if (answer->status == ode::Status::event) return refused<Track>(Errc::not_applicable, why_stopped_by_brake);
  if (answer->outgrown) return refused<Track>(Errc::step_limit, why_outgrown);
  if (answer->status != ode::Status::reached)
    return refused<Track>(failure_of(answer->status), why_stopped(answer->status));
  track.counts = answer->counts;
  track.off = detail::off_of(track, answer->error, row, scene);
  detail::balance(track, scene, answer->step_tolerance);
  return track;
}

}  // namespace gyrostat::general
