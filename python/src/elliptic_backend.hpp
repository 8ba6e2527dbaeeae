// SPDX-License-Identifier: BSD-3-Clause
// The elliptic functions as the bindings call them, whoever computes them.
#pragma once

#include <cstddef>
#include <string>

#include "gyrostat/ladder/deceleration/solve.hpp"

namespace gyrostat::python {

/// Functions over n arguments, and the ladder that calls these elliptic functions. The core has the native ones; the
/// extension gyrostat._gsl hands out GSL's, so that the core itself needs no GSL.
struct EllipticBackend {
  /// Name of the capsule that an extension hands out as `backend`: a layout of another version is refused by its name.
  static constexpr const char* capsule = "gyrostat.EllipticBackend 0.1";

  void (*complete)(std::size_t n, const double* k2, const double* kp2, double* K_E);
  void (*jacobi)(std::size_t n, const double* u, const double* k2, const double* kp2, double* sn_cn_dn_am);
  void (*zeta)(std::size_t n, const double* u, const double* k2, const double* kp2, double* Z);
  void (*incomplete)(std::size_t n, const double* phi, const double* characteristic, const double* k2,
                     const double* kp2, double* F_E_Pi);
  Answer (*decelerate)(const deceleration::Scene&, Refusal&, Monitor*);
};

/// The functions of one supplier, math::Native or math::Gsl.
template <class Elliptic>
constexpr EllipticBackend elliptic_functions() noexcept {
  using Modulus = math::Modulus<double>;
  return {.complete =
              [](std::size_t n, const double* k2, const double* kp2, double* out) {
                for (std::size_t i = 0; i < n; ++i) {
                  const auto integral = Elliptic::complete(Modulus{k2[i], kp2[i]});
                  *out++ = integral.K, *out++ = integral.E;
                }
              },
          .jacobi =
              [](std::size_t n, const double* u, const double* k2, const double* kp2, double* out) {
                for (std::size_t i = 0; i < n; ++i) {
                  const auto f = Elliptic::jacobi(u[i], Modulus{k2[i], kp2[i]});
                  *out++ = f.sn, *out++ = f.cn, *out++ = f.dn, *out++ = f.am;
                }
              },
          .zeta =
              [](std::size_t n, const double* u, const double* k2, const double* kp2, double* out) {
                for (std::size_t i = 0; i < n; ++i) out[i] = Elliptic::zeta(u[i], Modulus{k2[i], kp2[i]});
              },
          .incomplete =
              [](std::size_t n, const double* phi, const double* characteristic, const double* k2, const double* kp2,
                 double* out) {
                for (std::size_t i = 0; i < n; ++i) {
                  const Modulus m{k2[i], kp2[i]};
                  *out++ = Elliptic::incomplete_F(phi[i], m);
                  *out++ = Elliptic::incomplete_E(phi[i], m);
                  *out++ = Elliptic::incomplete_Pi(phi[i], characteristic[i], m);
                }
              },
          .decelerate = &deceleration::solve<Elliptic>};
}

/// The functions that `elliptic` names: auto, native or gsl. Raises DomainError for another name, and where gyrostat._gsl
/// cannot be imported. Needs the GIL.
const EllipticBackend& elliptic_backend(const std::string& name);

}  // namespace gyrostat::python
