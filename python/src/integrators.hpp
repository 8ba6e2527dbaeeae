// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a family under one integrator at one setting, for charts of error against cost: the methods by name, and the run over
// the times.
//
// A family gives its equations twice. `Motion<Scalar>`, for Taylor series: Scalar, System, system(), numbers(), scale(span), start() and
// state(t, numbers). `Plain`, for integrators that know no model: width, and as numbers of the size of 1 numbers(), rates by
// operator()(t, y, rate), absolute(tolerance), start(), state(t, y) and, where it is known, jacobian(y, columns).
#pragma once

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "gyrostat/ode/runge_kutta.hpp"
#include "gyrostat/ode/taylor.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ode/cvode.hpp"
#endif

namespace gyrostat::python {

/// How a run ended, and what it cost.
struct Course {
  ode::Counts counts;
  ode::Status status = ode::Status::reached;
};

/// One integration as the caller names it.
struct Task {
  std::vector<double> times;  ///< s
  std::string method;
  int order;
  double tolerance;
  bool long_double;
  double patience;   ///< CPU seconds after which it gives up, with the status cancelled
  double begin = 0;  ///< s, of the start
};

inline constexpr int taylor_order = 20;
inline constexpr int long_order = 30;  ///< in long double

/// The checked task; `radau`: the family knows that method as well.
inline Task task_of(std::vector<double> times, const std::string& method, int order, double tolerance,
                    const std::string& precision, double patience, bool radau = false) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    raise("DomainError", "tolerance = " + text(tolerance) + ": give a finite number > 0");
  if (!(patience > 0)) raise("DomainError", "patience = " + text(patience) + ": give a time > 0");
  const bool longer = precision == "long double";
  if (!longer && precision != "double")
    raise("DomainError", "precision = '" + precision + "': use double or long double");
  const bool taylor = method == "taylor", by_radau = radau && method == "radau";
  if (longer && !by_radau && !(taylor && order == long_order))
    raise("DomainError", std::string("precision = 'long double': only method taylor of order 30") +
                             (radau ? ", and radau, have it" : " has it"));
  if (taylor && !longer && order != taylor_order)
    raise("DomainError", "order = " + std::to_string(order) +
                             ": Taylor series are of order 20, in precision = 'long double' of order 30");
  bool known = taylor || by_radau || method == "dop853";
#ifdef GYROSTAT_HAVE_CVODE
  known = known || method == "cvode-adams" || method == "cvode-bdf";
#endif
  if (!known) raise("DomainError", "method = '" + method + "': unknown, or not in this build");
  return {std::move(times), method, order, tolerance, longer, patience, 0};
}

/// Columns that are filled row by row; what no row reached stays NaN.
class Table {
 public:
  Table(std::size_t rows, std::initializer_list<std::pair<const char*, int>> columns) : rows_(rows) {
    for (const auto& [name, width] : columns)
      columns_.push_back({name, width, std::vector<double>(rows * std::size_t(width), missing)});
  }

  /// The numbers of any range into a column.
  template <class Numbers>
  void put(std::size_t column, std::size_t row, const Numbers& numbers) {
    Column& to = columns_[column];
    for (int i = 0; i < to.width; ++i) to.values[row * std::size_t(to.width) + std::size_t(i)] = double(numbers[i]);
  }

  /// Plain data, with how the run went.
  Data data(const Course& course, double seconds) && {
    Data made;
    const auto n = py::ssize_t(rows_);
    for (Column& column : columns_)
      made[column.name] =
          column.width == 1 ? array(std::move(column.values), {n}) : array(std::move(column.values), {n, column.width});
    made["seconds"] = seconds;
    made["rhs"] = course.counts.rhs;
    made["steps"] = course.counts.steps;
    made["status"] = symbol(course.status);
    return made;
  }

 private:
  struct Column {
    const char* name;
    int width;
    std::vector<double> values;
  };
  std::size_t rows_;
  std::vector<Column> columns_;
};

/// Quaternion as it is handed back.
template <Real Scalar>
std::array<Scalar, 4> xyzw(const Quat<Scalar>& q) {
  return {q.x, q.y, q.z, q.w};
}

/// Steps through the times: put(i, state), where the time is that of the start, else of state_at(t), which is inside the last step.
template <Real Scalar, class Solver, class State, class StateAt, class Put>
Course along(Solver& solver, const Task& task, const State& start, StateAt&& state_at, Put&& put) {
  Course course;
  const double end = thread_seconds() + task.patience;
  for (std::size_t i = 0, steps = 0; i < task.times.size(); ++i) {
    const auto t = Scalar(task.times[i]);
    while (solver.time() < t && course.status == ode::Status::reached) {
      course.status = solver.step(Scalar(task.times.back()));
      if (++steps % 64 == 0 && thread_seconds() > end) course.status = ode::Status::cancelled;
    }
    if (course.status != ode::Status::reached) break;
    put(i, t > Scalar(task.begin) ? state_at(t) : start);
  }
  course.counts = solver.counts();
  return course;
}

template <int Order, class Motion, class Put>
Course by_taylor(const Motion& motion, const Task& task, Put&& put) {
  using Scalar = typename Motion::Scalar;
  using Solver = ode::Taylor<typename Motion::System, Order>;
  typename Solver::Options options;
  options.tolerance = Scalar(task.tolerance);
  options.scale = motion.scale(Scalar(task.times.back()));
  Solver solver(motion.system(), Scalar(task.begin), motion.numbers(), options);
  const auto state_at = [&](Scalar t) {
    alignas(32) Scalar x[Solver::width];
    solver.at(t, x);
    return motion.state(t, x);
  };
  return along<Scalar>(solver, task, motion.start(), state_at, put);
}

template <class Plain, class Put>
Course by_dop853(const Plain& plain, const Task& task, Put&& put) {
  ode::StepControl<double, Plain::width> control;
  control.relative = task.tolerance;
  control.absolute = plain.absolute(task.tolerance);
  control.step_cap = 100'000'000;
  ode::RungeKutta<double, Plain::width, Plain> solver(plain, task.begin, plain.numbers(), control);
  return along<double>(solver, task, plain.start(), [&](double t) { return plain.state(t, solver.at(t).data()); }, put);
}

#ifdef GYROSTAT_HAVE_CVODE
template <class Plain, class Put>
Course by_cvode(Plain plain, const Task& task, ode::CvodeMethod method, Put&& put) {
  using Numbers = std::array<double, Plain::width>;
  ode::CvodeSystem system;
  system.dimension = int(Plain::width);
  system.user = &plain;
  system.rhs = [](double t, const double* y, double* out, void* user) {
    Numbers state, rate;
    std::copy_n(y, Plain::width, state.begin());
    (*static_cast<const Plain*>(user))(t, state, rate);
    std::copy(rate.begin(), rate.end(), out);
    return std::all_of(rate.begin(), rate.end(), [](double x) { return std::isfinite(x); });
  };
  if constexpr (requires(double* columns) { plain.jacobian(columns, columns); })
    system.jacobian = [](double, const double* y, double* columns, void* user) {
      static_cast<const Plain*>(user)->jacobian(y, columns);
      return std::all_of(columns, columns + Plain::width * Plain::width, [](double x) { return std::isfinite(x); });
    };
  auto made = ode::Cvode::create(system, task.begin, plain.numbers(), {method, task.tolerance, task.tolerance});
  if (!made) return {{}, ode::Status::not_finite};
  ode::Cvode solver = std::move(made).value();
  const auto state_at = [&](double t) {
    Numbers y{};
    solver.at(t, y);
    return plain.state(t, y.data());
  };
  return along<double>(solver, task, plain.start(), state_at, put);
}
#endif

/// The methods that all families have, in double precision.
template <class Motion, class Plain, class Put>
Course by_name(const Motion& motion, const Plain& plain, const Task& task, Put&& put) {
#ifdef GYROSTAT_HAVE_CVODE
  if (task.method == "cvode-adams") return by_cvode(plain, task, ode::CvodeMethod::adams, put);
  if (task.method == "cvode-bdf") return by_cvode(plain, task, ode::CvodeMethod::bdf, put);
#endif
  if (task.method == "dop853") return by_dop853(plain, task, put);
  return by_taylor<taylor_order>(motion, task, put);
}

}  // namespace gyrostat::python
