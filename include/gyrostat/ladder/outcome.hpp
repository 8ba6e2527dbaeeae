// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "gyrostat/core/result.hpp"
#include "gyrostat/ladder/answer.hpp"

namespace gyrostat::inline GYROSTAT_LEVEL {

/// What every rung says in addition to the motion itself.
struct Outcome {
  std::vector<Warning> warnings;
  ode::Counts counts;
  Errc failure = Errc::ok;           ///< why there is no motion
  const char* refusal = nullptr;     ///< why the rung cannot answer, in words; nullptr where only known_error decided
  double known_error = nan<double>;  ///< the error seen before the rung gave up
  bool in_domain = true;             ///< false: computed outside the rung's domain, the errors are not to be trusted

  /// Adds a warning, once a code; `text` says more of this case than that of the kind.
  void warn(const WarningKind& kind, double value = nan<double>, const char* text = nullptr) {
    for (const Warning& w : warnings)
      if (w.kind == &kind) return;
    warnings.push_back({&kind, text ? text : kind.text, value});
  }
};

/// Why an integration that ended so gives no motion; ok where it reached its end.
constexpr Errc failure_of(ode::Status status) noexcept {
  switch (status) {
    case ode::Status::reached: return Errc::ok;
    case ode::Status::cancelled: return Errc::cancelled;
    case ode::Status::step_limit: return Errc::step_limit;
    default: return Errc::no_convergence;
  }
}

/// The outcome of a rung that cannot answer.
template <class Track>
Track refused(Errc code, const char* why) {
  Track track;
  track.failure = code;
  track.refusal = why;
  return track;
}

/// The outcome of a rung whose error is over the tolerance already before the motion is computed.
template <class Track>
Track over_tolerance(double error) {
  Track track = refused<Track>(Errc::not_applicable, nullptr);
  track.known_error = error;
  return track;
}

}  // namespace gyrostat::inline GYROSTAT_LEVEL
