// SPDX-License-Identifier: BSD-3-Clause
// The extension module gyrostat._gsl: the elliptic functions of GSL, for the core that asks for them by name.
// The binary links GSL and is GPL.
#include "gyrostat/math/gsl.hpp"

#include <gsl/gsl_version.h>
#include <pybind11/pybind11.h>

#include "../elliptic_backend.hpp"
#include "gyrostat/ladder/deceleration/solve_definition.hpp"

PYBIND11_MODULE(_gsl, module, pybind11::mod_gil_not_used()) {
  using gyrostat::python::EllipticBackend;
  static constexpr EllipticBackend backend = gyrostat::python::elliptic_functions<gyrostat::math::Gsl>();
  module.doc() = "Elliptic functions of the GNU Scientific Library. This extension is under the GPL.";
  module.attr("version") = GSL_VERSION;
  module.attr("backend") = pybind11::capsule(&backend, EllipticBackend::capsule);
}
