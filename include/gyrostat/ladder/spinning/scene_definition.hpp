// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/spinning/scene.hpp"

namespace gyrostat::spinning {

GYROSTAT_COMPILED_ONCE Result<Scene> Scene::make(const Problem<double>& problem, const Question& question) {
  const auto& p = problem;
  const auto& a = p.angles;
  if (!p.inertia.allFinite() || !p.torque.allFinite() || !p.force.allFinite() || !p.angular_velocity.allFinite() ||
      !p.velocity.allFinite() || !p.position.allFinite() || !std::isfinite(p.mass) ||
      !std::isfinite(p.rotor_momentum) || !std::isfinite(p.charge_momentum) || !std::isfinite(a.psi) ||
      !std::isfinite(a.phi) || !std::isfinite(a.theta))
    return Errc::not_finite;
  if (!(p.mass > 0) || !(p.inertia.minCoeff() > 0)) return Errc::not_positive;
  const double most = p.inertia.maxCoeff();
  if (most > (p.inertia.sum() - most) + 8 * epsilon<double> * most) return Errc::triangle_inequality;
  if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
  Scene scene;
  scene.problem_ = problem;
  scene.question_ = question;
  return scene;
}

}  // namespace gyrostat::spinning
