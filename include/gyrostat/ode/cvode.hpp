// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/result.hpp"
#include "gyrostat/ode/status.hpp"

/// CVODE of SUNDIALS, for independent comparison. Declared here without its headers, defined in the library gyrostat::cvode.
/// It allocates when it is made and inside its steps; nothing here throws.
namespace gyrostat::ode {

enum class CvodeMethod : std::uint8_t {
  adams,  ///< Adams-Moulton, order to 12
  bdf,    ///< backward differentiation, order to 5
};

/// Plain functions over (t, y), `user` handed through. They return whether the value is finite; false ends the integration.
struct CvodeSystem {
  int dimension = 0;
  bool (*rhs)(double t, const double* y, double* rate, void* user) = nullptr;
  /// df/dy, column after column. Without it the Adams corrector iterates by itself and BDF takes differences.
  bool (*jacobian)(double t, const double* y, double* columns, void* user) = nullptr;
  /// Event: a sign change of this number ends a step there.
  double (*event)(double t, const double* y, void* user) = nullptr;
  /// The longest step allowed at y: keeps the integrator from jumping over a singularity.
  double (*step_limit)(double t, const double* y, void* user) = nullptr;
  void* user = nullptr;
};

struct CvodeOptions {
  CvodeMethod method = CvodeMethod::adams;
  double relative = 1e-9;
  double absolute = 1e-12;  ///< in the units of the state, the same for all components
  std::uint64_t step_cap = 10'000'000;
  double longest = infinity<double>;  ///< no step is longer
};

class Cvode {
 public:
  /// Errc::not_positive: a tolerance or the dimension; Errc::not_finite: the start; Errc::out_of_domain: y of another
  /// length than the dimension, or no right-hand side; Errc::unavailable: SUNDIALS refused.
  static Result<Cvode> create(const CvodeSystem& system, double t, std::span<const double> y,
                              const CvodeOptions& options = {}) noexcept;

  Cvode() noexcept;
  Cvode(Cvode&&) noexcept;
  Cvode& operator=(Cvode&&) noexcept;
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode();

  /// One step of its own choice, not beyond t_max. Status::event if the event function changed sign: the time is then the event's.
  Status step(double t_max) noexcept;

  /// Steps until t_end exactly; ends early with the status of whatever came in between.
  Status advance(double t_end) noexcept;

  /// The state at t inside the last step; false outside it.
  bool at(double t, std::span<double> y) const noexcept;

  double time() const noexcept;
  std::span<const double> state() const noexcept;
  Counts counts() const noexcept;

  /// Version of the SUNDIALS library in use, such as "6.4.1".
  static const char* version() noexcept;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace gyrostat::ode
