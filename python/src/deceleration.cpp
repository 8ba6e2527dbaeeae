// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the deceleration family, and its functions over arrays; gyrostat/deceleration.py wraps them.
#include "gil.hpp"
#include "gyrostat/ladder/deceleration/solve.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "answer.hpp"
#include "bind.hpp"
#include "elliptic_backend.hpp"
#include "gyrostat/ladder/deceleration/motion.hpp"
#include "gyrostat/models/deceleration/stability.hpp"
#include "question_arguments.hpp"
#include "scene_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/deceleration/cvode_motion.hpp"
#endif

template <>
decltype(gyrostat::deceleration::Scene::full_equations)
gyrostat::python::by_cvode<gyrostat::deceleration::Scene>() noexcept {
#ifdef GYROSTAT_HAVE_CVODE
  return &deceleration::full_by_cvode;
#else
  return nullptr;
#endif
}

namespace of_deceleration {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::deceleration;

Data solve_scene(const Array& inertia, const Array& rotor_momentum, const Array& control, double drag,
                 const std::string& control_law, const std::string& drag_law, const Array& angular_momentum,
                 const std::optional<Array>& attitude, const Array& at, double tolerance, const std::string& rung,
                 const std::string& integrator, const std::string& elliptic,
                 const std::optional<std::shared_ptr<Monitor>>& monitor, const std::optional<Array>& angular_velocity,
                 const Ask& ask) {
  Setup setup;
  setup.rotor_momentum = vector("rotor_momentum", rotor_momentum);
  setup.control = vector("control", control);
  require_not_negative("control", control);
  setup.drag = drag_rate(drag);
  setup.law = law("law", control_law);
  setup.drag_law = law("drag_law", drag_law);
  setup.momentum = vector("angular_momentum", angular_momentum);
  if (angular_velocity) setup.angular_velocity = vector("angular_velocity", *angular_velocity);
  if (attitude) setup.attitude = quaternion("attitude", *attitude);
  Question question = question_of(tables, at, tolerance, rung, ask);
  question.wants_attitude = attitude.has_value();
  const bool cvode = takes_cvode(tables, integrator, question);
  const EllipticBackend& functions = elliptic_backend(elliptic);
  const auto made = Scene::make(body(inertia), setup, question);
  if (!made && made.error() == Errc::out_of_domain)
    raise("DomainError", "angular_momentum: it is not J omega + l of angular_velocity: give one of the two");
  Scene scene = checked(made);
  if (cvode) scene.full_equations = by_cvode<Scene>();

  Refusal refusal;
  auto [answer, seconds] = watched(monitor, [&](Monitor* by) { return functions.decelerate(scene, refusal, by); });
  require_answer(refusal);
  return to_python(answer, scene.question(), tables, seconds);
}

/// The rung `averaged` for many bodies: rows of inertia, rotor_momentum, control, momentum (n, 3) and drag (n).
Data averaged_rows(const Array& inertia, const Array& rotor_momentum, const Array& control, const Array& drag,
                   const Array& momentum, const std::string& control_law, const std::string& drag_law, const Array& at,
                   double tolerance, const std::string& elliptic) {
  const py::ssize_t rows = drag.size();
  const EllipticBackend& functions = elliptic_backend(elliptic);
  Setup setup;
  setup.law = law("law", control_law);
  setup.drag_law = law("drag_law", drag_law);
  Question question;
  question.times = times(at);
  question.tolerance = tolerance;
  question.rung = rung::averaged;
  const std::size_t n = question.times.size();
  std::vector<double> norm(std::size_t(rows) * n), energy(norm.size()), k2(norm.size()), regime(norm.size());
  std::vector<double> errors(std::size_t(rows) * 3), stop(static_cast<std::size_t>(rows));
  for (py::ssize_t row = 0; row < rows; ++row) {
    const auto row_text = [&](const std::string& what) { return "row " + std::to_string(row) + ": " + what; };
    const auto v = [&](const Array& a) {
      return Vec3<double>(a.data()[3 * row], a.data()[3 * row + 1], a.data()[3 * row + 2]);
    };
    const Vec3<double> J = v(inertia);
    const auto body = Inertia<double>::from_moments(J[0], J[1], J[2]);
    if (!body)
      raise("DomainError", row_text("inertia = [" + text(J[0]) + ", " + text(J[1]) + ", " + text(J[2]) +
                                    "]: " + message(body.error())));
    setup.rotor_momentum = v(rotor_momentum);
    setup.control = v(control);
    setup.drag = drag.data()[row];
    setup.momentum = v(momentum);
    const auto scene = Scene::make(*body, setup, question);
    if (!scene) raise("DomainError", row_text(message(scene.error())));
    Refusal refusal;
    Answer answer;
    {
      const Unlocked free;
      answer = functions.decelerate(*scene, refusal, nullptr);
    }
    if (refusal.code != Errc::ok) raise(refusal.code, row_text(refusal.why));
    const auto take = [&](std::size_t which, std::vector<double>& into, int place) {
      const Column* column = answer.find(column_kinds[which].name);
      for (std::size_t i = 0; i < n; ++i) into[std::size_t(row) * n + i] = column ? column->values[i] : missing;
      if (place >= 0) errors[std::size_t(3 * row + place)] = column ? column->error : missing;
    };
    take(column::angular_momentum_norm, norm, 0);
    take(column::energy, energy, 1);
    take(column::modulus_squared, k2, 2);
    take(column::regime, regime, -1);
    const Quantity* stop_time = answer.quantity(scalar_kinds[scalar::stop_time].name);
    stop[std::size_t(row)] = stop_time ? stop_time->values[0] : missing;
  }
  const auto width = py::ssize_t(n);
  Data made;
  made["momentum_norm"] = array(std::move(norm), {rows, width});
  made["energy"] = array(std::move(energy), {rows, width});
  made["modulus_squared"] = array(std::move(k2), {rows, width});
  made["regime"] = array(std::move(regime), {rows, width});
  made["error"] = array(std::move(errors), {rows, 3});
  made["stop_time"] = array(std::move(stop), {rows});
  return made;
}

/// Rows of control torques about the principal axes (n, 3): region, tendencies of axis, interior and separatrix, k2, kp2.
py::array_t<double> stability_rows(const Array& control, const std::string& regime) {
  require_shape("control", control, {-1, 3});
  if (regime != "A" && regime != "C") raise("DomainError", "regime = '" + regime + "': use A or C");
  const Regime about = regime == "A" ? Regime::about_largest : Regime::about_smallest;
  const py::ssize_t rows = control.shape(0);
  std::vector<double> out(std::size_t(rows) * 6);
  py::ssize_t bad = -1;
  Errc why = Errc::ok;
  {
    const Unlocked free;
    for (py::ssize_t row = 0; row < rows && bad < 0; ++row) {
      const double* b = control.data() + 3 * row;
      const auto table = regime_stability(Vec3<double>(b[0], b[1], b[2]), about);
      if (!table) {
        bad = row;
        why = table.error();
        break;
      }
      const double values[] = {double(table->region),     double(table->axis),        double(table->interior),
                               double(table->separatrix), table->quasi_stationary.k2, table->quasi_stationary.kp2};
      std::copy(values, values + 6, &out[std::size_t(row) * 6]);
    }
  }
  if (bad >= 0) raise("DomainError", "control, row " + std::to_string(bad) + ": " + message(why));
  return array(std::move(out), {rows, 6});
}

py::typing::List<py::str> regime_symbols() {
  py::typing::List<py::str> names;
  for (const char* word : regime_words) names.append(word);
  return names;
}

}  // namespace
}  // namespace of_deceleration

void bind_deceleration(pybind11::module_& module) {
  using namespace of_deceleration;
  module.def("deceleration_solve", &solve_scene, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("control"), py::arg("drag"), py::arg("law"), py::arg("drag_law"), py::arg("angular_momentum"),
             py::arg("attitude"), py::arg("times"), py::arg("tolerance"), py::arg("model"), py::arg("integrator"),
             py::arg("elliptic"), py::arg("monitor"), py::arg("angular_velocity") = py::none(),
             py::arg("ask") = py::none(), "Answer of the ladder as plain data.");
  module.def("deceleration_averaged", &averaged_rows, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("control"), py::arg("drag"), py::arg("angular_momentum"), py::arg("law"), py::arg("drag_law"),
             py::arg("times"), py::arg("tolerance"), py::arg("elliptic"), "The rung averaged over rows of bodies.");
  module.def("deceleration_stability", &stability_rows, py::arg("control"), py::arg("regime"),
             "(n, 6): region, tendency of the axis, of k*2 and of the separatrix, k*2, 1 - k*2.");
  module.def("deceleration_regimes", &regime_symbols, "Symbols of the regimes, in the order of their numbers.");
}
