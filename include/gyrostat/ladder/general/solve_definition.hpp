// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "gyrostat/ladder/general/full_rung.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "gyrostat/ladder/general/special_rung.hpp"

namespace gyrostat::general {

/// What is known of the scene and of the whole motion.
inline void describe(Answer& answer, const Scene& scene, const Track& track) {
  const auto tell = [&](std::size_t which, double value, double error = nan<double>) {
    answer.quantities.push_back({&scalar_kinds[which], {value}, error});
  };
  const auto warn = [&](std::size_t which, double value) {
    answer.warnings.push_back({&warning_kinds[which], warning_kinds[which].text, value});
  };
  double families = 0;
  for (std::size_t i = 0; i < specials; ++i)
    if (scene.instances().has(Special(i))) families += double(1U << i);
  tell(scalar::recognised, families);
  if (!std::isnan(track.stop_time)) tell(scalar::stop_time, track.stop_time, track.stop_error);
  if (!std::isnan(track.energy_balance)) tell(scalar::energy_balance, track.energy_balance);
  if (!std::isnan(track.momentum_balance)) tell(scalar::momentum_balance, track.momentum_balance);
  const auto& problem = scene.problem();
  if (const double room = realisability(problem); room < -8 * epsilon<double> * problem.inertia.trace())
    warn(warning::not_realisable, room);
  const auto drives = [](const Mat3<double>& m) { return symmetric_eigen<double>((m + m.transpose()) / 2).values[0]; };
  for (const auto& torque : problem.torques) {
    if (torque.type == TorqueType::damping && drives(torque.matrix) < 0)
      warn(warning::driven_damping, drives(torque.matrix));
    if (torque.type == TorqueType::eddy_current && drives(torque.matrix) < 0)
      warn(warning::eddy_not_positive, drives(torque.matrix));
  }
  for (const auto& wheel : problem.wheels)
    if (wheel.type == WheelType::motor && std::abs(wheel.rate) > std::abs(wheel.no_load_rate) && wheel.slope > 0)
      warn(warning::beyond_no_load, wheel.rate);
}

namespace detail {

template <std::size_t... Place>
constexpr auto models_of(std::index_sequence<Place...>) noexcept {
  return std::array<Rung<Scene, Track>, sizeof...(Place) + 1>{
      {{&special_track<Place>, &cost_of_special<Place>}..., {&full_track, &cost_of_full}}};
}
inline constexpr auto models = models_of(std::make_index_sequence<std::size_t(rung::full)>{});

}  // namespace detail

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, gyrostat::Refusal& refusal, Monitor* monitor) {
  return climb<Scene, Track>(tables, detail::models, scene, monitor, refusal);
}

}  // namespace gyrostat::general
