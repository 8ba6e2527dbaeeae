// SPDX-License-Identifier: BSD-3-Clause
// The scene of the C interface: physics by the names of gyrostat.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gyrostat/gyrostat.h"
#include "gyrostat/ladder/general/scene.hpp"
#include "gyrostat/ladder/question.hpp"
#include "gyrostat/models/general/problem.hpp"

/// What has been set of a part of a scene: a bit for the place of each key.
using GivenKeys = std::uint64_t;

struct gyrostat_scene {
  gyrostat::general::Problem<double> problem;
  gyrostat::general::StartError start_error;
  gyrostat_torque torque = nullptr;  // of the caller's own, and what it is handed
  void* torque_data = nullptr;
  std::vector<double> breakpoints;
  gyrostat::Question question;
  bool recognise = true;
  GivenKeys given = 0;                  // but those of wheels and torques
  std::vector<GivenKeys> given_wheels;  // of each
  std::vector<GivenKeys> given_torques;
};

namespace gyrostat::c {

/// What a call came to, and why in words where it was refused.
struct Outcome {
  int code = GYROSTAT_OK;
  std::string why{};
};

Outcome add(gyrostat_scene& scene, const char* what, const char* type);
Outcome set(gyrostat_scene& scene, const char* key, std::span<const double> values);
Outcome set_word(gyrostat_scene& scene, const char* key, const char* word);
Outcome drive(gyrostat_scene& scene, gyrostat_torque torque, void* data, std::span<const double> breakpoints);
Outcome ask(gyrostat_scene& scene, const char* name, double tolerance);

/// Whether all that body, wheels, torques and surroundings need is there; with the question, start and times, too.
Outcome complete(const gyrostat_scene& scene, bool with_question);

/// The problem of a scene: what of the direction along the orbit is radial is dropped, and a wave without a mean has none.
general::Problem<double> problem_of(const gyrostat_scene& scene);

/// Why a problem is refused, in words that name the wheel or torque.
std::string fault_of(const general::Problem<double>& problem, Errc code);

/// "a, b or c"
template <class Names>
std::string one_of(const Names& names) {
  std::string made;
  std::size_t i = 0;
  for (const auto& name : names) {
    made += i == 0 ? "" : i + 1 == std::size(names) ? " or " : ", ";
    made += name;
    ++i;
  }
  return made;
}

}  // namespace gyrostat::c
