// SPDX-License-Identifier: BSD-3-Clause
// Elliptic integrals and functions over flat arrays; gyrostat/elliptic.py broadcasts.
#include "gyrostat/math/elliptic.hpp"

#include <string>

#include "bind.hpp"
#include "convert.hpp"
#include "elliptic_backend.hpp"
#include "gil.hpp"

namespace gyrostat::python {

const EllipticBackend& elliptic_backend(const std::string& name) {
  static constexpr EllipticBackend native = elliptic_functions<math::Native>();
  if (name == "auto" || name == "native") return native;
  if (name != "gsl") raise("DomainError", "elliptic = '" + name + "': unknown; use auto, native or gsl");
  try {
    // the capsule is the module's for as long as Python runs
    const py::capsule capsule = py::module_::import("gyrostat._gsl").attr("backend");
    return *capsule.get_pointer<EllipticBackend>();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) throw;
    raise("DomainError",
          std::string("elliptic = 'gsl': this installation has no GSL: the extension gyrostat._gsl cannot "
                      "be imported (") +
              error.what() +
              "). Install GSL (Debian: apt-get install libgsl-dev) and build the package anew, or use "
              "native");
  }
}

}  // namespace gyrostat::python

namespace {

using namespace gyrostat;
using namespace gyrostat::python;

/// work(n, out) without the GIL: `width` results for each of n arguments.
template <class Work>
py::array_t<double> each(py::ssize_t n, int width, Work&& work) {
  std::vector<double> out(std::size_t(n) * std::size_t(width));
  {
    const Unlocked free;
    work(std::size_t(n), out.data());
  }
  return array(std::move(out), {n, width});
}

/// How many arguments there are: of each as many.
py::ssize_t length_of(std::initializer_list<const Array*> arguments) {
  const py::ssize_t n = (*arguments.begin())->size();
  for (const Array* each : arguments) require_shape("an argument", *each, {n});
  return n;
}

py::array_t<double> complete(const Array& k2, const Array& kp2, const std::string& backend) {
  const EllipticBackend& elliptic = elliptic_backend(backend);
  return each(length_of({&k2, &kp2}), 2,
              [&](std::size_t n, double* out) { elliptic.complete(n, k2.data(), kp2.data(), out); });
}

py::array_t<double> jacobi(const Array& u, const Array& k2, const Array& kp2, const std::string& backend) {
  const EllipticBackend& elliptic = elliptic_backend(backend);
  return each(length_of({&u, &k2, &kp2}), 4,
              [&](std::size_t n, double* out) { elliptic.jacobi(n, u.data(), k2.data(), kp2.data(), out); });
}

py::array_t<double> zeta(const Array& u, const Array& k2, const Array& kp2, const std::string& backend) {
  const EllipticBackend& elliptic = elliptic_backend(backend);
  return each(length_of({&u, &k2, &kp2}), 1,
              [&](std::size_t n, double* out) { elliptic.zeta(n, u.data(), k2.data(), kp2.data(), out); });
}

py::array_t<double> incomplete(const Array& phi, const Array& n, const Array& k2, const Array& kp2,
                               const std::string& backend) {
  const EllipticBackend& elliptic = elliptic_backend(backend);
  return each(length_of({&phi, &n, &k2, &kp2}), 3, [&](std::size_t size, double* out) {
    elliptic.incomplete(size, phi.data(), n.data(), k2.data(), kp2.data(), out);
  });
}

}  // namespace

void bind_elliptic(pybind11::module_& module) {
  module.def("elliptic_complete", &complete, py::arg("k2"), py::arg("kp2"), py::arg("backend"), "(n, 2): K, E.");
  module.def("elliptic_jacobi", &jacobi, py::arg("u"), py::arg("k2"), py::arg("kp2"), py::arg("backend"),
             "(n, 4): sn, cn, dn, am.");
  module.def("elliptic_zeta", &zeta, py::arg("u"), py::arg("k2"), py::arg("kp2"), py::arg("backend"), "(n, 1): Z.");
  module.def("elliptic_incomplete", &incomplete, py::arg("phi"), py::arg("n"), py::arg("k2"), py::arg("kp2"),
             py::arg("backend"), "(n, 3): F, E, Pi.");
}
