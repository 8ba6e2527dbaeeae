// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the rotor family; gyrostat/rotor.py wraps it.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/ladder/rotor/solve.hpp"
#include "gyrostat/models/rotor/assembly.hpp"
#include "rotor_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/rotor/cvode_motion.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::rotor;

Model model(const std::string& name) {
  static constexpr const char* names[] = {"auto", "closed-form", "linear-tail", "full"};
  for (int i = 0; i < 4; ++i)
    if (name == names[i]) return Model(i);
  raise("DomainError", "model = '" + name + "': use auto, closed-form, linear-tail or full");
}

void choose_integrator(const std::string& name, SceneData& data) {
  if (name == "auto") data.integrator = Integrator::any;
  else if (name == "taylor") data.integrator = Integrator::taylor;
  else if (name == "radau") data.integrator = Integrator::radau;
#ifdef GYROSTAT_HAVE_CVODE
  else if (name == "cvode") data.full_equations = &full_by_cvode;
#endif
  else
    raise("DomainError",
          "integrator = '" + name +
              "': " + (name == "cvode" ? "this build has no CVODE" : "unknown; use auto, taylor, radau or cvode"));
}

/// The attractor is a place in the list of steady rotations; None where none is certified.
py::object value_of(const Quantity& quantity) {
  if (quantity.name != std::string_view("attractor")) return number(quantity);
  if (std::isnan(quantity.values[0])) return py::none();
  return py::int_(int(quantity.values[0]));
}

Data solve_scene(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
                 const Array& angular_velocity, double rotor_rate, const Array& attitude, const Array& at,
                 double tolerance, const std::string& rung, const std::string& method,
                 const std::optional<std::shared_ptr<Monitor>>& monitor) {
  const Gyrostat<double> gyrostat = gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate);
  SceneData data;
  data.angular_velocity = vector("angular_velocity", angular_velocity);
  data.rotor_rate = finite("rotor_rate", rotor_rate);
  data.attitude = quaternion("attitude", attitude);
  data.times = times(at);
  data.tolerance = relative_tolerance(tolerance);
  data.model = model(rung);
  choose_integrator(method, data);
  const auto scene = Scene::make(gyrostat, data);
  if (!scene) raise("DomainError", std::string("scene: ") + message(scene.error()));

  Refusal refusal;
  auto [answer, seconds] = timed([&] { return solve(*scene, refusal, monitor ? monitor->get() : nullptr); });
  require_answer(refusal);
  return to_python(answer, seconds, &numbers, &value_of);
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

void bind_rotor(py::module_& module) {
  module.def("rotor_solve", &solve_scene, py::kw_only(), py::arg("inertia"), py::arg("axis"), py::arg("axial_inertia"),
             py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"), py::arg("rotor_rate"),
             py::arg("attitude"), py::arg("times"), py::arg("tolerance"), py::arg("model"), py::arg("integrator"),
             py::arg("monitor"), "Answer of the ladder as plain data.");
  module.def("rotor_assembly", &assembled, py::kw_only(), py::arg("carrier_inertia"), py::arg("carrier_mass"),
             py::arg("rotor_mass"), py::arg("axis"), py::arg("axial_inertia"), py::arg("equatorial_inertia"),
             py::arg("offset"), "(3, 3): inertia of the whole about the common mass centre.");
}
