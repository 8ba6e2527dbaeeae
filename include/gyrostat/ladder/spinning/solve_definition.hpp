// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "gyrostat/ladder/spinning/full_rung.hpp"
#include "gyrostat/ladder/spinning/linear_rung.hpp"
#include "gyrostat/ladder/spinning/picard_rung.hpp"
#include "gyrostat/ladder/spinning/second_order_rung.hpp"
#include "gyrostat/ladder/spinning/solve.hpp"
#include "gyrostat/models/spinning/pointing.hpp"

namespace gyrostat::spinning {

namespace detail {

/// Greatest angle between body axis 3 and inertial axis 3, rad.
inline double greatest_tilt(const Column& attitude) noexcept {
  double most = 0;
  for (std::size_t i = 0; i + 3 < attitude.values.size(); i += 4) {
    const double* q = attitude.values.data() + i;
    most = std::max(most, 2 * std::atan2(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])));
  }
  return most;
}

/// Numbers and warnings that belong to the scene, whichever rung answers.
inline void describe(Answer& answer, const Scene& scene) {
  const Problem<double>& problem = scene.problem();
  const double nu2 = problem.nutation_squared(), r0 = problem.spin();
  double mean = nan<double>;
  math::Complex<double> ratio{nan<double>, nan<double>};
  if (problem.torque[2] == 0 && nu2 > 0 && r0 * problem.effective_momentum() != 0) {
    mean = pointing_error(problem);
    ratio = secular_velocity_ratio(problem);
  }
  answer.quantities.push_back({"pointing_error", 1, {mean}});
  answer.quantities.push_back({"secular_velocity_ratio", 2, {ratio.re, ratio.im}});
  answer.quantities.push_back({"tilt_max", 1, {greatest_tilt(*answer.find("attitude"))}});
  answer.quantities.push_back({"nutation_frequency_squared", 1, {nu2}});

  const auto warn = [&](const char* code, const char* text, double value) {
    answer.warnings.push_back({code, text, value});
  };
  const SpinFlags flags = spin_flags(problem);
  if (r0 == 0) warn("no-spin", "the body does not spin at the start: nothing holds its direction", nan<double>);
  else if (flags.compliant)
    warn("no-stiffness", "D3 r0 + lambda3 - e_H is near 0: next to no gyroscopic stiffness; it is, N m s",
         problem.effective_momentum());
  else if (flags.resonant)
    warn("resonance", "spin and nutation are near resonance: the tilt grows over many turns; they differ by, 1/s",
         divisors(problem).difference);
  if (flags.unstable) warn("unstable-spin", "nu^2 <= 0: the transverse rates grow; nu^2, 1/s^2", nu2);
  if (const double stop = -r0 * problem.inertia[2] / problem.torque[2];
      stop > 0 && stop < scene.question().times.back())
    warn("spin-reversal", "the axial torque takes the spin through zero at about, s", stop);
}

}  // namespace detail

GYROSTAT_COMPILED_ONCE Answer solve(const Scene& scene, Refusal& refusal, Monitor* monitor) {
  static constexpr std::array<Rung<Scene, Track>, 4> rungs{{{"linear", &linear_track},
                                                            {"second-order", &second_order_track},
                                                            {"picard", &picard_track},
                                                            {"full", &full_track}}};
  const int only = int(scene.question().model) - 1;
  Answer answer = climb<Scene, Track>(rungs, scene, scene.question().tolerance, only, monitor, refusal);
  if (refusal.code == Errc::ok) detail::describe(answer, scene);
  return answer;
}

}  // namespace gyrostat::spinning
