// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/ladder/general/track.hpp"

namespace gyrostat::general {

namespace detail {

GYROSTAT_COMPILED_ONCE Quat<double> orbit_axes(const OrbitPoint<double>& at) noexcept {
  const Vec3<double> normal = cross<double>(at.radial, at.along);
  Mat3<double> R;
  R.col(0) = at.along;
  R.col(1) = -normal;
  R.col(2) = -at.radial;
  return from_matrix<double>(R);
}

GYROSTAT_COMPILED_ONCE bool known(const Track& track, std::size_t place) noexcept {
  if (place == column::angular_momentum_norm && !track.norm.values.empty()) return true;
  if (place == column::energy && !track.energy.values.empty()) return true;
  for (std::size_t p = 0; p < primitive::count; ++p)
    if (has(made_of[place], p) && p != primitive::rotor_rate && std::isnan(track.off[p])) return false;
  return place != column::rotor_rate || !std::isnan(track.off[primitive::rotor_rate]);
}

}  // namespace detail

/// First and last angle of each row counted on from the row before.
inline void count_turns(Column& euler) noexcept {
  auto& values = euler.values;
  for (std::size_t i = 3; i < values.size(); ++i)
    if (i % 3 != 1) values[i] = values[i - 3] + std::remainder(values[i] - values[i - 3], 2 * pi<double>);
}

/// Rates and angles of the wheels at t = 0 as they were given.
inline void put_wheels(Answer& answer, const Wheels<double>& wheels) {
  if (answer.times.front() != 0) return;
  for (Column& column : answer.columns) {
    const bool rate = column.kind == &column_kinds[column::rotor_rate];
    if ((!rate && column.kind != &column_kinds[column::rotor_angle]) || column.error == infinity<double>) continue;
    for (std::size_t i = 0; i < wheels.count; ++i) column.values[i] = rate ? wheels.laws[i].rate : wheels.laws[i].angle;
  }
}

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  const auto scale = scene.scales();
  const detail::Writer write(scene, track);
  const std::size_t n = answer.times.size();
  for (std::size_t place = 0; place < std::size(column_kinds); ++place) {
    if (!scene.gives(place)) continue;
    const ColumnKind& kind = column_kinds[place];
    const std::size_t width = kind.width == per_rotor ? scene.wheels().count : std::size_t(kind.width);
    if (!detail::known(track, place)) {
      answer.columns.push_back({&kind, std::vector<double>(n * width, nan<double>), infinity<double>, scale[place]});
      answer.columns.back().width = int(width);
      continue;
    }
    answer.columns.push_back({&kind, std::vector<double>(n * width), 0, scale[place]});
    Column& column = answer.columns.back();
    column.width = int(width);
    for (std::size_t i = 0; i < n; ++i) write(place, i, answer.times[i], column.values.data() + i * width);
    if (place == column::euler) count_turns(column);
    const double off = write.off(place);
    column.error = kind.measure == Measure::relative ? relative_to_truth(over(off, size_of(column))) : off;
  }
  const auto& q = scene.problem().attitude;
  const auto& w = scene.problem().angular_velocity;
  put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  put_start(answer, column_kinds[column::angular_velocity], {w[0], w[1], w[2]});
  put_wheels(answer, scene.wheels());
}

}  // namespace gyrostat::general
