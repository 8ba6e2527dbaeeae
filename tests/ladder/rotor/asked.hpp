// SPDX-License-Identifier: BSD-3-Clause
// A start and what is asked of it in one, as tests set them.
#pragma once

#include "gyrostat/ladder/rotor/track.hpp"

namespace gyrostat::rotor {

struct Asked : Start, Question {
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;
};

inline Result<Scene> make_scene(const Gyrostat<double>& body, const Asked& asked) {
  auto scene = Scene::make(body, asked, asked);
  if (!scene) return scene;
  Scene made = *scene;
  made.full_equations = asked.full_equations;
  return made;
}

/// Nothing but nine times over the span.
inline Asked asked(double span, double tolerance) {
  Asked data;
  for (int i = 0; i <= 8; ++i) data.times.push_back(span * i / 8);
  data.tolerance = tolerance;
  return data;
}

/// Makes it start with momentum H and rotor rate omega.
inline void start(Asked& data, const Gyrostat<double>& body, const Vec3<double>& H, double omega) {
  data.angular_velocity = body.inverse_inertia() * (H - body.axial_inertia() * omega * body.axis());
  data.rotor_rate = omega;
}

}  // namespace gyrostat::rotor
