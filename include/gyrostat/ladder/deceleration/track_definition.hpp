// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/deceleration/track.hpp"

namespace gyrostat::deceleration {

/// The errors as the columns measure them.
inline ColumnErrors<double> relative_error(const Track& track, const Scene& scene) noexcept {
  Comparison sizes(Row<double>{scene.problem()});
  for (const auto& state : track.states) sizes.add(state);
  return sizes.relative(track.error);
}

GYROSTAT_COMPILED_ONCE void withhold_stop(Track& track, const Scene& scene) {
  const Question& question = scene.question();
  if (question.rung != any_rung || scene.needs_stop()) return;
  if (track.stop_error > question.tolerance && track.stop_time > question.times.back()) {
    track.warn(warning::stop_withheld, track.stop_time);
    track.stop_time = nan<double>;
  }
}

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, Row<double>{scene.problem(), scene.R_BP()}, track.states, relative_error(track, scene),
               scene.question(), tables, track.unknown());
  const Setup& given = scene.setup();
  const Vec3<double>& M = given.momentum;
  const Quat<double>& q = given.attitude;
  put_start(answer, column_kinds[column::angular_momentum], {M[0], M[1], M[2]});
  if (given.angular_velocity) {
    const Vec3<double>& omega = *given.angular_velocity;
    put_start(answer, column_kinds[column::angular_velocity], {omega[0], omega[1], omega[2]});
  }
  put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  if (std::isnan(track.stop_time)) return;
  answer.quantities.push_back({&scalar_kinds[scalar::stop_time], {track.stop_time}, track.stop_error});
}

}  // namespace gyrostat::deceleration
