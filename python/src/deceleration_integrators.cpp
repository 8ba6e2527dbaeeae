// SPDX-License-Identifier: BSD-3-Clause
// The full equations of deceleration under one integrator at one setting.
#include "bind.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "integrators.hpp"
#include "scene_arguments.hpp"

// the library has them
extern template class gyrostat::ode::Taylor<gyrostat::deceleration::FullSystem<double, true, false>>;
extern template class gyrostat::ode::Taylor<gyrostat::deceleration::FullSystem<double, false, false>>;

namespace of_deceleration {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::deceleration;

/// The Taylor series are in U = M - offset. A state is M, principal axes, N m s.
template <Real Scalar_, bool with_control>
struct Motion {
  using Scalar = Scalar_;
  using System = FullSystem<Scalar, with_control, false>;
  using Numbers = std::array<Scalar, System::width>;

  const Problem<Scalar>& problem;
  Vec3<Scalar> offset = FullCoefficients<Scalar>(problem).offset;

  System system() const { return System(problem); }
  const Vec3<Scalar>& start() const { return problem.momentum; }
  Numbers numbers() const {
    const Vec3<Scalar> U = problem.momentum - offset;
    return {U[0], U[1], U[2], 0};
  }
  Numbers scale(Scalar) const {
    const Scalar size = problem.momentum.norm();
    return {size, size, size, 0};
  }
  Vec3<Scalar> state(Scalar, const Scalar* x) const { return Vec3<Scalar>(x[0], x[1], x[2]) + offset; }
};

/// M over the size that it has at the start.
struct Plain {
  static constexpr std::size_t width = 3;
  using Numbers = std::array<double, width>;

  const Problem<double>& problem;
  double unit = problem.momentum.norm() > 0 ? problem.momentum.norm() : 1;

  const Vec3<double>& start() const { return problem.momentum; }
  Numbers numbers() const { return numbers(problem.momentum); }
  Numbers numbers(const Vec3<double>& M) const { return {M[0] / unit, M[1] / unit, M[2] / unit}; }
  Numbers absolute(double tolerance) const { return ode::uniform<double, width>(tolerance); }
  Vec3<double> state(double, const double* y) const { return unit * Vec3<double>(y[0], y[1], y[2]); }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    rate = numbers(momentum_rate(problem, state(0, y.data())));
  }
  void jacobian(const double* y, double* columns) const {
    const Mat3<double> J = momentum_jacobian(problem, state(0, y));
    std::copy_n(J.data(), 9, columns);
  }
};

template <Real Scalar>
Problem<Scalar> problem_of(const Inertia<Scalar>& body, const Array& rotor_momentum, const Array& control, double drag,
                           Law law, Law drag_law, const Array& momentum) {
  const Mat3<Scalar> R_PB = body.R_BP().transpose();
  Problem<Scalar> problem;
  problem.inverse_inertia = body.inverse_principal();
  problem.rotor_momentum = R_PB * vector("rotor_momentum", rotor_momentum).template cast<Scalar>();
  problem.control = R_PB * vector("control", control).template cast<Scalar>().asDiagonal() * body.R_BP();
  problem.drag = Scalar(drag);
  problem.law = law;
  problem.drag_law = drag_law;
  problem.momentum = R_PB * vector("angular_momentum", momentum).template cast<Scalar>();
  return problem;
}

Data integrate(const Array& inertia, const Array& rotor_momentum, const Array& control, double drag,
               const std::string& control_law, const std::string& drag_law, const Array& angular_momentum,
               const Array& at, const std::string& method, int order, double tolerance, const std::string& precision,
               double patience) {
  const Task task = task_of(times(at), method, order, tolerance, precision, patience);
  require_not_negative("control", control);
  const Law opposed = law("law", control_law), dragged = law("drag_law", drag_law);
  drag_rate(drag);
  Table table(task.times.size(), {{"angular_momentum", 3}});
  const auto run = [&]<Real Scalar>(Scalar) {
    const auto made = body<Scalar>(inertia);
    const auto problem = problem_of(made, rotor_momentum, control, drag, opposed, dragged, angular_momentum);
    const auto put = [&](std::size_t i, const Vec3<Scalar>& M) { table.put(0, i, Vec3<Scalar>(made.R_BP() * M)); };
    const auto [course, seconds] = timed([&] {
      const Motion<Scalar, true> driven{problem};
      const Motion<Scalar, false> free{problem};
      const bool control_acts = !problem.control.isZero(0);
      if constexpr (std::is_same_v<Scalar, double>)
        return control_acts ? by_name(driven, Plain{problem}, task, put) : by_name(free, Plain{problem}, task, put);
      else return control_acts ? by_taylor<long_order>(driven, task, put) : by_taylor<long_order>(free, task, put);
    });
    return std::move(table).data(course, seconds);
  };
  return task.long_double ? run(0.0L) : run(0.0);
}

}  // namespace
}  // namespace of_deceleration

void bind_deceleration_integrators(pybind11::module_& module) {
  using namespace of_deceleration;
  module.def("deceleration_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("control"), py::arg("drag"), py::arg("law"), py::arg("drag_law"), py::arg("angular_momentum"),
             py::arg("times"), py::arg("method"), py::arg("order") = 20, py::arg("tolerance"),
             py::arg("precision") = "double", py::arg("patience") = infinity<double>,
             "The full equations under one integrator, timed.");
}
