// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a spinning, thrusting body under one integrator at one setting, for charts of error against cost.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "bind.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/models/spinning/linear_functions.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "spinning_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ode/cvode.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::spinning;
using ode::Status;

/// The columns as they are handed back.
struct Rows {
  std::vector<double> rates, attitude, momentum, velocity, position;

  explicit Rows(std::size_t n)
      : rates(3 * n, missing),
        attitude(4 * n, missing),
        momentum(3 * n, missing),
        velocity(3 * n, missing),
        position(3 * n, missing) {}

  template <Real Scalar>
  void put(std::size_t i, const Problem<Scalar>& problem, const FullSystem<Scalar>& system, Scalar t, const Scalar* x) {
    const Vec3<Scalar> omega = system.angular_velocity(x);
    const Quat<Scalar> q = system.attitude(x);
    const Scalar turned[] = {q.x, q.y, q.z, q.w};
    for (std::size_t j = 0; j < 4; ++j) attitude[4 * i + j] = double(turned[j]);
    const auto vector = [i](std::vector<double>& to, const Vec3<Scalar>& v) {
      for (std::size_t j = 0; j < 3; ++j) to[3 * i + j] = double(v[Eigen::Index(j)]);
    };
    vector(rates, omega);
    vector(momentum, inertial_momentum<Scalar>(problem, omega, q));
    vector(velocity, system.velocity(x));
    vector(position, system.position(t, x));
  }
};

struct Run {
  ode::Counts counts;
  Status status = Status::reached;
};

/// Steps through the times; `numbers_at(t)` are the numbers of FullSystem at one inside the last step.
template <Real Scalar, class Solver, class NumbersAt>
Run along(Solver& solver, const Problem<Scalar>& problem, const FullSystem<Scalar>& system,
          const std::vector<double>& at, Rows& rows, NumbersAt&& numbers_at) {
  Run run;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto t = Scalar(at[i]);
    while (solver.time() < t && run.status == Status::reached) run.status = solver.step(Scalar(at.back()));
    if (run.status != Status::reached) break;
    const auto x = at[i] > 0 ? numbers_at(t) : system.start();
    rows.put(i, problem, system, t, x.data());
  }
  run.counts = solver.counts();
  return run;
}

template <Real Scalar, int Order>
Run by_taylor(const Problem<Scalar>& problem, const std::vector<double>& at, Scalar tolerance, Rows& rows) {
  using System = FullSystem<Scalar>;
  using Solver = ode::Taylor<System, Order>;
  const System system(problem);
  typename Solver::Options options;
  options.tolerance = tolerance;
  options.scale = system.scale(Scalar(at.back()));
  Solver solver(system, 0, system.start(), options);
  return along(solver, problem, system, at, rows, [&](Scalar t) {
    alignas(32) Scalar x[Solver::width];
    solver.at(t, x);
    typename System::Numbers numbers;
    std::copy(x, x + System::width, numbers.begin());
    return numbers;
  });
}

template <int... orders>
Run by_taylor_of(int order, const Problem<double>& problem, const std::vector<double>& at, double tolerance,
                 Rows& rows) {
  Run run;
  (void)((order == orders && (run = by_taylor<double, orders>(problem, at, tolerance, rows), true)) || ...);
  return run;
}

/// What the equations need as thirteen numbers of the size of 1: rates, quaternion, the force's direction once and twice integrated. For
/// integrators that know no model.
struct Plain {
  static constexpr std::size_t width = 13;
  using State = std::array<double, width>;

  const Problem<double>& problem;
  FullSystem<double> system;
  Vec3<double> direction{0, 0, 1};
  double rate_unit, time_unit;

  Plain(const Problem<double>& body, double span) : problem(body), system(body) {
    const auto scale = system.scale(span);
    rate_unit = scale[0];
    time_unit = scale[8];
    if (const double size = body.force.norm(); size > 0) direction = body.force / size;
  }

  double unit(std::size_t i) const noexcept {
    return i < 3 ? rate_unit : i < 7 ? 1.0 : i < 10 ? time_unit : time_unit * time_unit;
  }
  static std::size_t place(std::size_t i) noexcept { return i < 3 ? i : i < 10 ? i + 1 : i + 2; }

  State start() const noexcept {
    State y{};
    for (std::size_t i = 0; i < width; ++i) y[i] = system.start()[place(i)] / unit(i);
    return y;
  }
  FullSystem<double>::Numbers numbers(const double* y) const noexcept {
    FullSystem<double>::Numbers x{};
    for (std::size_t i = 0; i < width; ++i) x[place(i)] = y[i] * unit(i);
    return x;
  }
  void operator()(double, const State& y, State& rate) const noexcept {
    const auto x = numbers(y.data());
    const Vec3<double> omega(x[0], x[1], x[2]);
    const Quat<double> q{x[4], x[5], x[6], x[7]};
    const Vec3<double> a = angular_acceleration(problem, omega), d = rotate<double>(q, direction);
    const auto dq = quaternion_rate<double>(q, omega);
    rate = {a[0], a[1], a[2], dq.w, dq.x, dq.y, dq.z, d[0], d[1], d[2], x[8], x[9], x[10]};
    for (std::size_t i = 0; i < width; ++i) rate[i] /= unit(i);
  }
};

Run by_dop853(const Problem<double>& problem, const std::vector<double>& at, double tolerance, Rows& rows) {
  const Plain plain(problem, at.back());
  ode::StepControl<double, Plain::width> control;
  control.relative = tolerance;
  control.absolute = ode::uniform<double, Plain::width>(tolerance);
  for (std::size_t i = 10; i < Plain::width; ++i) control.absolute[i] = infinity<double>;  // nothing depends on them
  control.step_cap = 100'000'000;
  ode::RungeKutta<double, Plain::width, Plain> solver(plain, 0, plain.start(), control);
  return along(solver, problem, plain.system, at, rows, [&](double t) { return plain.numbers(solver.at(t).data()); });
}

#ifdef GYROSTAT_HAVE_CVODE
Run by_cvode(const Problem<double>& problem, const std::vector<double>& at, double tolerance, Rows& rows,
             ode::CvodeMethod method) {
  Plain plain(problem, at.back());
  ode::CvodeSystem system;
  system.dimension = int(Plain::width);
  system.user = &plain;
  system.rhs = [](double t, const double* y, double* out, void* user) {
    Plain::State state, rate;
    std::copy(y, y + Plain::width, state.begin());
    (*static_cast<const Plain*>(user))(t, state, rate);
    std::copy(rate.begin(), rate.end(), out);
    return std::all_of(rate.begin(), rate.end(), [](double x) { return std::isfinite(x); });
  };
  ode::CvodeOptions options;
  options.method = method;
  options.relative = options.absolute = tolerance;
  auto made = ode::Cvode::create(system, 0, plain.start(), options);
  if (!made) return {{}, Status::not_finite};
  ode::Cvode solver = std::move(made).value();
  return along(solver, problem, plain.system, at, rows, [&](double t) {
    Plain::State y{};
    solver.at(t, y);
    return plain.numbers(y.data());
  });
}
#endif

Data integrate(const SpinningProblems& problems, const Array& at, const std::string& method, int order,
               double tolerance, const std::string& precision) {
  const std::vector<double> t = times(at);
  const Problem<double>& problem = problems.single();
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    raise("DomainError", "tolerance = " + text(tolerance) + ": give a finite number > 0");
  Rows rows(t.size());
  const auto answer = [&](auto&& work) {
    const auto [run, seconds] = timed(work);
    const auto n = py::ssize_t(t.size());
    Data made;
    made["angular_velocity"] = array(std::move(rows.rates), {n, 3});
    made["attitude"] = array(std::move(rows.attitude), {n, 4});
    made["angular_momentum_inertial"] = array(std::move(rows.momentum), {n, 3});
    made["velocity"] = array(std::move(rows.velocity), {n, 3});
    made["position"] = array(std::move(rows.position), {n, 3});
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
    return answer(
        [&] { return by_taylor<Long, 30>(spinning::detail::problem_cast<Long>(problem), t, Long(tolerance), rows); });
  }
  if (precision != "double") raise("DomainError", "precision = '" + precision + "': use double or long double");
  if (method == "taylor") {
    if (order != 8 && order != 12 && order != 16 && order != 20 && order != 26)
      raise("DomainError", "order = " + std::to_string(order) + ": use 8, 12, 16, 20 or 26");
    return answer([&] { return by_taylor_of<8, 12, 16, 20, 26>(order, problem, t, tolerance, rows); });
  }
  if (method == "dop853") return answer([&] { return by_dop853(problem, t, tolerance, rows); });
#ifdef GYROSTAT_HAVE_CVODE
  if (method == "cvode-adams" || method == "cvode-bdf") {
    const auto kind = method == "cvode-bdf" ? ode::CvodeMethod::bdf : ode::CvodeMethod::adams;
    return answer([&] { return by_cvode(problem, t, tolerance, rows, kind); });
  }
#endif
  raise("DomainError", "method = '" + method + "': unknown, or not in this build");
}

}  // namespace

void bind_spinning_integrators(py::module_& module) {
  module.def("spinning_integrate", &integrate, py::arg("problem"), py::kw_only(), py::arg("times"), py::arg("method"),
             py::arg("order") = 20, py::arg("tolerance"), py::arg("precision") = "double",
             "The full equations under one integrator, timed.");
}
