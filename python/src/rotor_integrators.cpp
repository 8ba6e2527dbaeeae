// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a driven rotor under one integrator at one setting.
#include "bind.hpp"
#include "gyrostat/models/rotor/full.hpp"
#include "gyrostat/models/rotor/relaxing.hpp"
#include "gyrostat/ode/radau.hpp"
#include "integrators.hpp"
#include "rotor_arguments.hpp"

// the library has them
extern template class gyrostat::ode::Taylor<gyrostat::rotor::FullSystem<double>>;

namespace of_rotor {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::rotor;

template <Real Scalar_>
struct Motion {
  using Scalar = Scalar_;
  using System = FullSystem<Scalar>;

  const Gyrostat<Scalar>& gyrostat;
  const State<Scalar>& from;
  System equations{gyrostat, from};

  const System& system() const { return equations; }
  const State<Scalar>& start() const { return from; }
  typename System::Numbers numbers() const { return equations.start(); }
  typename System::Numbers scale(Scalar) const { return equations.scale(); }
  State<Scalar> state(Scalar t, const Scalar* x) const { return equations.state(t, x); }
};

/// Attitude, momenta over the size that they reach, rotor angle.
struct Plain {
  static constexpr std::size_t width = 9;
  using Numbers = std::array<double, width>;

  const Gyrostat<double>& gyrostat;
  const State<double>& from;
  double size = size_of(gyrostat, from);

  static double size_of(const Gyrostat<double>& body, const State<double>& start) {
    const double made = start.momentum.norm() + std::abs(body.target_momentum()) + std::abs(start.axial_momentum);
    return made > 0 ? made : 1;
  }
  const State<double>& start() const { return from; }
  Numbers numbers() const { return numbers(from); }
  Numbers numbers(const State<double>& s) const noexcept {
    const auto& [q, H, p, angle] = s;
    return {q.w, q.x, q.y, q.z, H[0] / size, H[1] / size, H[2] / size, p / size, angle};
  }
  Numbers absolute(double tolerance) const {
    Numbers made = ode::uniform<double, width>(tolerance);
    made[8] = infinity<double>;  // a quadrature: it needs no control of its own
    return made;
  }
  State<double> raw(const double* y) const noexcept {
    return {{y[0], y[1], y[2], y[3]}, size * Vec3<double>(y[4], y[5], y[6]), size * y[7], y[8]};
  }
  State<double> state(double, const double* y) const noexcept {
    State<double> made = raw(y);
    made.attitude = normalised(made.attitude);
    return made;
  }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    rate = numbers(state_rate(gyrostat, raw(y.data())));
  }
  void jacobian(const double* y, double* columns) const {
    Eigen::Matrix<double, 9, 9> J = state_jacobian(gyrostat, raw(y));
    J.middleRows<4>(4) /= size;
    J.middleCols<4>(4) *= size;
    std::copy_n(J.data(), 81, columns);
  }
};

template <Real Scalar, class Put>
Course by_radau(const Gyrostat<Scalar>& gyrostat, const State<Scalar>& start, const Task& task, Put&& put) {
  using System = RelaxingRotor<Scalar>;
  using Solver = ode::Radau<System>;
  const System system(gyrostat, start);
  typename Solver::Options options;
  options.tolerance = Scalar(task.tolerance);
  options.scale = System::scale(gyrostat, start);
  Solver solver(system, 0, system.components(start), options);
  const auto state_at = [&](Scalar t) {
    alignas(32) Scalar x[Solver::width + 1];
    solver.at(t, x);
    return system.state(x);
  };
  return along<Scalar>(solver, task, start, state_at, put);
}

Data integrate(const Array& inertia, const Array& axis, double axial_inertia, double slope, double no_load_rate,
               const Array& angular_velocity, double rotor_rate, const Array& attitude, const Array& at,
               const std::string& method, int order, double tolerance, const std::string& precision, double patience) {
  const Vec3<double> Omega = vector("angular_velocity", angular_velocity);
  const Quat<double> q = quaternion("attitude", attitude);
  finite("rotor_rate", rotor_rate);
  const Task task = task_of(times(at), method, order, tolerance, precision, patience, true);
  Table table(task.times.size(), {{"attitude", 4},
                                  {"angular_velocity", 3},
                                  {"angular_momentum", 3},
                                  {"rotor_rate", 1},
                                  {"rotor_angle", 1},
                                  {"lyapunov", 1}});
  const auto run = [&]<Real Scalar>(Scalar) {
    const auto gyrostat = gyrostat_of<Scalar>(inertia, axis, axial_inertia, slope, no_load_rate);
    const auto turned = normalised(Quat<Scalar>{q.w, q.x, q.y, q.z});
    const State<Scalar> start = gyrostat.state(turned, Omega.cast<Scalar>(), Scalar(rotor_rate));
    const auto put = [&](std::size_t i, const State<Scalar>& s) {
      const Vec3<Scalar> rate = gyrostat.angular_velocity(s.momentum, s.axial_momentum);
      table.put(0, i, xyzw(s.attitude));
      table.put(1, i, rate);
      table.put(2, i, s.momentum);
      table.put(3, i, std::array{gyrostat.rotor_rate(s.axial_momentum, rate)});
      table.put(4, i, std::array{s.rotor_angle});
      table.put(5, i, std::array{gyrostat.lyapunov(s.momentum, s.axial_momentum)});
    };
    const auto [course, seconds] = timed([&] {
      if (task.method == "radau") return by_radau(gyrostat, start, task, put);
      const Motion<Scalar> motion{gyrostat, start};
      if constexpr (std::is_same_v<Scalar, double>) return by_name(motion, Plain{gyrostat, start}, task, put);
      else return by_taylor<long_order>(motion, task, put);
    });
    return std::move(table).data(course, seconds);
  };
  return task.long_double ? run(0.0L) : run(0.0);
}

}  // namespace
}  // namespace of_rotor

void bind_rotor_integrators(pybind11::module_& module) {
  using namespace of_rotor;
  module.def("rotor_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("axis"),
             py::arg("axial_inertia"), py::arg("slope"), py::arg("no_load_rate"), py::arg("angular_velocity"),
             py::arg("rotor_rate"), py::arg("attitude"), py::arg("times"), py::arg("method"), py::arg("order") = 20,
             py::arg("tolerance"), py::arg("precision") = "double", py::arg("patience") = infinity<double>,
             "The full equations under one integrator, timed.");
}
