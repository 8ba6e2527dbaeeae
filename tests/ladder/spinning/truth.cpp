// SPDX-License-Identifier: BSD-3-Clause
#include "truth.hpp"

#include <vector>

#include "../../models/spinning/spinners.hpp"
#include "gyrostat/ladder/spinning/full_motion.hpp"
#include "gyrostat/ladder/spinning/track.hpp"

namespace gyrostat::spinning {

namespace {

State<double> rounded(const State<long double>& s) {
  const auto& q = s.attitude;
  return {s.angular_velocity.cast<double>(),
          {double(s.angles.psi), double(s.angles.phi), double(s.angles.theta)},
          {double(q.w), double(q.x), double(q.y), double(q.z)},
          s.momentum_I.cast<double>(),
          s.velocity.cast<double>(),
          s.position.cast<double>()};
}

}  // namespace

bool true_motion(const Scene& scene, Answer& truth) {
  using Long = long double;
  const auto& asked = scene.question().times;
  const std::vector<Long> times(asked.begin(), asked.end());
  std::vector<State<Long>> states(times.size());
  FullMotionOptions<Long> options;
  options.tolerance = 1e-14L;
  options.step_cap = 200'000;
  const auto made = full_motion<Long>(cast<Long>(scene.problem()), times, states, options);
  if (!made || made->status != ode::Status::reached) return false;
  Track track;
  for (const auto& state : states) track.states.push_back(rounded(state));
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) track.error[i] = double(made->error[i]);
  fill(truth, scene, track);
  for (Column& column : truth.columns) column.error += 4e-16;
  return true;
}

}  // namespace gyrostat::spinning
