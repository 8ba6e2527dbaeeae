// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the rotor family; gyrostat/rotor.py wraps it.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/ladder/rotor/motion.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/assembly.hpp"
#include "question_arguments.hpp"
#include "rotor_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/rotor/cvode_motion.hpp"
#endif

template <>
decltype(gyrostat::rotor::Scene::full_equations) gyrostat::python::by_cvode<gyrostat::rotor::Scene>() noexcept {
#ifdef GYROSTAT_HAVE_CVODE
  return &rotor::full_by_cvode;
#else
  return nullptr;
#endif
}

namespace of_rotor {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::rotor;

Data solve_scene(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
                 const Array& angular_velocity, double rotor_rate, const Array& attitude, const Array& at,
                 double tolerance, const std::string& model, const std::string& integrator,
                 const std::optional<std::shared_ptr<Monitor>>& monitor, const Ask& ask) {
  const Gyrostat<double> gyrostat = gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate);
  const Start start{quaternion("attitude", attitude), vector("angular_velocity", angular_velocity),
                    finite("rotor_rate", rotor_rate)};
  Question question = question_of(tables, at, tolerance, model, ask);
  const bool cvode = takes_cvode(tables, integrator, question);
  Scene scene = checked(Scene::make(gyrostat, start, question));
  if (cvode) scene.full_equations = by_cvode<Scene>();

  Refusal refusal;
  auto [answer, seconds] = watched(monitor, [&](Monitor* by) { return solve(scene, refusal, by); });
  require_answer(refusal);
  return to_python(answer, scene.question(), tables, seconds);
}

/// theta (3, 3) of carrier and rotor given apart.
py::array_t<double> assembled(const Array& carrier_inertia, double carrier_mass, double rotor_mass, const Array& axis,
                              double axial_inertia, double equatorial_inertia, const Array& offset) {
  Assembly<double> parts;
  parts.carrier_inertia = body(carrier_inertia, "carrier_inertia").tensor();
  parts.carrier_mass = positive("carrier_mass", carrier_mass);
  parts.rotor_mass = positive("rotor_mass", rotor_mass);
  parts.axis = unit_vector("axis", axis);
  parts.axial_inertia = positive("axial_inertia", axial_inertia);
  parts.equatorial_inertia = positive("equatorial_inertia", equatorial_inertia);
  parts.offset = vector("offset", offset);
  const auto theta = parts.inertia();
  if (!theta)
    raise("DomainError", "axial_inertia = " + text(axial_inertia) + ": more than twice equatorial_inertia = " +
                             text(equatorial_inertia) + "; no rotor has that");
  std::vector<double> values(9);
  for (int i = 0; i < 9; ++i) values[std::size_t(i)] = (*theta)(i / 3, i % 3);
  return array(std::move(values), {3, 3});
}

}  // namespace
}  // namespace of_rotor

void bind_rotor(pybind11::module_& module) {
  using namespace of_rotor;
  module.def("rotor_solve", &solve_scene, py::kw_only(), py::arg("inertia"), py::arg("axis"), py::arg("axial_inertia"),
             py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"), py::arg("rotor_rate"),
             py::arg("attitude"), py::arg("times"), py::arg("tolerance"), py::arg("model"), py::arg("integrator"),
             py::arg("monitor"), py::arg("ask") = py::none(), "Answer of the ladder as plain data.");
  module.def("rotor_assembly", &assembled, py::kw_only(), py::arg("carrier_inertia"), py::arg("carrier_mass"),
             py::arg("rotor_mass"), py::arg("axis"), py::arg("axial_inertia"), py::arg("equatorial_inertia"),
             py::arg("offset"), "(3, 3): inertia of the whole about the common mass centre.");
}
