// SPDX-License-Identifier: BSD-3-Clause
// The ladder of the spinning family, and its closed form over rows; gyrostat/spinning.py wraps both.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "bind.hpp"
#include "gil.hpp"
#include "gyrostat/ladder/spinning/motion.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/models/spinning/a_priori.hpp"
#include "gyrostat/models/spinning/linear.hpp"
#include "gyrostat/models/spinning/linear_grid.hpp"
#include "gyrostat/models/spinning/pointing.hpp"
#include "question_arguments.hpp"
#include "spinning_arguments.hpp"
#ifdef GYROSTAT_HAVE_CVODE
#include "gyrostat/ladder/spinning/cvode_motion.hpp"
#endif

template <>
decltype(gyrostat::spinning::Scene::full_equations) gyrostat::python::by_cvode<gyrostat::spinning::Scene>() noexcept {
#ifdef GYROSTAT_HAVE_CVODE
  return &spinning::full_by_cvode;
#else
  return nullptr;
#endif
}

namespace of_spinning {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using namespace gyrostat::spinning;

Data solve_scene(const SpinningProblems& problems, const Array& at, double tolerance, const std::string& model,
                 const std::string& integrator, const std::optional<std::shared_ptr<Monitor>>& monitor,
                 const Ask& ask) {
  Question question = question_of(tables, at, tolerance, model, ask);
  const bool cvode = takes_cvode(tables, integrator, question);
  Scene scene = checked(Scene::make(problems.single(), question));
  if (cvode) scene.full_equations = by_cvode<Scene>();

  Refusal refusal;
  auto [answer, seconds] = watched(monitor, [&](Monitor* by) { return solve(scene, refusal, by); });
  require_answer(refusal);
  return to_python(answer, scene.question(), tables, seconds);
}

/// The linear motion of every row at the times (n,), any sign and order, and its a-priori errors until the farthest of them.
Data linear_rows(const SpinningProblems& problems, const Array& at) {
  require_shape("t", at, {-1});
  require_finite("t", at);
  problems.require_constant_spin();
  const std::size_t rows = problems.rows().size(), n = std::size_t(at.size());
  std::vector<double> rates(rows * n * 3), angles(rates.size()), momentum(rates.size()), velocity(rates.size()),
      position(rates.size()), attitude(rows * n * 4);
  constexpr std::size_t measures = 13;
  std::vector<double> errors(rows * measures, 0.0);
  {
    const Unlocked free;
    double span = 0;
    for (std::size_t i = 0; i < n; ++i) span = std::max(span, std::abs(at.data()[i]));
    for (std::size_t row = 0; row < rows; ++row) {
      const Linear<double> motion(problems.rows()[row]);
      for (std::size_t i = 0; i < n; ++i) {
        const State<double> s = motion.at(at.data()[i]);
        const std::size_t place = row * n + i;
        const Vec3<double> tilt(s.angles.psi, s.angles.phi, s.angles.theta);
        const double q[] = {s.attitude.x, s.attitude.y, s.attitude.z, s.attitude.w};
        for (int j = 0; j < 3; ++j) {
          rates[3 * place + std::size_t(j)] = s.angular_velocity[j];
          angles[3 * place + std::size_t(j)] = tilt[j];
          momentum[3 * place + std::size_t(j)] = s.momentum_I[j];
          velocity[3 * place + std::size_t(j)] = s.velocity[j];
          position[3 * place + std::size_t(j)] = s.position[j];
        }
        for (std::size_t j = 0; j < 4; ++j) attitude[4 * place + j] = q[j];
      }
      if (!(span > 0)) continue;
      const LinearErrors<double> e = linear_errors(problems.rows()[row], span);
      const double numbers[measures] = {e.rates,          e.spin,           e.tilt,     e.theta,          e.attitude,
                                        e.momentum,       e.axial_momentum, e.velocity, e.axial_velocity, e.position,
                                        e.axial_position, e.size.tilt,      e.size.rate};
      std::copy(numbers, numbers + measures, &errors[row * measures]);
    }
  }
  const auto r = py::ssize_t(rows), m = py::ssize_t(n);
  Data made;
  made["angular_velocity"] = array(std::move(rates), {r, m, 3});
  made["euler_312"] = array(std::move(angles), {r, m, 3});
  made["attitude"] = array(std::move(attitude), {r, m, 4});
  made["angular_momentum_inertial"] = array(std::move(momentum), {r, m, 3});
  made["velocity"] = array(std::move(velocity), {r, m, 3});
  made["position"] = array(std::move(position), {r, m, 3});
  made["error"] = array(std::move(errors), {r, py::ssize_t(measures)});
  return made;
}

/// (14, rows, points): p, q, psi, phi, theta, G1, G2, G3, v1, v2, v3, x1, x2, x3 at start + i step.
py::array_t<double> linear_grid_rows(const SpinningProblems& problems, double start, double step, std::size_t points) {
  problems.require_constant_spin();
  const std::size_t rows = problems.rows().size(), all = rows * points;
  py::array_t<double> out({py::ssize_t(14), py::ssize_t(rows), py::ssize_t(points)});
  double* const first = out.mutable_data();
  {
    const Unlocked free;
    for (std::size_t row = 0; row < rows; ++row) {
      const auto column = [&](std::size_t i) { return first + i * all + row * points; };
      const GridColumns<double> columns{column(0),  column(1),  column(2),  column(3), column(4),
                                        column(5),  column(6),  column(8),  column(9), column(10),
                                        column(11), column(12), column(13), column(7)};
      LinearGrid<double>(problems.rows()[row], start, step, points).write(0, points, columns);
    }
  }
  return out;
}

/// (rows, 9): pointing error, secular velocity ratio (2), mean tilt (2), nu^2, unstable, resonant, compliant.
py::array_t<double> pointing_rows(const SpinningProblems& problems) {
  constexpr std::size_t width = 9;
  std::vector<double> out(problems.rows().size() * width);
  {
    const Unlocked free;
    for (std::size_t row = 0; row < problems.rows().size(); ++row) {
      const auto& problem = problems.rows()[row];
      const SpinFlags flags = spin_flags(problem);
      // what grows has no mean; a spinner that nothing drives has, however it stands
      const bool has_mean = !flags.unstable;
      const math::Complex<double> none{gyrostat::nan<double>, gyrostat::nan<double>};
      const auto ratio = has_mean ? secular_velocity_ratio(problem) : none;
      auto tilt = has_mean ? mean_tilt(problem) : none;
      if (!std::isfinite(tilt.re) || !std::isfinite(tilt.im)) tilt = none;
      const double numbers[width] = {has_mean ? pointing_error(problem) : gyrostat::infinity<double>,
                                     ratio.re,
                                     ratio.im,
                                     tilt.re,
                                     tilt.im,
                                     problem.nutation_squared(),
                                     double(flags.unstable),
                                     double(flags.resonant),
                                     double(flags.compliant)};
      std::copy(numbers, numbers + width, &out[row * width]);
    }
  }
  return array(std::move(out), {py::ssize_t(problems.rows().size()), py::ssize_t(width)});
}

}  // namespace
}  // namespace of_spinning

void bind_spinning(pybind11::module_& module) {
  using namespace of_spinning;
  py::class_<SpinningProblems>(module, "SpinningProblems", "Rows of spinning, thrusting bodies, checked.")
      .def(py::init<const Array&, const Array&, const Array&, const Array&, const Array&, const Array&, const Array&,
                    const Array&, const Array&, const Array&>(),
           py::kw_only(), py::arg("inertia"), py::arg("mass"), py::arg("rotor_momentum"), py::arg("charge_momentum"),
           py::arg("torque"), py::arg("force"), py::arg("angular_velocity"), py::arg("euler_312"), py::arg("velocity"),
           py::arg("position"))
      .def("__len__", [](const SpinningProblems& problems) { return problems.rows().size(); });
  module.def("spinning_solve", &solve_scene, py::arg("problem"), py::kw_only(), py::arg("times"), py::arg("tolerance"),
             py::arg("model"), py::arg("integrator"), py::arg("monitor"), py::arg("ask") = py::none(),
             "Answer of the ladder as plain data.");
  module.def("spinning_linear", &linear_rows, py::arg("problems"), py::arg("t"),
             "The linear motion of every row at the times.");
  module.def("spinning_linear_grid", &linear_grid_rows, py::arg("problems"), py::arg("start"), py::arg("step"),
             py::arg("points"), "(14, rows, points): p, q, psi, phi, theta, G1, G2, G3, v1, v2, v3, x1, x2, x3.");
  module.def(
      "spinning_pointing", &pointing_rows, py::arg("problems"),
      "(rows, 9): pointing error, secular velocity ratio (2), mean tilt (2), nu^2, unstable, resonant, compliant.");
}
