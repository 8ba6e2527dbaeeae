// SPDX-License-Identifier: BSD-3-Clause
// The paper's linear example of a gyrostat with a motor of limited power, for
// the reproduction of its figures.
#include "gyrostat/models/rotor/published.hpp"

#include <string>
#include <vector>

#include "bind.hpp"
#include "rotor_arguments.hpp"

namespace of_rotor {
namespace {

using namespace gyrostat;
using namespace gyrostat::python;
namespace pub = gyrostat::rotor::published;

pub::Data<double> data_of(const std::string& reading) {
  if (reading == "printed" || reading == "corrected") return pub::printed_data<double>();
  if (reading == "repaired") return pub::repaired_data<double>();
  if (reading == "realisable") return pub::realisable_data<double>();
  raise("DomainError", "reading = '" + reading + "': use printed, corrected, repaired or realisable");
}

pub::System<double> system_of(const std::string& reading) {
  return reading == "printed" ? pub::printed<double>() : pub::corrected(data_of(reading));
}

/// gamma1, gamma2, beta*' and gamma3 (n, 4) from the paper's start.
py::array_t<double> run(const std::string& reading, const Array& at) {
  const auto system = system_of(reading);
  std::vector<double> rows;
  for (const double t : times(at)) {
    const auto now = system.at(t, pub::printed_start<double>());
    rows.insert(rows.end(), {now.y[0], now.y[1], now.y[2], now.along});
  }
  const auto n = py::ssize_t(rows.size() / 4);
  return array(std::move(rows), {n, 4});
}

/// The matrix (3, 3) of gamma1, gamma2 and beta*'.
py::array_t<double> matrix(const std::string& reading) {
  const Mat3<double> A = system_of(reading).matrix().transpose();
  return array(std::vector<double>(A.data(), A.data() + 9), {3, 3});
}

Data data(const std::string& reading) {
  const auto d = data_of(reading);
  const auto list = [](const Vec3<double>& v) { return array(std::vector<double>{v[0], v[1], v[2]}, {3}); };
  Data made;
  made["inertia"] = list(d.inertia);
  made["axis"] = list(d.axis);
  made["axial_inertia"] = d.axial_inertia;
  made["slope"] = d.slope;
  made["no_load_rate"] = d.no_load_rate;
  made["momentum"] = d.norm;
  made["direction"] = list(d.direction);
  made["spin_rate"] = d.spin_rate;
  return made;
}

}  // namespace
}  // namespace of_rotor

void bind_rotor_published(pybind11::module_& module) {
  using namespace of_rotor;
  module.def("rotor_published_run", &run, py::kw_only(), py::arg("reading"), py::arg("times"),
             "gamma1, gamma2, beta*' and gamma3 (n, 4) of the paper's linear "
             "equations, printed, corrected, repaired or realisable.");
  module.def("rotor_published_matrix", &matrix, py::arg("reading"),
             "Rates (3, 3) of gamma1, gamma2, beta*' by themselves [1/s].");
  module.def("rotor_published_data", &data, py::arg("reading"),
             "The data of a reading; the no-load rate NaN where it was not given.");
}
