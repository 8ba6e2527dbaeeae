// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a driven rotor under one integrator at one setting, for charts of error against cost.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/relaxing.hpp"
#include "gyrostat/ode/radau.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "rotor_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ode/cvode.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::rotor;
using ode::Status;

/// What an integration hands back, in body axes.
template <Real Scalar>
struct Run {
  std::vector<State<Scalar>> states;
  ode::Counts counts;
  Status status = Status::reached;
};

/// Steps through the times; `state_at(t)` is the state at one inside the last step.
template <Real Scalar, class Solver, class StateAt>
Run<Scalar> along(Solver& solver, const State<Scalar>& start, const std::vector<double>& at, StateAt&& state_at) {
  Run<Scalar> run;
  run.states.reserve(at.size());
  for (const double t : at) {
    while (solver.time() < Scalar(t) && run.status == Status::reached) run.status = solver.step(Scalar(at.back()));
    if (run.status != Status::reached) break;
    run.states.push_back(t > 0 ? state_at(Scalar(t)) : start);
  }
  run.counts = solver.counts();
  return run;
}

template <Real Scalar, int Order>
Run<Scalar> by_taylor(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, const std::vector<double>& at,
                      Scalar tolerance) {
  using Solver = ode::Taylor<FullSystem<Scalar>, Order>;
  const FullSystem<Scalar> system(gyrostat, start);
  typename Solver::Options options;
  options.tolerance = tolerance;
  options.scale = system.scale();
  Solver solver(system, 0, system.start(), options);
  return along(solver, start, at, [&](Scalar t) {
    alignas(32) Scalar x[Solver::width];
    solver.at(t, x);
    return system.state(t, x);
  });
}

template <int... orders>
Run<double> by_taylor_of(int order, const Gyrostat<double>& gyrostat, const State<double>& start,
                         const std::vector<double>& at, double tolerance) {
  Run<double> run;
  (void)((order == orders && (run = by_taylor<double, orders>(gyrostat, start, at, tolerance), true)) || ...);
  return run;
}

template <Real Scalar>
Run<Scalar> by_radau(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, const std::vector<double>& at,
                     Scalar tolerance) {
  using System = RelaxingRotor<Scalar>;
  using Solver = ode::Radau<System>;
  const System system(gyrostat, start);
  typename Solver::Options options;
  options.tolerance = tolerance;
  options.scale = System::scale(gyrostat, start);
  Solver solver(system, 0, system.components(start), options);
  return along(solver, start, at, [&](Scalar t) {
    alignas(32) Scalar x[Solver::width + 1];
    solver.at(t, x);
    return system.state(x);
  });
}

/// The state as nine numbers of the size of 1: attitude, momenta over `size`, rotor angle. For integrators that know no model.
struct Numbers {
  Gyrostat<double> gyrostat;
  double size;

  Numbers(const Gyrostat<double>& body, const State<double>& start)
      : gyrostat(body),
        size(start.momentum.norm() + std::abs(body.target_momentum()) + std::abs(start.axial_momentum)) {
    if (!(size > 0)) size = 1;
  }

  std::array<double, 9> numbers(const State<double>& s) const noexcept {
    const auto& [q, H, p, angle] = s;
    return {q.w, q.x, q.y, q.z, H[0] / size, H[1] / size, H[2] / size, p / size, angle};
  }
  State<double> state(const double* y) const noexcept {
    return {{y[0], y[1], y[2], y[3]}, size * Vec3<double>(y[4], y[5], y[6]), size * y[7], y[8]};
  }
  State<double> unit_state(const double* y) const noexcept {
    State<double> made = state(y);
    made.attitude = normalised(made.attitude);
    return made;
  }

  void operator()(double, const std::array<double, 9>& y, std::array<double, 9>& rate) const noexcept {
    rate = numbers(state_rate(gyrostat, state(y.data())));
  }
};

Run<double> by_dop853(const Gyrostat<double>& gyrostat, const State<double>& start, const std::vector<double>& at,
                      double tolerance) {
  const Numbers system(gyrostat, start);
  ode::StepControl<double, 9> control;
  control.relative = tolerance;
  control.absolute = ode::uniform<double, 9>(tolerance);
  control.absolute[8] = infinity<double>;  // a quadrature: it needs no control of its own
  control.step_cap = 100'000'000;
  ode::RungeKutta<double, 9, Numbers> solver(system, 0, system.numbers(start), control);
  return along(solver, start, at, [&](double t) { return system.unit_state(solver.at(t).data()); });
}

#ifdef GYROSTAT_HAVE_CVODE
Run<double> by_cvode(const Gyrostat<double>& gyrostat, const State<double>& start, const std::vector<double>& at,
                     double tolerance, ode::CvodeMethod method) {
  Numbers numbers(gyrostat, start);
  ode::CvodeSystem system;
  system.dimension = 9;
  system.user = &numbers;
  system.rhs = [](double, const double* y, double* rate, void* user) {
    const auto& self = *static_cast<const Numbers*>(user);
    const auto made = self.numbers(state_rate(self.gyrostat, self.state(y)));
    std::copy(made.begin(), made.end(), rate);
    return std::all_of(made.begin(), made.end(), [](double x) { return std::isfinite(x); });
  };
  system.jacobian = [](double, const double* y, double* columns, void* user) {
    const auto& self = *static_cast<const Numbers*>(user);
    Eigen::Matrix<double, 9, 9> J = state_jacobian(self.gyrostat, self.state(y));
    J.middleRows<4>(4) /= self.size;
    J.middleCols<4>(4) *= self.size;
    std::copy(J.data(), J.data() + 81, columns);
    return J.allFinite();
  };
  ode::CvodeOptions options;
  options.method = method;
  options.relative = options.absolute = tolerance;
  auto made = ode::Cvode::create(system, 0, numbers.numbers(start), options);
  if (!made) {
    Run<double> failed;
    failed.status = Status::not_finite;
    return failed;
  }
  ode::Cvode solver = std::move(made).value();
  return along(solver, start, at, [&](double t) {
    std::array<double, 9> y{};
    solver.at(t, y);
    return numbers.unit_state(y.data());
  });
}
#endif

/// Runs `work` without the GIL, and hands its result back as columns.
template <Real Scalar, class Work>
Data columns_of(const Gyrostat<Scalar>& gyrostat, std::size_t n, Work&& work) {
  const auto [run, seconds] = timed(std::forward<Work>(work));
  std::vector<double> attitude(4 * n, missing), velocity(3 * n, missing), momentum(3 * n, missing), rate(n, missing),
      angle(n, missing), lyapunov(n, missing);
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const auto& [q, H, p, beta] = run.states[i];
    const Vec3<Scalar> Omega = gyrostat.angular_velocity(H, p);
    const Scalar turned[] = {q.x, q.y, q.z, q.w};
    for (std::size_t j = 0; j < 4; ++j) attitude[4 * i + j] = double(turned[j]);
    for (std::size_t j = 0; j < 3; ++j) {
      velocity[3 * i + j] = double(Omega[Eigen::Index(j)]);
      momentum[3 * i + j] = double(H[Eigen::Index(j)]);
    }
    rate[i] = double(gyrostat.rotor_rate(p, Omega));
    angle[i] = double(beta);
    lyapunov[i] = double(gyrostat.lyapunov(H, p));
  }
  const auto rows = py::ssize_t(n);
  Data made;
  made["attitude"] = array(std::move(attitude), {rows, 4});
  made["angular_velocity"] = array(std::move(velocity), {rows, 3});
  made["angular_momentum"] = array(std::move(momentum), {rows, 3});
  made["rotor_rate"] = array(std::move(rate), {rows});
  made["rotor_angle"] = array(std::move(angle), {rows});
  made["lyapunov"] = array(std::move(lyapunov), {rows});
  made["seconds"] = seconds;
  made["rhs"] = run.counts.rhs;
  made["steps"] = run.counts.steps;
  made["status"] = symbol(run.status);
  return made;
}

Data integrate(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
               const Array& angular_velocity, double rotor_rate, const Array& attitude, const Array& at,
               const std::string& method, int order, double tolerance, const std::string& precision) {
  const std::vector<double> t = times(at);
  const Vec3<double> Omega = vector("angular_velocity", angular_velocity);
  const Quat<double> q = quaternion("attitude", attitude);
  finite("rotor_rate", rotor_rate);
  positive("tolerance", tolerance);
  if (precision == "long double") {
    using Long = long double;
    const bool radau = method == "radau";
    if (!radau && (method != "taylor" || order != 30))
      raise("DomainError", "precision = 'long double': only method taylor of order 30, and radau, have it");
    const auto gyrostat = gyrostat_of<Long>(inertia, axis, axial_inertia, slope, no_load_rate);
    const Quat<Long> turned = normalised(Quat<Long>{q.w, q.x, q.y, q.z});
    const auto start = gyrostat.state(turned, Omega.cast<Long>(), Long(rotor_rate));
    return columns_of(gyrostat, t.size(), [&] {
      return radau ? by_radau<Long>(gyrostat, start, t, Long(tolerance))
                   : by_taylor<Long, 30>(gyrostat, start, t, Long(tolerance));
    });
  }
  if (precision != "double") raise("DomainError", "precision = '" + precision + "': use double or long double");
  const auto gyrostat = gyrostat_of(inertia, axis, axial_inertia, slope, no_load_rate);
  const auto start = gyrostat.state(q, Omega, rotor_rate);
  const auto run = [&](auto&& work) { return columns_of(gyrostat, t.size(), work); };
  if (method == "taylor") {
    if (order != 8 && order != 12 && order != 16 && order != 20 && order != 26)
      raise("DomainError", "order = " + std::to_string(order) + ": use 8, 12, 16, 20 or 26");
    return run([&] { return by_taylor_of<8, 12, 16, 20, 26>(order, gyrostat, start, t, tolerance); });
  }
  if (method == "radau") return run([&] { return by_radau<double>(gyrostat, start, t, tolerance); });
  if (method == "dop853") return run([&] { return by_dop853(gyrostat, start, t, tolerance); });
#ifdef GYROSTAT_HAVE_CVODE
  if (method == "cvode-adams" || method == "cvode-bdf") {
    const auto kind = method == "cvode-bdf" ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams;
    return run([&] { return by_cvode(gyrostat, start, t, tolerance, kind); });
  }
#endif
  raise("DomainError", "method = '" + method + "': unknown, or not in this build");
}

}  // namespace

void bind_rotor_integrators(py::module_& module) {
  module.def("rotor_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("axis"),
             py::arg("axial_inertia"), py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"),
             py::arg("rotor_rate"), py::arg("attitude"), py::arg("times"), py::arg("method"), py::arg("order") = 20,
             py::arg("tolerance"), py::arg("precision") = "double", "The full equations under one integrator, timed.");
}
