// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a spinning, thrusting body under one integrator at one setting.
#include "bind.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/models/spinning/linear_functions.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "integrators.hpp"
#include "spinning_arguments.hpp"

// the library has them
extern template class gyrostat::ode::Taylor<gyrostat::spinning::FullSystem<double>>;

namespace of_spinning {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::spinning;

/// What the columns hold; rates and momentum in body axes, velocity and position in inertial ones.
template <Real Scalar>
struct State {
  Vec3<Scalar> angular_velocity;
  Quat<Scalar> attitude;
  Vec3<Scalar> velocity, position;
};

template <Real Scalar>
State<Scalar> state_of(const FullSystem<Scalar>& system, Scalar t, const Scalar* x) {
  return {system.angular_velocity(x), system.attitude(x), system.velocity(x), system.position(t, x)};
}

template <Real Scalar_>
struct Motion {
  using Scalar = Scalar_;
  using System = FullSystem<Scalar>;

  System equations;

  const System& system() const { return equations; }
  State<Scalar> start() const { return state(0, equations.start().data()); }
  typename System::Numbers numbers() const { return equations.start(); }
  typename System::Numbers scale(Scalar span) const { return equations.scale(span); }
  State<Scalar> state(Scalar t, const Scalar* x) const { return state_of(equations, t, x); }
};

/// What the equations need as thirteen numbers of the size of 1: rates, quaternion, the force's direction once and twice integrated.
struct Plain {
  static constexpr std::size_t width = 13;
  using Numbers = std::array<double, width>;

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

  State<double> start() const { return state_of(system, 0.0, system.start().data()); }
  State<double> state(double t, const double* y) const { return state_of(system, t, raw(y).data()); }
  Numbers numbers() const noexcept {
    Numbers y{};
    for (std::size_t i = 0; i < width; ++i) y[i] = system.start()[place(i)] / unit(i);
    return y;
  }
  Numbers absolute(double tolerance) const {
    Numbers made = ode::uniform<double, width>(tolerance);
    for (std::size_t i = 10; i < width; ++i) made[i] = infinity<double>;  // nothing depends on them
    return made;
  }
  FullSystem<double>::Numbers raw(const double* y) const noexcept {
    FullSystem<double>::Numbers x{};
    for (std::size_t i = 0; i < width; ++i) x[place(i)] = y[i] * unit(i);
    return x;
  }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const auto x = raw(y.data());
    const Vec3<double> omega(x[0], x[1], x[2]);
    const Quat<double> q{x[4], x[5], x[6], x[7]};
    const Vec3<double> a = angular_acceleration(problem, omega), d = rotate<double>(q, direction);
    const auto dq = quaternion_rate<double>(q, omega);
    rate = {a[0], a[1], a[2], dq.w, dq.x, dq.y, dq.z, d[0], d[1], d[2], x[8], x[9], x[10]};
    for (std::size_t i = 0; i < width; ++i) rate[i] /= unit(i);
  }
};

Data integrate(const SpinningProblems& problems, const Array& at, const std::string& method, int order,
               double tolerance, const std::string& precision, double patience) {
  const Task task = task_of(times(at), method, order, tolerance, precision, patience);
  Table table(
      task.times.size(),
      {{"angular_velocity", 3}, {"attitude", 4}, {"angular_momentum_inertial", 3}, {"velocity", 3}, {"position", 3}});
  const auto run = [&]<Real Scalar>(Scalar) {
    const auto problem = spinning::detail::problem_cast<Scalar>(problems.single());
    const auto put = [&](std::size_t i, const State<Scalar>& s) {
      table.put(0, i, s.angular_velocity);
      table.put(1, i, xyzw(s.attitude));
      table.put(2, i, inertial_momentum<Scalar>(problem, s.angular_velocity, s.attitude));
      table.put(3, i, s.velocity);
      table.put(4, i, s.position);
    };
    const auto [course, seconds] = timed([&] {
      const Motion<Scalar> motion{FullSystem<Scalar>(problem)};
      if constexpr (std::is_same_v<Scalar, double>)
        return by_name(motion, Plain(problem, task.times.back()), task, put);
      else return by_taylor<long_order>(motion, task, put);
    });
    return std::move(table).data(course, seconds);
  };
  return task.long_double ? run(0.0L) : run(0.0);
}

}  // namespace
}  // namespace of_spinning

void bind_spinning_integrators(pybind11::module_& module) {
  using namespace of_spinning;
  module.def("spinning_integrate", &integrate, py::arg("problem"), py::kw_only(), py::arg("times"), py::arg("method"),
             py::arg("order") = 20, py::arg("tolerance"), py::arg("precision") = "double",
             py::arg("patience") = infinity<double>, "The full equations under one integrator, timed.");
}
