// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gyrostat/ladder/general/start_error.hpp"
#include "gyrostat/rotation/exp_log.hpp"

namespace gyrostat::general {

namespace detail {

GYROSTAT_COMPILED_ONCE Apart Apart::of(const Column& one, const Column& other) {
  const auto width = std::size_t(one.row_width());
  const bool turns = one.kind->measure == Measure::angle && width == 4;
  Apart made{turns ? 3 : width, {}};
  for (std::size_t at = 0; at + width <= one.values.size(); at += width) {
    const double *x = &one.values[at], *y = &other.values[at];
    if (turns) {
      const Vec3<double> turn = vector_from_quaternion<double>(conjugate(Quat<double>{x[3], x[0], x[1], x[2]}) *
                                                               Quat<double>{y[3], y[0], y[1], y[2]});
      made.values.insert(made.values.end(), turn.begin(), turn.end());
    } else {
      for (std::size_t i = 0; i < width; ++i) made.values.push_back(y[i] - x[i]);
    }
  }
  return made;
}

GYROSTAT_COMPILED_ONCE bool turns_along(const Problem<double>& problem) noexcept {
  return std::all_of(problem.torques.begin(), problem.torques.end(), [](const auto& torque) {
    switch (torque.type) {
      case TorqueType::constant:
      case TorqueType::table: return torque.axes == Axes::body;
      case TorqueType::damping:
      case TorqueType::brake:
      case TorqueType::charge: return true;
      default: return false;
    }
  });
}

GYROSTAT_COMPILED_ONCE std::vector<Displacement> displacements(const Scene& scene) {
  std::vector<Displacement> made;
  const auto& error = scene.start_error();
  // what turns along does not show in the angles of a sequence as one turn
  const bool turns = error.attitude > 0 && (!turns_along(scene) || scene.gives(column::euler));
  for (int i = 0; i < 3; ++i) {
    if (turns) made.push_back({Displacement::turn, i});
    if (error.angular_velocity > 0) made.push_back({Displacement::rate, i});
  }
  if (error.rotor_rate > 0)
    for (std::size_t i = 0; i < scene.wheels().count; ++i)
      if (const auto& law = scene.wheels().laws[i];
          law.follows != Follows::body && !(law.follows == Follows::rate && law.tabled))
        made.push_back({Displacement::wheel, int(i)});
  return made;
}

GYROSTAT_COMPILED_ONCE void add_what_goes_along(Carried& carried, const Scene& scene, const Answer& answer) noexcept {
  const StartError& start = scene.start_error();
  const bool turned = turns_along(scene) && !scene.gives(column::euler);
  for (std::size_t i = 0; i < answer.columns.size(); ++i) {
    const auto place = std::size_t(answer.columns[i].kind - column_kinds);
    double& sum = carried.columns[i];
    if (turned && answer.columns[i].kind->measure == Measure::angle) sum += start.attitude;
    if (turned && place == column::angular_momentum_inertial) sum += start.attitude * size_of(answer.columns[i]);
    if (place == column::rotor_angle) sum += start.rotor_angle;
    if (place == column::velocity) sum += start.velocity;
    if (place == column::position) sum += start.position + start.velocity * scene.question().times.back();
  }
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE void add_carried(Answer& answer, const Carried& carried) noexcept {
  for (std::size_t i = 0; i < answer.columns.size(); ++i) {
    Column& column = answer.columns[i];
    if (column.kind->measure != Measure::relative) {
      column.error += carried.columns[i];
      continue;
    }
    // over the least that the true column may be, less both errors, or over its scale where that is more
    const double size = size_of(column), own = column.error < infinity<double> ? column.error / (1 + column.error) : 1;
    const double all = own * size + carried.columns[i];
    column.error = all < infinity<double> ? over(all, std::max(column.scale, size - all)) : infinity<double>;
  }
  for (Quantity& quantity : answer.quantities)
    if (quantity.kind == &scalar_kinds[scalar::stop_time])
      quantity.error += over(carried.stop_time, std::abs(quantity.values[0]));
}

}  // namespace gyrostat::general
