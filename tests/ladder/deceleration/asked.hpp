// SPDX-License-Identifier: BSD-3-Clause
// A setup and what is asked of it in one, as tests set them.
#pragma once

#include <vector>

#include "gyrostat/ladder/deceleration/track.hpp"

namespace gyrostat::deceleration {

struct Asked : Setup, Question {
  Track (*full_equations)(const Scene&, Monitor*) = nullptr;
};

/// Every column but the attitude, and the stop time where it is known.
inline std::vector<AskedQuantity> all_but_attitude() {
  std::vector<AskedQuantity> all{{scalar::stop_time, true, gyrostat::nan<double>, false, false}};
  for (std::size_t i = 0; i < std::size(column_kinds); ++i)
    if (i != column::attitude) all.push_back({i});
  return all;
}

inline Result<Scene> make_scene(const Inertia<double>& body, const Asked& asked) {
  auto scene = Scene::make(body, asked, asked);
  if (!scene) return scene;
  Scene made = *scene;
  made.full_equations = asked.full_equations;
  return made;
}

}  // namespace gyrostat::deceleration
