// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/ladder/deceleration/scene.hpp"

namespace gyrostat::deceleration {

GYROSTAT_COMPILED_ONCE Result<Scene> Scene::make(const Inertia<double>& body, const Setup& setup,
                                                 const Question& question) {
  if (!setup.rotor_momentum.allFinite() || !setup.control.allFinite() || !std::isfinite(setup.drag) ||
      !setup.momentum.allFinite() || (setup.angular_velocity && !setup.angular_velocity->allFinite()))
    return Errc::not_finite;
  if (setup.control.minCoeff() < 0 || setup.drag < 0) return Errc::negative;
  if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
  if (setup.angular_velocity) {
    const Vec3<double>&w = *setup.angular_velocity, &l = setup.rotor_momentum;
    const Vec3<double> off = setup.momentum - (body.tensor() * w + l);
    const Vec3<double> size = body.tensor().cwiseAbs() * w.cwiseAbs() + l.cwiseAbs();
    if (off.cwiseAbs().maxCoeff() > 1e-9 * size.maxCoeff()) return Errc::out_of_domain;
  }
  const double length = norm(setup.attitude);
  if (!std::isfinite(length)) return Errc::not_finite;
  if (!(length > 0)) return Errc::zero_vector;

  Scene scene;
  scene.setup_ = setup;
  scene.inertia_ = body.tensor();
  scene.ask(question);
  scene.R_BP_ = body.R_BP();
  const Mat3<double> R_PB = scene.R_BP_.transpose();
  scene.problem_.inverse_inertia = body.inverse_principal();
  scene.problem_.gaps = body.inverse_gaps();
  scene.problem_.exact_moments = body.has_exact_moments();
  scene.problem_.control = R_PB * setup.control.asDiagonal() * scene.R_BP_;
  const double rounding = 4 * epsilon<double> * setup.control.maxCoeff();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)  // as where two equal controls are turned about the axis of the third
      if (i != j && std::abs(scene.problem_.control(i, j)) <= rounding) scene.problem_.control(i, j) = 0;
  if (scene.equal_control()) scene.problem_.control = setup.control.asDiagonal();  // in any axes
  scene.problem_.drag = setup.drag;
  scene.problem_.law = setup.law;
  scene.problem_.drag_law = setup.drag_law;
  using Wide = DoubleDouble;
  const Vec3<Wide> l = body.in_principal_axes(vector_cast<Wide>(setup.rotor_momentum));
  scene.problem_.rotor_momentum = vector_cast<double>(l);
  Vec3<Wide> M = body.in_principal_axes(vector_cast<Wide>(setup.momentum));
  if (setup.angular_velocity) {
    const Vec3<Wide> omega = body.in_principal_axes(vector_cast<Wide>(*setup.angular_velocity));
    for (int i = 0; i < 3; ++i) M[i] = body.principal()[i] * omega[i] + l[i];
  }
  scene.problem_.momentum = vector_cast<double>(M);
  scene.problem_.momentum_converted = setup.angular_velocity && !body.has_exact_moments();
  if (!body.has_exact_moments()) scene.problem_.make_round();
  const double momentum = magnitude(scene.problem_.momentum);
  if (!can_be_squared(body.principal()[0]) || !can_be_squared(body.principal()[2]) ||
      !(momentum * momentum < infinity<double>))
    return Errc::beyond_range;
  return scene;
}

}  // namespace gyrostat::deceleration
