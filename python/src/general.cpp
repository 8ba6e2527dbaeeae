// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the general family and its recognition; families/general/functions.py wraps them.
#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "bind.hpp"
#include "caller_torque.hpp"
#include "general_arguments.hpp"
#include "gyrostat/ladder/general/custom_rung.hpp"
#include "gyrostat/ladder/general/segments_rung.hpp"
#include "gyrostat/ladder/general/solve.hpp"
#include "question_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/general/cvode_motion.hpp"
#endif

template <>
decltype(gyrostat::general::Scene::full_equations) gyrostat::python::by_cvode<gyrostat::general::Scene>() noexcept {
#ifdef GYROSTAT_HAVE_CVODE
  return &general::full_by_cvode;
#else
  return nullptr;
#endif
}

namespace of_general {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;

general::Scene scene_of(const Data& given, const Question& question, bool recognise) {
  const auto problem = general_problem(given);
  const auto made = general::Scene::make(problem, question, recognise);
  if (!made) raise_fault(problem, made.error());
  return *made;
}

general::StartError start_error_of(const std::map<std::string, double>& given) {
  const auto of = [&](const char* name) {
    const auto found = given.find(name);
    const double error = found == given.end() ? 0.0 : found->second;
    if (!(error >= 0) || !std::isfinite(error))
      raise("DomainError", std::string("start_error.") + name + ": give a finite number >= 0");
    return error;
  };
  return {of("attitude"), of("angular_velocity"), of("rotor_rate"), of("rotor_angle"), of("velocity"), of("position")};
}

Data solve_scene(const Data& given, const Array& at, double tolerance, const std::string& model,
                 const std::string& integrator, bool recognise, const std::optional<std::shared_ptr<Monitor>>& monitor,
                 const Ask& ask, const std::map<std::string, double>& start_error,
                 const std::optional<EulerAxes>& euler, const py::object& torque,
                 const std::vector<double>& breakpoints) {
  Question question = question_of(general::tables, at, tolerance, model, ask);
  const bool cvode = takes_cvode(general::tables, integrator, question);
  general::Scene scene = scene_of(given, question, recognise).known_within(start_error_of(start_error));
  if (euler) scene = scene.told_by(*euler);
  CallerTorque own(torque, scene.wheels().count, scene.problem().clock);
  scene = scene.driven_by(own.law(breakpoints));
  if (integrator == "dop853") scene.full_equations = &general::full_by_dop853;
  if (cvode) scene.full_equations = by_cvode<general::Scene>();
  gyrostat::Refusal why;
  auto [answer, seconds] = watched(monitor, [&](Monitor* by) { return general::solve(scene, why, by); });
  own.raise_what_ended_it();
  require_answer(why);
  return to_python(answer, scene.question(), general::tables, seconds);
}

/// Name of each family, and why the scene is no instance of it; None where it is one.
py::typing::List<py::typing::Tuple<py::str, py::typing::Optional<py::str>>> recognise_scene(const Data& given,
                                                                                            const Array& at) {
  const general::Scene scene = scene_of(given, question_of(general::tables, at, 1e-6, "auto", std::nullopt), true);
  py::typing::List<py::typing::Tuple<py::str, py::typing::Optional<py::str>>> made;
  for (std::size_t i = 0; i < general::specials; ++i) {
    const char* why = scene.instances().why[i];
    made.append(py::make_tuple(general::special_words[i], why ? py::object(py::str(why)) : py::object(py::none())));
  }
  return made;
}

/// Begin, end and families of each segment that a motion can be answered in, by the scene's own start; none where it cannot.
py::typing::List<py::typing::Tuple<double, double, py::typing::List<py::str>>> segments_of_scene(const Data& given,
                                                                                                 const Array& at) {
  const general::Scene scene = scene_of(given, question_of(general::tables, at, 1e-6, "auto", std::nullopt), true);
  py::typing::List<py::typing::Tuple<double, double, py::typing::List<py::str>>> made;
  if (std::isnan(general::cost_of_segments(scene))) return made;
  const double span = scene.question().times.back();
  for (const auto& segment : general::detail::segments_of(scene.problem(), span)) {
    const auto one = scene.with(segment.problem);
    py::list families;
    for (std::size_t i = 0; one && i < general::specials; ++i)
      if (one->instances().has(general::Special(i))) families.append(general::special_words[i]);
    made.append(py::make_tuple(segment.from, segment.to, families));
  }
  return made;
}

/// The value at t of a table of numbers, as a scene has it.
double table_value(const Data& given, double t) {
  Data holder;
  holder["table"] = given;
  const auto table = python::detail::table_of({"wheel", holder}, "table", 1);
  if (general::check(table, 1) != Errc::ok)
    raise("DomainError", "table: its times must increase, and its numbers be finite");
  return general::piece(table, 1, 0, t)(t);
}

}  // namespace
}  // namespace of_general

void bind_general(pybind11::module_& module) {
  using namespace of_general;
  module.def("general_solve", &solve_scene, py::kw_only(), py::arg("scene"), py::arg("times"), py::arg("tolerance"),
             py::arg("model"), py::arg("integrator"), py::arg("recognise"), py::arg("monitor"),
             py::arg("ask") = py::none(), py::arg("start_error") = std::map<std::string, double>{},
             py::arg("euler") = py::none(), py::arg("torque") = py::none(),
             py::arg("breakpoints") = std::vector<double>{},
             "Answer of the ladder as plain data. torque: a callable, or the address of a compiled function.");
  module.def("general_segments", &segments_of_scene, py::kw_only(), py::arg("scene"), py::arg("times"),
             "Begin, end and families of each segment that the motion can be answered in.");
  module.def("general_table_value", &table_value, py::arg("table"), py::arg("t"),
             "The value at t of a table of numbers: times (n,), values (n, 1), interpolation, extend.");
  module.def("general_recognise", &recognise_scene, py::kw_only(), py::arg("scene"), py::arg("times"),
             "Each family, and why the scene is no instance of it; None where it is one.");
}
