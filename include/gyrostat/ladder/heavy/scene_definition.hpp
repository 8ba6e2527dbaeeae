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
  // what goes to principal axes is rounded once
  const auto axes = PrincipalAxes<DoubleDouble>::nearest(matrix_cast<DoubleDouble>(inertia));
  const Vec3<DoubleDouble> centre = axes.R_BP.transpose() * vector_cast<DoubleDouble>(centre_of_mass);
  const auto made =
      Problem<double>::make(vector_cast<double>(axes.moments), mass, vector_cast<double>(centre), gravity, gradient);
  if (!made) return made.error();
  return Body{*made, matrix_cast<double>(axes.R_BP), axes.R_BP, inertia};
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
  } else {
    from.attitude = {};
    if (!(std::abs(from.down.norm() - 1) <= 1e-8)) return Errc::out_of_domain;
  }
  if (start.periodic) {
    const auto& [spin, cosine] = *start.periodic;
    if (!std::isfinite(spin) || !std::isfinite(cosine)) return Errc::not_finite;
    if (!(std::abs(cosine) < 1)) return Errc::out_of_domain;
  }
  using Wide = DoubleDouble;
  const auto& q = from.attitude;
  State<Wide> wide{vector_cast<Wide>(from.angular_velocity), vector_cast<Wide>(from.down),
                   normalised(Quat<Wide>{q.w, q.x, q.y, q.z})};
  if (scene.given_.oriented) wide.down = rotate<Wide>(conjugate(wide.attitude), {0, 0, -1});
  wide = in_axes<Wide>(body.wide_R_BP.transpose(), wide);
  const auto& turned = wide.attitude;
  scene.start_ = {vector_cast<double>(wide.angular_velocity),
                  vector_cast<double>(wide.down.normalized()),
                  {double(turned.w), double(turned.x), double(turned.y), double(turned.z)}};
  return scene;
}

}  // namespace gyrostat::heavy
