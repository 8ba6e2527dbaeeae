// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gyrostat/ladder/rotor/track.hpp"

namespace gyrostat::rotor {

GYROSTAT_COMPILED_ONCE void fill(Answer& answer, const Scene& scene, const Track& track) {
  fill_head(answer, scene.question(), track);
  fill_columns(answer, Row<double>(scene.gyrostat(), scene.start()), track.states, track.error, scene.question(),
               tables);
  const auto& [q, Omega, omega] = scene.given();
  put_start(answer, column_kinds[column::attitude], {q.x, q.y, q.z, q.w});
  put_start(answer, column_kinds[column::angular_velocity], {Omega[0], Omega[1], Omega[2]});
  put_start(answer, column_kinds[column::rotor_rate], {omega});
}

}  // namespace gyrostat::rotor
