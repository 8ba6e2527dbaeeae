// SPDX-License-Identifier: BSD-3-Clause
// The full equations of a heavy body under one integrator at one setting.
#include <pybind11/stl.h>

#include <optional>

#include "bind.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/rotation/kinematics.hpp"
#include "heavy_arguments.hpp"
#include "integrators.hpp"

// the library has them
extern template class gyrostat::ode::Taylor<gyrostat::heavy::FullSystem<double, true>>;
extern template class gyrostat::ode::Taylor<gyrostat::heavy::FullSystem<double, false>>;

namespace of_heavy {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::heavy;

/// turning: with the attitude.
template <Real Scalar_, bool turning>
struct Motion {
  using Scalar = Scalar_;
  using System = FullSystem<Scalar, turning>;

  const Problem<Scalar>& problem;
  const State<Scalar>& from;
  System equations{problem, from};

  const System& system() const { return equations; }
  const State<Scalar>& start() const { return from; }
  typename System::Numbers numbers() const { return equations.start(); }
  typename System::Numbers scale(Scalar) const { return equations.scale(); }
  State<Scalar> state(Scalar, const Scalar* x) const { return equations.state(x); }
};

/// The rates over the size that they reach, down, and with the attitude (width 10) its quaternion.
template <std::size_t width_>
struct Plain {
  static constexpr std::size_t width = width_;
  using Numbers = std::array<double, width>;

  const Problem<double>& problem;
  const State<double>& from;
  double unit = rate_size(problem, from) > 0 ? rate_size(problem, from) : 1;

  const State<double>& start() const { return from; }
  Numbers numbers() const { return numbers(from.angular_velocity, from.down, from.attitude); }
  Numbers numbers(const Vec3<double>& w, const Vec3<double>& d, const Quat<double>& q) const noexcept {
    Numbers y{};
    for (std::size_t i = 0; i < 3; ++i) y[i] = w[int(i)] / unit, y[3 + i] = d[int(i)];
    if constexpr (width == 10) y[6] = q.w, y[7] = q.x, y[8] = q.y, y[9] = q.z;
    return y;
  }
  Numbers absolute(double tolerance) const { return ode::uniform<double, width>(tolerance); }
  State<double> raw(const double* y) const noexcept {
    State<double> s{unit * Vec3<double>(y[0], y[1], y[2]), {y[3], y[4], y[5]}, {}};
    if constexpr (width == 10) s.attitude = {y[6], y[7], y[8], y[9]};
    return s;
  }
  State<double> state(double, const double* y) const noexcept {
    State<double> s = raw(y);
    s.attitude = normalised(s.attitude);
    return s;
  }
  void operator()(double, const Numbers& y, Numbers& rate) const noexcept {
    const State<double> s = raw(y.data());
    rate = numbers(angular_acceleration<double>(problem, s.angular_velocity, s.down),
                   fixed_vector_rate<double>(s.down, s.angular_velocity),
                   quaternion_rate<double>(s.attitude, s.angular_velocity));
  }
};

/// Problem and start in long double.
std::pair<Problem<long double>, State<long double>> longer(const Problem<double>& problem, const State<double>& start) {
  using To = long double;
  const auto vector = [](const Vec3<double>& v) { return Vec3<To>(v.cast<To>()); };
  const auto made = Problem<To>::make(vector(problem.inertia()), problem.mass(), vector(problem.centre_of_mass()),
                                      problem.gravity(), problem.gradient());
  // with less rounding the bound that double passes may be missed by rounding
  if (!made) raise("DomainError", "the inertia is at the bound of what a body can have: not known in this precision");
  const auto& q = start.attitude;
  return {*made, {vector(start.angular_velocity), vector(start.down), {q.w, q.x, q.y, q.z}}};
}

template <Real Scalar>
State<double> to_double(const State<Scalar>& s) {
  const auto& q = s.attitude;
  return {s.angular_velocity.template cast<double>(),
          s.down.template cast<double>(),
          {double(q.w), double(q.x), double(q.y), double(q.z)}};
}

Data integrate(const Array& inertia, double mass, const Array& centre_of_mass, double gravity, double gradient,
               const std::optional<Array>& angular_velocity, const std::optional<Array>& down,
               const std::optional<Array>& attitude, const Array& at, const std::string& method, int order,
               double tolerance, const std::string& precision, double patience) {
  const Task task = task_of(times(at), method, order, tolerance, precision, patience);
  Question question;
  question.times = task.times;
  const Start given = heavy_start(angular_velocity, down, attitude, {}, question);
  const auto scene = Scene::make(heavy_body(inertia, mass, centre_of_mass, gravity, gradient), given, question);
  if (!scene) raise("DomainError", std::string("start: ") + message(scene.error()));
  const Problem<double>& problem = scene->problem();
  const State<double>& start = scene->start();
  const bool turning = question.wants_attitude;
  Table table = turning ? Table(task.times.size(), {{"angular_velocity", 3}, {"down", 3}, {"attitude", 4}})
                        : Table(task.times.size(), {{"angular_velocity", 3}, {"down", 3}});
  const auto put = [&](std::size_t i, const auto& state_P) {
    const State<double> s = in_axes(scene->R_BP(), to_double(state_P));
    table.put(0, i, s.angular_velocity);
    table.put(1, i, s.down);
    if (turning) table.put(2, i, xyzw(s.attitude));
  };
  if (task.long_double) {
    const auto [body, from] = longer(problem, start);
    const Motion<long double, true> motion{body, from};
    const auto [course, seconds] = timed([&, &motion = motion] { return by_taylor<long_order>(motion, task, put); });
    return std::move(table).data(course, seconds);
  }
  const auto [course, seconds] = timed([&] {
    return turning ? by_name(Motion<double, true>{problem, start}, Plain<10>{problem, start}, task, put)
                   : by_name(Motion<double, false>{problem, start}, Plain<6>{problem, start}, task, put);
  });
  return std::move(table).data(course, seconds);
}

}  // namespace
}  // namespace of_heavy

void bind_heavy_integrators(pybind11::module_& module) {
  using namespace of_heavy;
  module.def("heavy_integrate", &integrate, py::kw_only(), py::arg("inertia"), py::arg("mass"),
             py::arg("centre_of_mass"), py::arg("gravity"), py::arg("gravity_gradient"), py::arg("angular_velocity"),
             py::arg("down"), py::arg("attitude"), py::arg("times"), py::arg("method"), py::arg("order") = 20,
             py::arg("tolerance"), py::arg("precision") = "double", py::arg("patience") = infinity<double>,
             "The full equations under one integrator, timed.");
}
