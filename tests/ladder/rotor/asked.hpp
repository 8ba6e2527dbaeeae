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

}  // namespace gyrostat::rotor
