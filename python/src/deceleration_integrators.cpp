// SPDX-License-Identifier: BSD-3-Clause
// The full equations under one integrator at one setting, for charts of error against cost.
#include <array>
#include <string>
#include <utility>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/models/deceleration/full.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "scene_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ode/cvode.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::deceleration;
using ode::Status;

/// What an integration hands back, in principal axes.
template <Real Scalar>
struct Run {
  std::vector<Vec3<Scalar>> momentum;
  ode::Counts counts;
  Status status = Status::reached;
};

template <Real Scalar, bool with_control, int Order>
Run<Scalar> by_taylor(const Problem<Scalar>& problem, const std::vector<double>& at, Scalar tolerance) {
  using System = FullSystem<Scalar, with_control, false>;
  using Solver = ode::Taylor<System, Order>;
  const FullCoefficients<Scalar> f(problem);
  const Vec3<Scalar> U = problem.momentum - f.offset;
  typename Solver::Options options;
  options.tolerance = tolerance;
  typename Solver::State state{};
  for (std::size_t i = 0; i < 3; ++i) {
    state[i] = U[Eigen::Index(i)];
    options.scale[i] = problem.momentum.norm();
  }
  Run<Scalar> run;
  run.momentum.reserve(at.size());
  Solver solver(System(problem), 0, state, options);
  alignas(32) Scalar x[Solver::width] = {state[0], state[1], state[2]};
  for (const double t : at) {
    while (solver.time() < t && run.status == Status::reached) run.status = solver.step();
    if (run.status != Status::reached) break;
    if (t > 0) solver.at(t, x);
    run.momentum.push_back(Vec3<Scalar>(x[0], x[1], x[2]) + f.offset);
  }
  run.counts = solver.counts();
  return run;
}

template <Real Scalar, int... orders>
Run<Scalar> by_taylor_of(int order, const Problem<Scalar>& problem, const std::vector<double>& at, Scalar tolerance) {
  Run<Scalar> run;
  const bool control = !problem.control.isZero(0);
  const bool known = ((order == orders && (run = control ? by_taylor<Scalar, true, orders>(problem, at, tolerance)
                                                         : by_taylor<Scalar, false, orders>(problem, at, tolerance),
                                           true)) ||
                      ...);
  if (!known) run.status = Status::not_finite;
  return run;
}

struct RightHandSide {
  Problem<double> problem;
  void operator()(double, const std::array<double, 3>& y, std::array<double, 3>& dydt) const noexcept {
    const Vec3<double> rate = momentum_rate(problem, Vec3<double>(y[0], y[1], y[2]));
    dydt = {rate[0], rate[1], rate[2]};
  }
};

Run<double> by_dop853(const Problem<double>& problem, const std::vector<double>& at, double tolerance) {
  const Vec3<double>& M = problem.momentum;
  ode::StepControl<double, 3> control;
  control.relative = tolerance;
  control.absolute = ode::uniform<double, 3>(tolerance * M.norm());
  control.step_cap = 100'000'000;
  ode::RungeKutta<double, 3, RightHandSide> solver({problem}, 0, {M[0], M[1], M[2]}, control);
  Run<double> run;
  run.momentum.reserve(at.size());
  for (const double t : at) {
    while (solver.time() < t && run.status == Status::reached) run.status = solver.step(at.back());
    if (run.status != Status::reached) break;
    const auto y = t > 0 ? solver.at(t) : solver.state();
    run.momentum.emplace_back(y[0], y[1], y[2]);
  }
  run.counts = solver.counts();
  return run;
}

#ifdef GYROSTAT_HAVE_CVODE
Run<double> by_cvode(const Problem<double>& problem, const std::vector<double>& at, double tolerance,
                     ode::CvodeMethod method) {
  ode::CvodeSystem system;
  system.dimension = 3;
  system.rhs = [](double, const double* y, double* rate, void* user) {
    const Vec3<double> r = momentum_rate(*static_cast<const Problem<double>*>(user), Vec3<double>(y[0], y[1], y[2]));
    for (int i = 0; i < 3; ++i) rate[i] = r[i];
    return r.allFinite();
  };
  system.jacobian = [](double, const double* y, double* columns, void* user) {
    const Mat3<double> J =
        momentum_jacobian(*static_cast<const Problem<double>*>(user), Vec3<double>(y[0], y[1], y[2]));
    for (int i = 0; i < 9; ++i) columns[i] = J(i % 3, i / 3);
    return J.allFinite();
  };
  Problem<double> copy = problem;
  system.user = &copy;
  const Vec3<double>& M = problem.momentum;
  const std::array<double, 3> start{M[0], M[1], M[2]};
  ode::CvodeOptions options;
  options.method = method;
  options.relative = tolerance;
  options.absolute = tolerance * M.norm();
  Run<double> run;
  auto made = ode::Cvode::create(system, 0, start, options);
  if (!made) {
    run.status = Status::not_finite;
    return run;
  }
  ode::Cvode solver = std::move(made).value();
  run.momentum.reserve(at.size());
  std::array<double, 3> y = start;
  for (const double t : at) {
    while (solver.time() < t && run.status == Status::reached) run.status = solver.step(at.back());
    if (run.status != Status::reached) break;
    if (t > 0 && !solver.at(t, y)) run.status = Status::not_finite;
    run.momentum.emplace_back(y[0], y[1], y[2]);
  }
  run.counts = solver.counts();
  return run;
}
#endif

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

/// Runs `work` without the GIL, and hands its result back in body axes.
template <Real Scalar, class Work>
Data in_body_axes(const Inertia<Scalar>& body, std::size_t n, Work&& work) {
  const auto [run, seconds] = timed(std::forward<Work>(work));
  std::vector<double> momentum(3 * n, missing);
  for (std::size_t i = 0; i < run.momentum.size(); ++i) {
    const Vec3<Scalar> M_B = body.R_BP() * run.momentum[i];
    for (int j = 0; j < 3; ++j) momentum[3 * i + std::size_t(j)] = double(M_B[j]);
  }
  Data made;
  made["angular_momentum"] = array(std::move(momentum), {py::ssize_t(n), 3});
  made["seconds"] = seconds;
  made["rhs"] = run.counts.rhs;
  made["steps"] = run.counts.steps;
  made["status"] = symbol(run.status);
  return made;
}

Data integrate(const Array& inertia, const Array& rotor_momentum, const Array& control, double drag,
               const std::string& control_law, const std::string& drag_law, const Array& angular_momentum,
               const Array& at, const std::string& method, int order, double tolerance, const std::string& precision) {
  const std::vector<double> t = times(at);
  require_not_negative("control", control);
  const Law opposed = law("law", control_law), dragged = law("drag_law", drag_law);
  drag_rate(drag);
  if (!(tolerance > 0)) raise("DomainError", "tolerance = " + text(tolerance) + ": give a positive number");
  if (precision == "long double") {
    if (method != "taylor" || order != 30)
      raise("DomainError", "precision = 'long double': only method taylor of order 30 has it");
    const auto made = body<long double>(inertia);
    const auto problem = problem_of(made, rotor_momentum, control, drag, opposed, dragged, angular_momentum);
    return in_body_axes(made, t.size(), [&] {
      return by_taylor_of<long double, 30>(30, problem, t, static_cast<long double>(tolerance));
    });
  }
  if (precision != "double") raise("DomainError", "precision = '" + precision + "': use double or long double");
  const auto made = body<double>(inertia);
  const auto problem = problem_of(made, rotor_momentum, control, drag, opposed, dragged, angular_momentum);
  if (method == "taylor") {
    if (order != 8 && order != 12 && order != 16 && order != 20 && order != 26)
      raise("DomainError", "order = " + std::to_string(order) + ": use 8, 12, 16, 20 or 26");
    return in_body_axes(made, t.size(),
                        [&] { return by_taylor_of<double, 8, 12, 16, 20, 26>(order, problem, t, tolerance); });
  }
  if (method == "dop853") return in_body_axes(made, t.size(), [&] { return by_dop853(problem, t, tolerance); });
#ifdef GYROSTAT_HAVE_CVODE
  if (method == "cvode-adams" || method == "cvode-bdf") {
    const auto kind = method == "cvode-bdf" ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams;
    return in_body_axes(made, t.size(), [&] { return by_cvode(problem, t, tolerance, kind); });
  }
#endif
  raise("DomainError", "method = '" + method + "': unknown, or not in this build");
}

}  // namespace

void bind_deceleration_integrators(py::module_& module) {
  module.def("deceleration_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("control"), py::arg("drag"), py::arg("law"), py::arg("drag_law"), py::arg("angular_momentum"),
             py::arg("times"), py::arg("method"), py::arg("order") = 20, py::arg("tolerance"),
             py::arg("precision") = "double", "The full equations under one integrator, timed.");
}
