// SPDX-License-Identifier: BSD-3-Clause
// What the stability report and the reproduction of the published figures need of the deceleration.
#include "gil.hpp"
#include "gyrostat/models/deceleration/published.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "convert.hpp"
#include "gyrostat/models/deceleration/euler_poinsot.hpp"
#include "gyrostat/models/deceleration/stability.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "scene_arguments.hpp"

namespace of_deceleration {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
namespace pub = gyrostat::deceleration::published;
using gyrostat::math::Modulus;

struct Start {
  py::array_t<double> moments, torques;
  std::string regime;
  double modulus_squared;
};

/// Body, torques and start in principal axes. A torque tensor that is not diagonal there acts through its diagonal: the
/// orbit means of M_i M_j vanish.
Start start(const Array& inertia, const Array& control, const Array& angular_momentum) {
  const Inertia<double> J = body(inertia);
  const Vec3<double> b = vector("control", control);
  const Vec3<double> M = vector("angular_momentum", angular_momentum);
  const Mat3<double> in_principal = J.R_BP().transpose() * b.asDiagonal() * J.R_BP();
  const Vec3<double>& m = J.principal();
  if (m[0] == m[1] || m[1] == m[2])
    raise("DomainError", "inertia = " + text(inertia) +
                             ": two moments are equal, so that k2 is 0 on every orbit and the table has no meaning");
  if (M.isZero(0)) raise("DomainError", "angular_momentum = " + text(angular_momentum) + ": the body is at rest");
  const Vec3<double> in_axes = J.R_BP().transpose() * M;
  const auto p = deceleration::polhode_through<double>(J.inverse_principal(), in_axes / in_axes.cwiseAbs().maxCoeff());
  const auto list = [](const Vec3<double>& v) { return array(std::vector<double>{v[0], v[1], v[2]}, {3}); };
  return {list(m), list(in_principal.diagonal()), symbol(p.regime), p.modulus.k2};
}

double balance_at(double modulus_squared) {
  if (!(modulus_squared >= 0 && modulus_squared <= 1))
    raise("DomainError", "modulus_squared = " + text(modulus_squared) + ": not in [0, 1]");
  return deceleration::torque_balance(Modulus<double>::from_k2(modulus_squared));
}

pub::Reading reading(const std::string& symbol) {
  if (symbol == "printed") return pub::Reading::printed;
  if (symbol == "corrected") return pub::Reading::corrected;
  raise("DomainError", "reading = '" + symbol + "': use printed or corrected");
}

pub::Data<double> data(const Array& inertia, const Array& rotor_momentum, const Array& angular_velocity,
                       const Array& control, double drag, double sigma) {
  return {vector("inertia", inertia),
          vector("rotor_momentum", rotor_momentum),
          vector("angular_velocity", angular_velocity),
          vector("control", control),
          drag,
          sigma};
}

struct Run {
  py::array_t<double> t, energy, momentum, modulus_squared;
  bool ended;
};

Run run_published(const pub::Data<double>& d, const std::string& how, double modulus_squared, double end, int samples) {
  if (!(modulus_squared >= 0 && modulus_squared < 1))
    raise("DomainError", "modulus_squared = " + text(modulus_squared) + ": not in [0, 1)");
  if (!(end > 0 && std::isfinite(end))) raise("DomainError", "end = " + text(end) + ": not positive");
  if (samples < 2) raise("DomainError", "samples = " + std::to_string(samples) + ": less than 2");

  const pub::System<double> system(d, reading(how));
  std::array<std::vector<double>, 4> rows;
  const auto push = [&](double t, const std::array<double, 3>& y) {
    rows[0].push_back(t);
    for (std::size_t i = 0; i < 3; ++i) rows[i + 1].push_back(y[i]);
  };
  bool ended = false;
  {
    const Unlocked free;
    // Where the equations end is not known beforehand: once to find it, once to sample up to it.
    ode::RungeKutta scout(system, 0.0, system.start(modulus_squared), ode::StepControl<double, 3>{.relative = 1e-11});
    ended = scout.advance(end) != ode::Status::reached;
    const double last = scout.time();
    ode::RungeKutta solver(system, 0.0, system.start(modulus_squared), ode::StepControl<double, 3>{.relative = 1e-11});
    push(0, solver.state());
    for (int i = 1; i < samples; ++i) {
      const double t = i == samples - 1 ? last : last * i / (samples - 1);
      while (solver.time() < t && solver.step(last) == ode::Status::reached) {
      }
      push(t, solver.at(t));
    }
  }
  const auto made = [&](std::vector<double>& values) { return array(std::move(values), {samples}); };
  return {made(rows[0]), made(rows[1]), made(rows[2]), made(rows[3]), ended};
}

double printed_ratio(double kappa2, double modulus_squared) {
  if (!(modulus_squared > 0 && modulus_squared < 1))
    raise("DomainError", "modulus_squared = " + text(modulus_squared) + ": not in (0, 1)");
  return pub::quasi_stationary_ratio(kappa2, Modulus<double>::from_k2(modulus_squared), pub::Reading::printed);
}

}  // namespace
}  // namespace of_deceleration

void bind_deceleration_published(pybind11::module_& module) {
  using namespace of_deceleration;
  using Data = pub::Data<double>;
  py::class_<Start>(module, "PolhodeStart", "A scene without rotor momentum in principal axes 1, 2, 3, A > B > C.")
      .def_readonly("moments", &Start::moments, "(3,) [kg m2]")
      .def_readonly("torques", &Start::torques, "(3,) about the principal axes [N m]")
      .def_readonly("regime", &Start::regime, "A or C")
      .def_readonly("modulus_squared", &Start::modulus_squared, "k2 at the start");
  module.def("deceleration_polhode_start", &start, py::kw_only(), py::arg("inertia"), py::arg("control"),
             py::arg("angular_momentum"),
             "Regime and k2 of a start; inertia (3,) or (3, 3), control (3,), angular_momentum (3,), body axes.");
  module.def("deceleration_torque_balance", py::vectorize(balance_at), py::arg("modulus_squared"),
             "phi(k2) = kp2 W/(k2 F): falls from 1/2 at k2 = 0 to 0 at k2 = 1.");

  py::class_<Data>(module, "PublishedData", "Data of a figure of the deceleration paper, principal axes, A > B > C.")
      .def(py::init(&data), py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"), py::arg("angular_velocity"),
           py::arg("control"), py::arg("drag"), py::arg("sigma"))
      .def_property_readonly("momentum_unit", &Data::momentum_unit, "|M| at the start [N m s].")
      .def_property_readonly("time_unit", &Data::time_unit, "T of slow time [s].");
  py::class_<Run>(module, "PublishedRun", "A solution of (27), until k2 leaves [0, 1) or |M| vanishes.")
      .def_readonly("t", &Run::t, "t/T")
      .def_readonly("energy", &Run::energy, "H/b3")
      .def_readonly("momentum", &Run::momentum, "|M|/M0")
      .def_readonly("modulus_squared", &Run::modulus_squared, "k2")
      .def_readonly("ended", &Run::ended, "whether the equations ended before the time asked for");
  module.def("published_run", &run_published, py::arg("data"), py::kw_only(), py::arg("reading"),
             py::arg("modulus_squared"), py::arg("end"), py::arg("samples"),
             "The system (27) from (28), printed or corrected.");
  module.def("published_stationary_ratio", py::vectorize(printed_ratio), py::arg("kappa2"), py::arg("modulus_squared"),
             "b1/b3 of (22) as printed, for b2/b3 and k2.");
}
