// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "gyrostat/ladder/rotor/scene.hpp"

namespace gyrostat::rotor {

GYROSTAT_COMPILED_ONCE Result<Scene> Scene::make(const Gyrostat<double>& gyrostat, const Start& start,
                                                 const Question& question) {
  if (!start.angular_velocity.allFinite() || !std::isfinite(start.rotor_rate)) return Errc::not_finite;
  if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
  const double length = norm(start.attitude);
  if (!std::isfinite(length)) return Errc::not_finite;
  if (!(length > 0)) return Errc::zero_vector;
  Scene scene;
  scene.gyrostat_ = gyrostat;
  scene.given_ = start;
  scene.given_.attitude = as_unit(start.attitude);
  scene.question_ = question;
  scene.start_ = gyrostat.state(scene.given_.attitude, start.angular_velocity, start.rotor_rate);
  const Vec3<double>& moments = gyrostat.principal();
  const double momentum = magnitude(scene.start_.momentum);
  const double fastest =
      std::max({magnitude(start.angular_velocity), std::abs(start.rotor_rate), std::abs(gyrostat.no_load_rate())});
  if (!can_be_squared(moments[0]) || !can_be_squared(moments[2]) || !can_be_squared(fastest) ||
      !(momentum * momentum < infinity<double>))
    return Errc::beyond_range;
  return scene;
}

}  // namespace gyrostat::rotor
