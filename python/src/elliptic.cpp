// SPDX-License-Identifier: BSD-3-Clause
// Elliptic integrals and functions over flat arrays; gyrostat/elliptic.py broadcasts.
#include "gyrostat/math/elliptic.hpp"

#include <string>

#include "bind.hpp"
#include "convert.hpp"
#ifdef GYROSTAT_HAVE_GSL
#include "gyrostat/math/gsl.hpp"
#endif

namespace {

using namespace gyrostat;
using namespace gyrostat::python;
using math::Modulus;

/// Calls work<Backend>() without the GIL, for the backend of that name.
template <class Work>
void with_backend(const std::string& name, Work&& work) {
  if (name == "auto" || name == "native") {
    const py::gil_scoped_release free;
    work.template operator()<math::Native>();
    return;
  }
#ifdef GYROSTAT_HAVE_GSL
  if (name == "gsl") {
    const py::gil_scoped_release free;
    work.template operator()<math::Gsl>();
    return;
  }
#endif
  raise("DomainError",
        "elliptic = '" + name + "': " + (name == "gsl" ? "this build has no GSL" : "unknown; use auto, native or gsl"));
}

/// f<Backend>(i, out) fills `width` results of element i.
template <class Function>
py::array_t<double> each(const Array& k2, int width, const std::string& backend, Function&& f) {
  const auto n = k2.size();
  std::vector<double> out(std::size_t(n) * std::size_t(width));
  with_backend(backend, [&]<class Backend>() {
    for (py::ssize_t i = 0; i < n; ++i) f.template operator()<Backend>(i, &out[std::size_t(i) * std::size_t(width)]);
  });
  return array(std::move(out), {n, width});
}

py::array_t<double> complete(const Array& k2, const Array& kp2, const std::string& backend) {
  return each(k2, 2, backend, [&]<class B>(py::ssize_t i, double* out) {
    const auto r = B::complete(Modulus<double>{k2.data()[i], kp2.data()[i]});
    out[0] = r.K;
    out[1] = r.E;
  });
}

py::array_t<double> jacobi(const Array& u, const Array& k2, const Array& kp2, const std::string& backend) {
  return each(k2, 4, backend, [&]<class B>(py::ssize_t i, double* out) {
    const auto r = B::jacobi(u.data()[i], Modulus<double>{k2.data()[i], kp2.data()[i]});
    out[0] = r.sn;
    out[1] = r.cn;
    out[2] = r.dn;
    out[3] = r.am;
  });
}

py::array_t<double> zeta(const Array& u, const Array& k2, const Array& kp2, const std::string& backend) {
  return each(k2, 1, backend, [&]<class B>(py::ssize_t i, double* out) {
    out[0] = B::zeta(u.data()[i], Modulus<double>{k2.data()[i], kp2.data()[i]});
  });
}

py::array_t<double> incomplete(const Array& phi, const Array& n, const Array& k2, const Array& kp2,
                               const std::string& backend) {
  return each(k2, 3, backend, [&]<class B>(py::ssize_t i, double* out) {
    const Modulus<double> m{k2.data()[i], kp2.data()[i]};
    out[0] = B::incomplete_F(phi.data()[i], m);
    out[1] = B::incomplete_E(phi.data()[i], m);
    out[2] = B::incomplete_Pi(phi.data()[i], n.data()[i], m);
  });
}

}  // namespace

void bind_elliptic(py::module_& module) {
  module.def("elliptic_complete", &complete, py::arg("k2"), py::arg("kp2"), py::arg("backend"), "(n, 2): K, E.");
  module.def("elliptic_jacobi", &jacobi, py::arg("u"), py::arg("k2"), py::arg("kp2"), py::arg("backend"),
             "(n, 4): sn, cn, dn, am.");
  module.def("elliptic_zeta", &zeta, py::arg("u"), py::arg("k2"), py::arg("kp2"), py::arg("backend"), "(n, 1): Z.");
  module.def("elliptic_incomplete", &incomplete, py::arg("phi"), py::arg("n"), py::arg("k2"), py::arg("kp2"),
             py::arg("backend"), "(n, 3): F, E, Pi.");
}
