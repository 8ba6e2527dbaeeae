// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "gyrostat/ladder/free/scene.hpp"
#include "gyrostat/rotation/vector.hpp"

namespace gyrostat::free {

GYROSTAT_COMPILED_ONCE Result<Scene> Scene::make(const Assembly<double>& assembly, const Question& question,
                                                 UnsoundWheel<double>* unsound) {
  if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
  const auto sound = Reduced<double>::of(assembly, unsound);
  if (!sound) return sound.error();
  Scene scene;
  scene.assembly_ = assembly;
  scene.gyrostat_ = *sound;
  const auto& p = scene.principal_ = PrincipalProblem<double>::of(sound->problem);
  const double momenta = std::max(magnitude(p.G), magnitude(p.l));
  if (!can_be_squared(p.moments[0]) || !can_be_squared(p.moments[2]) || !(momenta * momenta < infinity<double>))
    return Errc::beyond_range;
  scene.question_ = question;
  return scene;
}

GYROSTAT_COMPILED_ONCE Vec3<double> Scene::angular_velocity() const noexcept {
  const auto& p = gyrostat_.problem;
  return p.momentum_given ? Vec3<double>(p.inertia.inverse() * (p.angular_momentum - p.rotor_momentum))
                          : p.angular_velocity;
}

}  // namespace gyrostat::free
