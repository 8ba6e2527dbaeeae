// SPDX-License-Identifier: BSD-3-Clause
// The closed forms of the paper on the spinning body, for the reproduction of its figures.
#include "gyrostat/models/spinning/published.hpp"

#include <string>
#include <vector>

#include "bind.hpp"
#include "spinning_arguments.hpp"

namespace of_spinning {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
namespace pub = gyrostat::spinning::published;

pub::Reading reading_of(const std::string& name) {
  if (name == "printed") return pub::Reading::printed;
  if (name == "corrected") return pub::Reading::corrected;
  if (name == "exact") return pub::Reading::exact;
  raise("DomainError", "reading = '" + name + "': use printed, corrected or exact");
}

/// The motion of one body at the times, any sign and order, and what the paper says of it for long times.
Data run(const SpinningProblems& problems, const std::string& name, const Array& at) {
  require_shape("t", at, {-1});
  require_finite("t", at);
  problems.require_constant_spin();
  const auto& problem = problems.single();
  const pub::Reading reading = reading_of(name);
  const pub::Motion<double> motion(problem, reading);
  const auto n = at.size();
  std::vector<double> rates, tilt, spin_angle, momentum, circle, velocity, position;
  for (py::ssize_t i = 0; i < n; ++i) {
    const auto y = motion.at(at.data()[i]);
    const auto pair = [](std::vector<double>& to, math::Complex<double> z) { to.insert(to.end(), {z.re, z.im}); };
    pair(rates, y.rates);
    pair(tilt, y.tilt);
    spin_angle.push_back(y.spin_angle);
    pair(momentum, y.momentum);
    pair(circle, y.circle);
    velocity.insert(velocity.end(), {y.velocity.re, y.velocity.im, y.axial_velocity});
    position.insert(position.end(), {y.position.re, y.position.im, y.axial_position});
  }
  const auto ratio = pub::secular_velocity_ratio(problem, reading);
  const auto path = pub::momentum_circle(problem, reading);
  Data made;
  made["rates"] = array(std::move(rates), {n, 2});
  made["tilt"] = array(std::move(tilt), {n, 2});
  made["spin_angle"] = array(std::move(spin_angle), {n});
  made["momentum"] = array(std::move(momentum), {n, 2});
  made["circle"] = array(std::move(circle), {n, 2});
  made["velocity"] = array(std::move(velocity), {n, 3});
  made["position"] = array(std::move(position), {n, 3});
  made["nutation"] = motion.nutation();
  made["secular_velocity_ratio"] = array(std::vector<double>{ratio.re, ratio.im}, {2});
  made["circle_centre"] = array(std::vector<double>{path.centre.re, path.centre.im}, {2});
  made["circle_radius"] = path.radius;
  return made;
}

}  // namespace
}  // namespace of_spinning

void bind_spinning_published(pybind11::module_& module) {
  using namespace of_spinning;
  module.def(
      "spinning_published", &run, py::arg("problem"), py::kw_only(), py::arg("reading"), py::arg("t"),
      "The paper's closed forms for one body, printed, corrected or exact: rates p, q (22), tilt psi, phi (20), spin "
      "angle (16), momentum G (33), circle G (35), velocity (43), (47), position (58), (63); nutation [rad/s], "
      "secular_velocity_ratio (53), (54), and centre and radius of the circle of G [N m s].");
}
