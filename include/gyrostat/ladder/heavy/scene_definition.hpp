// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "gyrostat/body/principal_axes.hpp"
#include "gyrostat/ladder/heavy/scene.hpp"

namespace gyrostat::heavy {

GYROSTAT_COMPILED_ONCE Result<Body> Body::make(const Mat3<double>& inertia, double mass,
                                               const Vec3<double>& centre_of_mass, double gravity,
                                               double gradient) noexcept {
  const auto symmetric = symmetric_part<double>(inertia);
  if (!symmetric) return symmetric.error();
  const auto axes = PrincipalAxes<double>::nearest(inertia);
  const auto made =
      Problem<double>::make(axes.moments, mass, axes.R_BP.transpose() * centre_of_mass, gravity, gradient);
  if (!made) return made.error();
  return Body{*made, axes.R_BP, inertia};
}

GYROSTAT_COMPILED_ONCE Result<Scene> Scene::make(const Body& body, const Start& start, const Question& question) {
  if (!start.state.angular_velocity.allFinite() || !start.state.down.allFinite()) return Errc::not_finite;
  if (const Errc wrong = check_times(question.times, question.tolerance); wrong != Errc::ok) return wrong;
  Scene scene;
  scene.body_ = body;
  scene.given_ = start;
  scene.given_.state.attitude = as_unit(start.state.attitude);
  scene.question_ = question;
  bool& turning = scene.question_.wants_attitude;
  if (!question.asked.empty()) turning = needs_column(question, tables, column::attitude);
  scene.given_.oriented = start.oriented || turning;
  State<double> from = start.state;
  if (scene.given_.oriented) {
    const double length = norm(from.attitude);
    if (!std::isfinite(length)) return Errc::not_finite;
    if (!(length > 0)) return Errc::zero_vector;
    from.attitude = scene.given().attitude;
    from.down = rotate<double>(conjugate(from.attitude), {0, 0, -1});
  } else {
    from.attitude = {};
    if (!(std::abs(from.down.norm() - 1) <= 1e-8)) return Errc::out_of_domain;
  }
  if (start.periodic) {
    const auto& [spin, cosine] = *start.periodic;
    if (!std::isfinite(spin) || !std::isfinite(cosine)) return Errc::not_finite;
    if (!(std::abs(cosine) < 1)) return Errc::out_of_domain;
  }
  scene.start_ = in_axes(body.R_BP.transpose(), from);
  scene.start_.down.normalize();
  return scene;
}

}  // namespace gyrostat::heavy
