// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a heavy body under one integrator at one setting, for charts of error against cost.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "heavy_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/heavy/cvode_motion.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::heavy;
using ode::Status;

/// The columns as they are handed back, in the caller's axes.
struct Rows {
  Mat3<double> R_BP;
  std::vector<double> rates, down, attitude;

  Rows(const Mat3<double>& axes, std::size_t n)
      : R_BP(axes), rates(3 * n, missing), down(3 * n, missing), attitude(4 * n, missing) {}

  template <Real Scalar>
  void put(std::size_t i, const State<Scalar>& state_P) {
    State<double> plain;
    for (int j = 0; j < 3; ++j) {
      plain.angular_velocity[j] = double(state_P.angular_velocity[j]);
      plain.down[j] = double(state_P.down[j]);
    }
    const auto& q = state_P.attitude;
    plain.attitude = {double(q.w), double(q.x), double(q.y), double(q.z)};
    const State<double> state = in_axes(R_BP, plain);
    std::copy_n(state.angular_velocity.data(), 3, &rates[3 * i]);
    std::copy_n(state.down.data(), 3, &down[3 * i]);
    const double turned[] = {state.attitude.x, state.attitude.y, state.attitude.z, state.attitude.w};
    std::copy_n(turned, 4, &attitude[4 * i]);
  }
};

struct Run {
  ode::Counts counts;
  Status status = Status::reached;
};

/// Steps through the times; `state_at(t)` is the state at one inside the last step.
template <Real Scalar, class Solver, class StateAt>
Run along(Solver& solver, const State<Scalar>& start, const std::vector<double>& at, Rows& rows, StateAt&& state_at) {
  Run run;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto t = Scalar(at[i]);
    while (solver.time() < t && run.status == Status::reached) run.status = solver.step(Scalar(at.back()));
    if (run.status != Status::reached) break;
    rows.put(i, at[i] > 0 ? state_at(t) : start);
  }
  run.counts = solver.counts();
  return run;
}

template <Real Scalar, int Order, bool turning>
Run by_taylor(const Problem<Scalar>& problem, const State<Scalar>& start, const std::vector<double>& at,
              Scalar tolerance, Rows& rows) {
  using System = FullSystem<Scalar, turning>;
  using Solver = ode::Taylor<System, Order>;
  const System system(problem, start);
  typename Solver::Options options;
  options.tolerance = tolerance;
  options.scale = system.scale();
  Solver solver(system, 0, system.start(), options);
  return along(solver, start, at, rows, [&](Scalar t) {
    alignas(32) Scalar x[Solver::width];
    solver.at(t, x);
    return system.state(x);
  });
}

template <bool turning, int... orders>
Run by_taylor_of(int order, const Problem<double>& problem, const State<double>& start, const std::vector<double>& at,
                 double tolerance, Rows& rows) {
  Run run;
  (void)((order == orders && (run = by_taylor<double, orders, turning>(problem, start, at, tolerance, rows), true)) ||
         ...);
  return run;
}

/// Problem and start in another precision.
template <Real To>
std::pair<Problem<To>, State<To>> converted(const Problem<double>& problem, const State<double>& start) {
  const auto vector = [](const Vec3<double>& v) { return Vec3<To>(v.template cast<To>()); };
  const auto made = Problem<To>::make(vector(problem.inertia()), To(problem.mass()), vector(problem.centre_of_mass()),
                                      To(problem.gravity()), To(problem.gradient()));
  // in a precision with less rounding the bound that double passes may be missed by rounding
  if (!made) raise("DomainError", "the inertia is at the bound of what a body can have: not known in this precision");
  const auto& q = start.attitude;
  State<To> from{vector(start.angular_velocity), vector(start.down), {To(q.w), To(q.x), To(q.y), To(q.z)}};
  return {*made, from};
}

/// The rates over their size, down, and the attitude where it is asked for. For integrators that know no model.
template <std::size_t width>
struct Plain {
  using Numbers = std::array<double, width>;
  const Problem<double>& problem;
  double unit;

  Plain(const Problem<double>& body, const State<double>& start) : problem(body) {
    const double rate = rate_size(body, start);
    unit = rate > 0 ? rate : 1;
  }

  Numbers numbers(const Vec3<double>& w, const Vec3<double>& d, const Quat<double>& q) const noexcept {
    Numbers y{};
    for (std::size_t i = 0; i < 3; ++i) y[i] = w[int(i)] / unit, y[3 + i] = d[int(i)];
    if constexpr (width == 10) y[6] = q.w, y[7] = q.x, y[8] = q.y, y[9] = q.z;
    return y;
  }
  State<double> state(const double* y) const noexcept {
    State<double> s{unit * Vec3<double>(y[0], y[1], y[2]), {y[3], y[4], y[5]}, {}};
    if constexpr (width == 10) s.attitude = {y[6], y[7], y[8], y[9]};
    return s;
  }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const State<double> s = state(y.data());
    rate = numbers(angular_acceleration<double>(problem, s.angular_velocity, s.down),
                   fixed_vector_rate<double>(s.down, s.angular_velocity),
                   quaternion_rate<double>(s.attitude, s.angular_velocity));
  }
};

State<double> with_unit_attitude(State<double> state) {
  state.attitude = normalised(state.attitude);
  return state;
}

template <std::size_t width>
Run by_dop853(const Problem<double>& problem, const State<double>& start, const std::vector<double>& at,
              double tolerance, Rows& rows) {
  const Plain<width> plain(problem, start);
  ode::StepControl<double, width> control;
  control.relative = tolerance;
  control.absolute = ode::uniform<double, width>(tolerance);
  control.step_cap = 100'000'000;
  ode::RungeKutta<double, width, Plain<width>> solver(
      plain, 0, plain.numbers(start.angular_velocity, start.down, start.attitude), control);
  return along(solver, start, at, rows, [&](double t) { return with_unit_attitude(plain.state(solver.at(t).data())); });
}

#ifdef GYROSTAT_HAVE_CVODE
Run by_cvode(const Problem<double>& problem, const State<double>& start, bool turning, const std::vector<double>& at,
             double tolerance, Rows& rows, ode::CvodeMethod method) {
  CvodeEquations equations(problem, start, turning);
  auto numbers = equations.start();
  auto made = ode::Cvode::create(equations.system(), 0, numbers, {method, tolerance, tolerance});
  if (!made) return {{}, Status::not_finite};
  ode::Cvode solver = std::move(made).value();
  return along(solver, start, at, rows, [&](double t) {
    solver.at(t, numbers);
    return equations.state(numbers.data());
  });
}
#endif

Data integrate(const Array& inertia, double mass, const Array& centre_of_mass, double gravity, double gradient,
               const std::optional<Array>& angular_velocity, const std::optional<Array>& down,
               const std::optional<Array>& attitude, const Array& at, const std::string& method, int order,
               double tolerance, const std::string& precision) {
  const std::vector<double> t = times(at);
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    raise("DomainError", "tolerance = " + text(tolerance) + ": give a finite number > 0");
  Question question;
  question.times = t;
  const Start given = heavy_start(angular_velocity, down, attitude, {}, question);
  const auto scene = Scene::make(heavy_body(inertia, mass, centre_of_mass, gravity, gradient), given, question);
  if (!scene) raise("DomainError", std::string("start: ") + message(scene.error()));
  const Problem<double>& problem = scene->problem();
  const State<double>& start = scene->start();
  const bool turning = question.wants_attitude;
  Rows rows(scene->R_BP(), t.size());
  const auto answer = [&](auto&& work) {
    const auto [run, seconds] = timed(work);
    const auto n = py::ssize_t(t.size());
    Data made;
    made["angular_velocity"] = array(std::move(rows.rates), {n, 3});
    made["down"] = array(std::move(rows.down), {n, 3});
    if (turning) made["attitude"] = array(std::move(rows.attitude), {n, 4});
    made["seconds"] = seconds;
    made["rhs"] = run.counts.rhs;
    made["steps"] = run.counts.steps;
    made["status"] = symbol(run.status);
    return made;
  };
  if (precision == "long double") {
    if (method != "taylor" || order != 30)
      raise("DomainError", "precision = 'long double': only method taylor of order 30 has it");
    using Long = long double;
    const auto [body, from] = converted<Long>(problem, start);
    return answer([&, &body = body, &from = from] {
      return turning ? by_taylor<Long, 30, true>(body, from, t, Long(tolerance), rows)
                     : by_taylor<Long, 30, false>(body, from, t, Long(tolerance), rows);
    });
  }
  if (precision != "double") raise("DomainError", "precision = '" + precision + "': use double or long double");
  if (method == "taylor") {
    if (order != 8 && order != 12 && order != 16 && order != 20 && order != 26)
      raise("DomainError", "order = " + std::to_string(order) + ": use 8, 12, 16, 20 or 26");
    return answer([&] {
      return turning ? by_taylor_of<true, 8, 12, 16, 20, 26>(order, problem, start, t, tolerance, rows)
                     : by_taylor_of<false, 8, 12, 16, 20, 26>(order, problem, start, t, tolerance, rows);
    });
  }
  if (method == "dop853")
    return answer([&] {
      return turning ? by_dop853<10>(problem, start, t, tolerance, rows)
                     : by_dop853<6>(problem, start, t, tolerance, rows);
    });
#ifdef GYROSTAT_HAVE_CVODE
  if (method == "cvode-adams" || method == "cvode-bdf") {
    const auto kind = method == "cvode-bdf" ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams;
    return answer([&] { return by_cvode(problem, start, turning, t, tolerance, rows, kind); });
  }
#endif
  raise("DomainError", "method = '" + method + "': unknown, or not in this build");
}

}  // namespace

void bind_heavy_integrators(py::module_& module) {
  module.def("heavy_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("mass"),
             py::arg("centre_of_mass"), py::arg("gravity"), py::arg("gravity_gradient"), py::arg("angular_velocity"),
             py::arg("down"), py::arg("attitude"), py::arg("times"), py::arg("method"), py::arg("order") = 20,
             py::arg("tolerance"), py::arg("precision") = "double", "The full equations under one integrator, timed.");
}
