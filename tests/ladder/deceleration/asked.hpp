// SPDX-License-Identifier: BSD-3-Clause
// A setup and what is asked of it in one, as tests set them.
#pragma once

#include "gyrostat/ladder/deceleration/track.hpp"

namespace gyrostat::deceleration {

struct Asked : Setup, Question {
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;
};

inline Result<Scene> make_scene(const Inertia<double>& body, const Asked& asked) {
  auto scene = Scene::make(body, asked, asked);
  if (!scene) return scene;
  Scene made = *scene;
  made.full_equations = asked.full_equations;
  return made;
}

}  // namespace gyrostat::deceleration
