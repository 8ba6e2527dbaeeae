// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "gyrostat/core/level.hpp"

namespace gyrostat::ode {

/// How an integration ended.
enum class Status : std::uint8_t {
  reached,         ///< the end time was reached
  event,           ///< an event ended it before the end time
  step_limit,      ///< the cap on steps was hit
  step_underflow,  ///< the step became too small to move the time
  not_finite,      ///< the state or its derivative is NaN or infinite
  cancelled,       ///< the caller asked to stop
};

/// One English sentence an ending, for a message at the edge.
constexpr const char* message(Status status) noexcept {
  switch (status) {
    case Status::reached: return "the end time was reached";
    case Status::event: return "an event ended the integration";
    case Status::step_limit: return "the integrator reached its cap on steps";
    case Status::step_underflow: return "the integrator could not make its step small enough";
    case Status::not_finite: return "the state became NaN or infinite";
    case Status::cancelled: return "the caller cancelled the integration";
  }
  return "unknown status";
}

/// The work of an integration. For a Taylor integrator one right-hand side is one evaluation of all coefficients of a step.
struct Counts {
  std::uint64_t rhs = 0;       ///< evaluations of the right-hand side
  std::uint64_t steps = 0;     ///< accepted steps
  std::uint64_t rejected = 0;  ///< steps computed and thrown away

  constexpr Counts& operator+=(const Counts& other) noexcept {
    rhs += other.rhs;
    steps += other.steps;
    rejected += other.rejected;
    return *this;
  }
};

}  // namespace gyrostat::ode
