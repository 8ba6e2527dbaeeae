// SPDX-License-Identifier: BSD-3-Clause
#include "gyrostat/ode/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>

static_assert(std::is_same_v<sunrealtype, double>, "gyrostat needs a SUNDIALS built for double");

namespace gyrostat::ode {

struct Cvode::Body {
  CvodeSystem system;
  std::uint64_t step_cap = 0;
  double longest = 0;
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  SUNNonlinearSolver nonlinear = nullptr;
  void* memory = nullptr;
  double time = 0;
  bool not_finite = false;

  Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  ~Body() {
    if (memory != nullptr) CVodeFree(&memory);
    if (nonlinear != nullptr) SUNNonlinSolFree(nonlinear);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    if (y != nullptr) N_VDestroy(y);
    if (context != nullptr) SUNContext_Free(&context);
  }

  /// Remembers a value that is not finite: CVODE ends at once on a negative return.
  int verdict(bool finite) noexcept {
    if (finite) return 0;
    not_finite = true;
    return -1;
  }
};

namespace {

/// SUNDIALS calls back into this; Body is private, so the callbacks are made inside a template that is handed the type.
template <class Body>
struct Callbacks {
  static int rhs(sunrealtype t, N_Vector y, N_Vector rate, void* data) {
    Body& body = *static_cast<Body*>(data);
    return body.verdict(body.system.rhs(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate), body.system.user));
  }
  static int jacobian(sunrealtype t, N_Vector y, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector, N_Vector) {
    Body& body = *static_cast<Body*>(data);
    return body.verdict(body.system.jacobian(t, N_VGetArrayPointer(y), SUNDenseMatrix_Data(matrix), body.system.user));
  }
  static int event(sunrealtype t, N_Vector y, sunrealtype* value, void* data) {
    Body& body = *static_cast<Body*>(data);
    *value = body.system.event(t, N_VGetArrayPointer(y), body.system.user);
    return body.verdict(std::isfinite(*value));
  }
};

/// Failures come back as return values; nothing is printed.
void silence([[maybe_unused]] void* memory, [[maybe_unused]] SUNContext context) noexcept {
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_ClearErrHandlers(context);
#else
  CVodeSetErrFile(memory, nullptr);
#endif
}

bool create_context(SUNContext* context) noexcept {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context) == 0;
#else
  return SUNContext_Create(nullptr, context) == 0;
#endif
}

}  // namespace

Cvode::Cvode() noexcept = default;
Cvode::Cvode(Cvode&&) noexcept = default;
Cvode& Cvode::operator=(Cvode&&) noexcept = default;
Cvode::~Cvode() = default;

Result<Cvode> Cvode::create(const CvodeSystem& system, double t, std::span<const double> y,
                            const CvodeOptions& options) noexcept {
  if (system.dimension <= 0 || !(options.relative > 0) || !(options.absolute > 0)) return Errc::not_positive;
  const auto n = static_cast<std::size_t>(system.dimension);
  if (y.size() != n || system.rhs == nullptr) return Errc::out_of_domain;
  if (!std::isfinite(t) || !std::all_of(y.begin(), y.end(), [](double x) { return std::isfinite(x); })) {
    return Errc::not_finite;
  }

  Cvode made;
  made.body_.reset(new (std::nothrow) Body);
  if (!made.body_) return Errc::unavailable;
  Body& body = *made.body_;
  body.system = system;
  body.step_cap = options.step_cap;
  body.longest = options.longest;
  body.time = t;
  if (!create_context(&body.context)) return Errc::unavailable;
  body.y = N_VNew_Serial(system.dimension, body.context);
  if (body.y == nullptr) return Errc::unavailable;
  std::copy(y.begin(), y.end(), N_VGetArrayPointer(body.y));
  body.memory = CVodeCreate(options.method == CvodeMethod::adams ? CV_ADAMS : CV_BDF, body.context);
  if (body.memory == nullptr) return Errc::unavailable;
  silence(body.memory, body.context);

  using Call = Callbacks<Body>;
  bool ok = CVodeInit(body.memory, Call::rhs, t, body.y) == CV_SUCCESS &&
            CVodeSStolerances(body.memory, options.relative, options.absolute) == CV_SUCCESS &&
            CVodeSetUserData(body.memory, &body) == CV_SUCCESS && CVodeSetMaxNumSteps(body.memory, -1) == CV_SUCCESS &&
            CVodeSetMaxHnilWarns(body.memory, -1) == CV_SUCCESS &&
            CVodeSetMaxStep(body.memory, std::isfinite(options.longest) ? options.longest : 0.0) == CV_SUCCESS;
  if (ok && system.event != nullptr) ok = CVodeRootInit(body.memory, 1, Call::event) == CV_SUCCESS;
  if (ok && system.jacobian == nullptr && options.method == CvodeMethod::adams) {
    body.nonlinear = SUNNonlinSol_FixedPoint(body.y, 0, body.context);
    ok = body.nonlinear != nullptr && CVodeSetNonlinearSolver(body.memory, body.nonlinear) == CV_SUCCESS;
  } else if (ok) {
    body.matrix = SUNDenseMatrix(system.dimension, system.dimension, body.context);
    body.linear = body.matrix != nullptr ? SUNLinSol_Dense(body.y, body.matrix, body.context) : nullptr;
    ok = body.linear != nullptr && CVodeSetLinearSolver(body.memory, body.linear, body.matrix) == CV_SUCCESS &&
         (system.jacobian == nullptr || CVodeSetJacFn(body.memory, Call::jacobian) == CV_SUCCESS);
  }
  if (!ok) return Errc::unavailable;
  return made;
}

Status Cvode::step(double t_max) noexcept {
  if (!body_ || !(t_max == t_max)) return Status::not_finite;
  Body& body = *body_;
  if (!(body.time < t_max)) return Status::reached;
  if (counts().steps >= body.step_cap) return Status::step_limit;
  if (body.system.step_limit != nullptr) {
    const double limit = body.system.step_limit(body.time, N_VGetArrayPointer(body.y), body.system.user);
    if (!(limit > 0)) return limit == 0 ? Status::step_underflow : Status::not_finite;
    // 0 stands for no limit
    const double longest = std::min(limit, body.longest);
    CVodeSetMaxStep(body.memory, std::isfinite(longest) ? longest : 0.0);
  }
  if (std::isfinite(t_max)) {
    CVodeSetStopTime(body.memory, t_max);
  } else {
    t_max = body.time + std::max(1.0, std::abs(body.time));  // only its direction counts
  }
  const int flag = CVode(body.memory, t_max, body.y, &body.time, CV_ONE_STEP);
  switch (flag) {
    case CV_SUCCESS:
    case CV_TSTOP_RETURN: break;
    case CV_ROOT_RETURN: return Status::event;
    case CV_TOO_MUCH_WORK: return Status::step_limit;
    default: return body.not_finite ? Status::not_finite : Status::step_underflow;
  }
  const double* y = N_VGetArrayPointer(body.y);
  return std::all_of(y, y + body.system.dimension, [](double x) { return std::isfinite(x); }) ? Status::reached
                                                                                              : Status::not_finite;
}

Status Cvode::advance(double t_end) noexcept {
  Status status = Status::reached;
  while (status == Status::reached && !(time() >= t_end)) status = step(t_end);
  return status;
}

bool Cvode::at(double t, std::span<double> y) const noexcept {
  if (!body_ || y.size() != static_cast<std::size_t>(body_->system.dimension)) return false;
  N_Vector out = N_VMake_Serial(body_->system.dimension, y.data(), body_->context);
  if (out == nullptr) return false;
  const int flag = CVodeGetDky(body_->memory, t, 0, out);
  N_VDestroy(out);
  return flag == CV_SUCCESS;
}

double Cvode::time() const noexcept { return body_ ? body_->time : 0.0; }

std::span<const double> Cvode::state() const noexcept {
  if (!body_) return {};
  return {N_VGetArrayPointer(body_->y), static_cast<std::size_t>(body_->system.dimension)};
}

Counts Cvode::counts() const noexcept {
  Counts counts;
  if (!body_) return counts;
  long steps = 0, rhs = 0, failures = 0, corrector_failures = 0;
  CVodeGetNumSteps(body_->memory, &steps);
  CVodeGetNumRhsEvals(body_->memory, &rhs);
  CVodeGetNumErrTestFails(body_->memory, &failures);
  CVodeGetNumNonlinSolvConvFails(body_->memory, &corrector_failures);
  counts.steps = static_cast<std::uint64_t>(steps);
  counts.rhs = static_cast<std::uint64_t>(rhs);
  counts.rejected = static_cast<std::uint64_t>(failures + corrector_failures);
  return counts;
}

const char* Cvode::version() noexcept {
  struct Text {
    char text[32] = "unknown";
    Text() noexcept { SUNDIALSGetVersion(text, sizeof text); }
  };
  static const Text version;
  return version.text;
}

}  // namespace gyrostat::ode
