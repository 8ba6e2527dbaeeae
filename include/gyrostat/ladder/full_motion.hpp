// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gyrostat/core/real.hpp"
#include "gyrostat/core/times.hpp"
#include "gyrostat/ladder/errors.hpp"
#include "gyrostat/ladder/monitor.hpp"
#include "gyrostat/ode/status.hpp"

/// What the full equations of every family take and give.
namespace gyrostat::inline GYROSTAT_LEVEL {

/// Steps that one run of the full equations may take: some ten seconds.
inline constexpr std::uint64_t step_budget = 10'000'000;

/// Why an integration of the full equations that ended so gives no motion, and what to do.
constexpr const char* why_stopped(ode::Status status) noexcept {
  switch (status) {
    case ode::Status::step_limit:
      return "the budget of 10 million steps does not reach the last time: ask for a shorter span or a looser "
             "tolerance";
    case ode::Status::step_underflow:
      return "the steps became too short for the digits of the time, as where a momentum that a torque opposes passes "
             "through zero: ask for times before that";
    case ode::Status::cancelled: return "the caller stopped the work";
    default: return ode::message(status);
  }
}

/// Angle that is followed even where rounding of the phase alone is over the tolerance, rad: it costs a second, and the answer
/// says what it is worth.
inline constexpr double costly_angle = 1e6;

/// Angle, rad, that the budget of steps does not reach.
inline constexpr double unreachable_angle = 2e7;

/// Whether a motion turns through so large an angle, rad, that no double can hold its phase to the tolerance.
constexpr bool phase_too_long(double angle, double tolerance) noexcept {
  return angle > costly_angle && epsilon<double> * angle > tolerance;
}
inline constexpr const char* phase_lost =
    "the body turns so often that rounding of its phase alone, 2e-16 of the angle turned through, is over the "
    "tolerance: ask for a shorter span or a looser tolerance";

/// What a run of the full equations hands back beside the states.
template <std::size_t columns, Real Scalar>
struct MotionOutcome {
  ode::Status status = ode::Status::reached;
  bool met = false;  ///< status is reached and no estimated error exceeds the tolerance
  /// Estimated greatest errors over the times, each as its column measures it.
  Errors<columns, Scalar> error;
  ode::Counts counts;         ///< of all runs, the companions' included
  Scalar step_tolerance = 0;  ///< of the steps that gave the answer
};

/// How the full equations are to be solved.
template <Real Scalar>
struct MotionOptions {
  Scalar tolerance = Scalar(1e-9L);  ///< greatest error wanted in any column
  /// The same of each column, infinite where nobody asks; empty: `tolerance` for all.
  std::span<const double> wanted{};
  std::uint64_t step_cap = step_budget;
  Monitor* monitor = nullptr;  ///< who watches, if anybody

  /// The greatest error over its tolerance; NaN if one is.
  template <std::size_t columns>
  Scalar excess(const MotionOutcome<columns, Scalar>& outcome) const noexcept {
    const auto& error = outcome.error;
    if (wanted.empty()) return error.greatest() / tolerance;
    Scalar most = 0;
    for (std::size_t i = 0; i < columns; ++i)
      if (wanted[i] < infinity<double>) most = greater(over(error[i], static_cast<Scalar>(wanted[i])), most);
    return most;
  }
  void report(double done) const noexcept {
    if (monitor != nullptr) monitor->fraction.store(std::min(done, 1.0), std::memory_order_relaxed);
  }
  bool cancelled() const noexcept { return monitor != nullptr && monitor->cancelled(); }

  /// Whether a motion can be asked for so, at these times, s, with room for so many states, compared by so many columns. Errc::out_of_domain: as
  /// many states as times are wanted, and none or as many tolerances as columns; what check_span() finds; not_finite and negative (tolerance).
  Errc check(std::span<const Scalar> times, std::size_t states, std::size_t columns) const noexcept {
    if (states != times.size() || !(wanted.empty() || wanted.size() == columns)) return Errc::out_of_domain;
    if (const Errc wrong = check_span(times); wrong != Errc::ok) return wrong;
    if (!(tolerance == tolerance)) return Errc::not_finite;
    return tolerance < 0 ? Errc::negative : Errc::ok;
  }
};

}  // namespace gyrostat::inline GYROSTAT_LEVEL
