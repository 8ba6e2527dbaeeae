// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a free body under one integrator at one setting.
#include "bind.hpp"
#include "free_arguments.hpp"
#include "gyrostat/models/free/full.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "integrators.hpp"

// the library has it
extern template class gyrostat::ode::Taylor<gyrostat::free::FullSystem<double>>;

namespace of_free {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;

template <Real Scalar_>
struct FreeMotion {
  using Scalar = Scalar_;
  using System = free::FullSystem<Scalar>;

  explicit FreeMotion(const free::Problem<Scalar>& problem)
      : equations(problem), from(equations.state(0, equations.start().data())) {}
  System equations;
  free::FullState<Scalar> from;

  const System& system() const { return equations; }
  const free::FullState<Scalar>& start() const { return from; }
  typename System::Numbers numbers() const { return equations.start(); }
  typename System::Numbers scale(Scalar) const { return equations.scale(); }
  free::FullState<Scalar> state(Scalar t, const Scalar* x) const { return equations.state(t, x); }
};

/// Attitude, and the momentum over its size.
struct FreePlain {
  static constexpr std::size_t width = 7;
  using Numbers = std::array<double, width>;

  FreePlain(const free::Problem<double>& problem, const free::FullState<double>& start)
      : inverse(problem.inertia.inverse()),
        l(problem.rotor_momentum),
        from(start),
        size(std::max(start.angular_momentum.norm(), 1e-300)) {}
  Mat3<double> inverse;
  Vec3<double> l;
  free::FullState<double> from;
  double size;

  const free::FullState<double>& start() const { return from; }
  Numbers numbers() const {
    const auto& q = from.attitude;
    const Vec3<double> M = from.angular_momentum / size;
    return {q.w, q.x, q.y, q.z, M[0], M[1], M[2]};
  }
  Numbers absolute(double tolerance) const { return ode::uniform<double, width>(tolerance); }
  free::FullState<double> state(double, const double* y) const noexcept {
    free::FullState<double> made;
    made.attitude = normalised(Quat<double>{y[0], y[1], y[2], y[3]});
    made.angular_momentum = size * Vec3<double>(y[4], y[5], y[6]);
    made.angular_velocity = inverse * (made.angular_momentum - l);
    return made;
  }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const Vec3<double> M(y[4], y[5], y[6]), omega = inverse * (size * M - l), turned = cross<double>(M, omega);
    const Quat<double> q = quaternion_rate<double>({y[0], y[1], y[2], y[3]}, omega);
    rate = {q.w, q.x, q.y, q.z, turned[0], turned[1], turned[2]};
  }
};

Data integrate(const Array& inertia, const Array& rotor_momentum, const Wheels& wheels,
               const std::optional<Array>& angular_velocity, const std::optional<Array>& angular_momentum,
               const Array& attitude, const Array& at, const std::string& method, int order, double tolerance,
               const std::string& precision, double patience) {
  const auto assembly = assembly_of(inertia, rotor_momentum, wheels, angular_velocity, angular_momentum, attitude);
  free::UnsoundWheel<double> unsound;
  (void)sound(free::Reduced<double>::of(assembly, &unsound), assembly, unsound);
  const Task task = task_of(times(at), method, order, tolerance, precision, patience);
  Table table(task.times.size(), {{"attitude", 4}, {"angular_velocity", 3}, {"angular_momentum", 3}});
  const auto run = [&]<Real Scalar>(Scalar) {
    const auto problem = free::Reduced<Scalar>::taken(assembly).problem;
    const auto put = [&](std::size_t i, const free::FullState<Scalar>& s) {
      table.put(0, i, xyzw(s.attitude));
      table.put(1, i, s.angular_velocity);
      table.put(2, i, s.angular_momentum);
    };
    const auto [course, seconds] = timed([&] {
      const FreeMotion<Scalar> motion(problem);
      if constexpr (std::is_same_v<Scalar, double>)
        return by_name(motion, FreePlain(problem, motion.start()), task, put);
      else return by_taylor<long_order>(motion, task, put);
    });
    return std::move(table).data(course, seconds);
  };
  return task.long_double ? run(0.0L) : run(0.0);
}

}  // namespace
}  // namespace of_free

void bind_free_integrators(pybind11::module_& module) {
  using namespace of_free;
  module.def("free_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("rotor_momentum"),
             py::arg("wheels"), py::arg("angular_velocity"), py::arg("angular_momentum"), py::arg("attitude"),
             py::arg("times"), py::arg("method"), py::arg("order") = 20, py::arg("tolerance"),
             py::arg("precision") = "double", py::arg("patience") = infinity<double>,
             "The full equations under one integrator, timed.");
}
