// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the heavy family; gyrostat/heavy.py wraps it.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/ladder/heavy/motion.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "heavy_arguments.hpp"
#include "question_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/heavy/cvode_motion.hpp"
#endif

template <>
decltype(gyrostat::heavy::Scene::full_equations) gyrostat::python::by_cvode<gyrostat::heavy::Scene>() noexcept {
#ifdef GYROSTAT_HAVE_CVODE
  return &heavy::full_by_cvode;
#else
  return nullptr;
#endif
}

namespace of_heavy {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::heavy;

Data solve_scene(const Array& inertia, double mass, const Array& centre_of_mass, double gravity, double gradient,
                 const std::optional<Array>& angular_velocity, const std::optional<Array>& down,
                 const std::optional<Array>& attitude, const std::optional<std::pair<double, double>>& periodic,
                 const Array& at, double tolerance, const std::string& model, const std::string& integrator,
                 const std::optional<std::shared_ptr<Monitor>>& monitor, const Ask& ask) {
  Question question = question_of(tables, at, tolerance, model, ask);
  const bool cvode = takes_cvode(tables, integrator, question);
  const Start start = heavy_start(angular_velocity, down, attitude, periodic, question);
  if (!start.oriented && !question.asked.empty() && needs_column(question, tables, column::attitude))
    raise("DomainError", "ask: the attitude follows from that of the start alone: give attitude in place of down");
  Scene scene = checked(Scene::make(heavy_body(inertia, mass, centre_of_mass, gravity, gradient), start, question));
  if (cvode) scene.full_equations = by_cvode<Scene>();

  Refusal refusal;
  auto [answer, seconds] = watched(monitor, [&](Monitor* by) { return solve(scene, refusal, by); });
  require_answer(refusal);
  return to_python(answer, scene.question(), tables, seconds);
}

}  // namespace
}  // namespace of_heavy

void bind_heavy(pybind11::module_& module) {
  using namespace of_heavy;
  py::class_<HeavyBodies>(module, "HeavyBodies", "Rows of heavy bodies in principal axes, checked.")
      .def(py::init<const Array&, const Array&, const Array&, const Array&, const Array&>(), py::kw_only(),
           py::arg("inertia"), py::arg("mass"), py::arg("centre_of_mass"), py::arg("gravity"),
           py::arg("gravity_gradient"))
      .def("__len__", [](const HeavyBodies& bodies) { return bodies.size(); });
  module.def("heavy_solve", &solve_scene, py::kw_only(), py::arg("inertia"), py::arg("mass"), py::arg("centre_of_mass"),
             py::arg("gravity"), py::arg("gravity_gradient"), py::arg("angular_velocity"), py::arg("down"),
             py::arg("attitude"), py::arg("periodic"), py::arg("times"), py::arg("tolerance"), py::arg("model"),
             py::arg("integrator"), py::arg("monitor"), py::arg("ask") = py::none(),
             "Answer of the ladder as plain data.");
}
