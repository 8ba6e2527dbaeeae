// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the heavy family; gyrostat/heavy.py wraps it.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/ladder/heavy/solve.hpp"
#include "heavy_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/heavy/cvode_motion.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::heavy;

Model model(const std::string& name) {
  static constexpr const char* names[] = {"auto", "series-2", "series", "exact", "full"};
  for (int i = 0; i < 5; ++i)
    if (name == names[i]) return Model(i);
  raise("DomainError", "model = '" + name + "': use auto, series-2, series, exact or full");
}

void choose_integrator(const std::string& name, Question& question) {
  if (name == "auto" || name == "taylor") return;
#ifdef GYROSTAT_HAVE_CVODE
  if (name == "cvode") {
    question.full_equations = &full_by_cvode;
    return;
  }
#endif
  raise("DomainError", "integrator = '" + name + "': " +
                           (name == "cvode" ? "this build has no CVODE" : "unknown; use auto, taylor or cvode"));
}

/// stable is a truth value.
py::object scalar(const Quantity& quantity) {
  return std::string(quantity.name) == "stable" ? py::object(py::bool_(quantity.values[0] != 0)) : number(quantity);
}

Data solve_scene(const Array& inertia, double mass, const Array& centre_of_mass, double gravity, double gradient,
                 const std::optional<Array>& angular_velocity, const std::optional<Array>& down,
                 const std::optional<Array>& attitude, const std::optional<std::pair<double, double>>& periodic,
                 const Array& at, double tolerance, const std::string& rung, const std::string& method,
                 const std::optional<std::shared_ptr<Monitor>>& monitor) {
  Question question;
  question.times = times(at);
  question.tolerance = relative_tolerance(tolerance);
  question.model = model(rung);
  choose_integrator(method, question);
  if (periodic) question.periodic = Periodic{periodic->first, periodic->second};
  State<double> start;
  set_heavy_start(angular_velocity, down, attitude, start, question);
  const auto scene = Scene::make(heavy_body(inertia, mass, centre_of_mass, gravity, gradient), start, question);
  if (!scene) raise("DomainError", std::string("scene: ") + message(scene.error()));

  Refusal refusal;
  auto [answer, seconds] = timed([&] { return solve(*scene, refusal, monitor ? monitor->get() : nullptr); });
  require_answer(refusal);
  Data made = to_python(answer, seconds, &numbers, &scalar);
  const py::dict scalars = made["scalars"];
  for (const char* name : {"period", "floquet_trace", "stable", "precession_rate"})
    if (!scalars.contains(name)) scalars[name] = py::none();
  return made;
}

}  // namespace

void bind_heavy(py::module_& module) {
  py::class_<HeavyBodies>(module, "HeavyBodies", "Rows of heavy bodies in principal axes, checked.")
      .def(py::init<const Array&, const Array&, const Array&, const Array&, const Array&>(), py::kw_only(),
           py::arg("inertia"), py::arg("mass"), py::arg("centre_of_mass"), py::arg("gravity"),
           py::arg("gravity_gradient"))
      .def("__len__", [](const HeavyBodies& bodies) { return bodies.size(); });
  module.def("heavy_solve", &solve_scene, py::kw_only(), py::arg("inertia"), py::arg("mass"), py::arg("centre_of_mass"),
             py::arg("gravity"), py::arg("gravity_gradient"), py::arg("angular_velocity"), py::arg("down"),
             py::arg("attitude"), py::arg("periodic"), py::arg("times"), py::arg("tolerance"), py::arg("model"),
             py::arg("integrator"), py::arg("monitor"), "Answer of the ladder as plain data.");
}
