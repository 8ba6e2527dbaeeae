// SPDX-License-Identifier: BSD-3-Clause
// The formulas and tables of the paper on heavy bodies about a fixed point, for their reproduction.
#include "gyrostat/models/heavy/published.hpp"

#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "heavy_arguments.hpp"

namespace of_heavy {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
namespace pub = gyrostat::heavy::published;

pub::Reading reading_of(const std::string& name) {
  if (name == "printed") return pub::Reading::printed;
  if (name == "reciprocal") return pub::Reading::reciprocal;
  raise("DomainError", "reading = '" + name + "': use printed or reciprocal");
}

/// One body at the times, of any sign and order.
Data run(const HeavyBodies& body, double spin, double cosine, const std::string& name, const Array& at) {
  if (body.size() != 1) raise("DomainError", "one body is wanted here");
  require_shape("t", at, {-1});
  require_finite("t", at);
  const pub::Reading reading = reading_of(name);
  const heavy::Problem<double>& problem = body.rows().front();
  const auto& I = problem.inertia();
  const double c = problem.pendulum_rate();
  if (!(c > 0) || !(spin > 0) || !(std::abs(cosine) < 1))
    raise("DomainError", "spin = " + text(spin) + ", cos_inclination = " + text(cosine) +
                             ": the paper wants weight, a spin > 0 and a cosine in (-1, 1)");
  const Vec3<double>& centre = problem.centre_of_mass();
  const pub::Data<double> data{I[0] / I[2], I[1] / I[2], problem.gradient() / (c * c), centre / centre.norm(), cosine,
                               c,           spin};
  std::vector<double> rates, down, angles;
  for (py::ssize_t i = 0; i < at.size(); ++i) {
    const double t = at.data()[i];
    const auto v = pub::motion(data, reading, spin * t);
    rates.insert(rates.end(), {c * v[0], c * v[1], spin * v[2]});
    down.insert(down.end(), {v[3], v[4], v[5]});
    const auto turned = pub::angles(data, reading, t);
    angles.insert(angles.end(), turned.begin(), turned.end());
  }
  const auto n = at.size();
  Data made;
  made["angular_velocity"] = array(std::move(rates), {n, 3});
  made["down"] = array(std::move(down), {n, 3});
  made["angles"] = array(std::move(angles), {n, 3});
  made["period"] = (2 * pi<double> + pub::period_correction(data, reading)) / spin;
  return made;
}

/// (31, 5): t and what a table prints, both p2 over its first value.
py::array_t<double> table(int number) {
  if (number != 1 && number != 2) raise("DomainError", "number = " + std::to_string(number) + ": use 1 or 2");
  constexpr int rows = 31;
  std::vector<double> values;
  for (int i = 0; i < rows; ++i) {
    const auto row = number == 1 ? pub::table_1<double>(i) : pub::table_2<double>(i);
    values.insert(values.end(), {row.t, row.p2, row.gamma2, row.p2_rate, row.gamma2_rate});
  }
  return array(std::move(values), {rows, 5});
}

}  // namespace
}  // namespace of_heavy

void bind_heavy_published(pybind11::module_& module) {
  using namespace of_heavy;
  module.def("heavy_published_run", &run, py::arg("body"), py::kw_only(), py::arg("spin"), py::arg("cos_inclination"),
             py::arg("reading"), py::arg("t"),
             "The paper's formulas for one body, mu^-1 = spin/c (printed) or c/spin (reciprocal): rates and down (35), "
             "theta, psi, phi since the start (38), period (36).");
  module.def("heavy_published_table", &table, py::arg("number"),
             "(31, 5) of table 1 or 2 again: t, p2, gamma2 and their rates, those of p2 over its first value.");
}
