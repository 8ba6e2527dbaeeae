// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/balance.hpp"
#include "gyrostat/models/heavy/sleeping_top.hpp"
#include "gyrostat/models/heavy/symmetric_top.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE double stability(const Periodicity& known) noexcept {
  const OrbitStability verdict = orbit_stability(known.trace, known.trace_error);
  if (verdict == OrbitStability::undecided) return known.stable;
  return verdict == OrbitStability::stable ? 1 : 0;
}

GYROSTAT_COMPILED_ONCE void warn_of_balance(Track& track, const Scene& scene) {
  const Problem<double>& problem = scene.problem();
  const State<double>& start = scene.start();
  if (const auto top = SymmetricTop<double>::of(problem)) {
    const Vec3<double> down = top->axes.transpose() * start.down;
    const double spin = top->axes.col(2).dot(start.angular_velocity);
    const auto sleep = sleeping_top(*top, down[2] > 0, spin);
    if (std::hypot(down[0], down[1]) < 0.1 && sleep.verdict == SleepVerdict::unstable)
      return track.warn(warning_kinds[warning::unstable_sleep], sleep.threshold);
  }
  constexpr double rounding = 64 * epsilon<double>;
  if (!is_steady(problem, start.angular_velocity, start.down, rounding)) return;
  const double growth = growth_rate(problem, start.angular_velocity, start.down);
  if (growth > 0) track.warn(warning_kinds[warning::unstable_balance], growth);
}

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, CallersRow{row_of(scene), scene.R_BP()}, track.states, track.error, scene.question(), tables,
               scene.question().wants_attitude ? 0 : column_set(column::attitude));
  if (!scene.periodic()) {
    const auto& [w, d, q] = scene.given();
    put_start(answer, column_kinds[column::angular_velocity], {w[0], w[1], w[2]});
    if (!scene.oriented()) put_start(answer, column_kinds[column::down], {d[0], d[1], d[2]});
    put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  }
}

GYROSTAT_COMPILED_ONCE void tell(Answer& answer, const Periodicity& known) {
  const auto quantity = [&](std::size_t which, double value, double error) {
    if (!std::isnan(value)) answer.quantities.push_back({&scalar_kinds[which], {value}, error});
  };
  quantity(scalar::period, known.period, known.period_error);
  quantity(scalar::floquet_trace, known.trace, known.trace_error);
  quantity(scalar::stable, stability(known), nan<double>);
  quantity(scalar::precession_rate, known.precession, known.precession_error);
}

}  // namespace gyrostat::heavy
