// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a scene, from Python arguments: the same for every family.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/family.hpp"
#include "gyrostat/ladder/question.hpp"
#include "scene_arguments.hpp"

namespace gyrostat::python {

/// "a, b or c"
inline std::string one_of(const std::vector<std::string>& names) {
  std::string made;
  for (std::size_t i = 0; i < names.size(); ++i)
    made += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return made;
}

/// Place of a rung by name; any_rung for auto.
inline int rung_named(const Family& family, const std::string& name) {
  if (name == "auto") return any_rung;
  if (const int place = place_of(family.rungs, name); place >= 0) return place;
  std::vector<std::string> names{"auto"};
  for (const RungKind& rung : family.rungs) names.emplace_back(rung.name);
  raise("DomainError", "model = '" + name + "': use " + one_of(names));
}

/// Whether CVODE is asked for; else sets which of the library's own integrators is.
inline bool takes_cvode(const Family& family, const std::string& name, Question& question) {
  std::vector<std::string> names{"auto"};
  names.insert(names.end(), family.integrators.begin(), family.integrators.end());
  if (std::find(names.begin(), names.end(), name) == names.end())
    raise("DomainError", "integrator = '" + name + "': unknown; use " + one_of(names));
#ifndef GYROSTAT_HAVE_CVODE
  if (name == "cvode") raise("DomainError", "integrator = 'cvode': this build has no CVODE");
#endif
  question.integrator = name == "taylor" ? Integrator::taylor : name == "radau" ? Integrator::radau : Integrator::any;
  return name == "cvode";
}

/// What solves the full equations by CVODE; nullptr where the build has none. Each family has its own, beside its solve_scene.
template <class Scene>
decltype(Scene::full_equations) by_cvode() noexcept;

/// What is asked for: name, tolerance (NaN: that of the question), whether it is in the unit, whether a value has to be there. None: the
/// default of the family.
using Ask = std::optional<std::vector<std::tuple<std::string, double, bool, bool>>>;

inline std::vector<AskedQuantity> asked_of(const Family& family, const Ask& ask) {
  std::vector<AskedQuantity> made;
  if (!ask) return made;
  for (const auto& [name, tolerance, absolute, needed] : *ask) {
    const int column = place_of(family.columns, name), scalar = place_of(family.scalars, name);
    if (column < 0 && scalar < 0) raise("DomainError", "ask: there is no column or scalar " + name);
    if (tolerance <= 0 || tolerance == infinity<double>)
      raise("DomainError", "ask: " + name + " = " + text(tolerance) + ": give a finite tolerance > 0");
    made.push_back({std::size_t(column < 0 ? scalar : column), column < 0, tolerance, absolute, needed});
  }
  if (made.empty()) raise("DomainError", "ask: nothing is asked for; name a column or scalar, or leave it out");
  return made;
}

inline Question question_of(const Family& family, const Array& at, double tolerance, const std::string& model,
                            const Ask& ask) {
  Question question;
  question.asked = asked_of(family, ask);
  question.times = times(at);
  question.tolerance = relative_tolerance(tolerance);
  question.rung = rung_named(family, model);
  return question;
}

/// A scene that was made, or what is wrong with it.
template <class Scene>
const Scene& checked(const Result<Scene>& made) {
  if (!made) raise("DomainError", std::string("scene: ") + message(made.error()));
  return *made;
}

}  // namespace gyrostat::python
