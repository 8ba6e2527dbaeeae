// SPDX-License-Identifier: BSD-3-Clause
#include "truth.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gyrostat/ladder/rotor/full_motion.hpp"
#include "gyrostat/ladder/rotor/track.hpp"

namespace gyrostat::rotor {

bool true_motion(const Scene& scene, Answer& truth, Integrator integrator) {
  using Long = long double;
  const auto& b = scene.gyrostat();
  const Start& given = scene.given();
  const auto body = Gyrostat<Long>::make(b.inertia().cast<Long>(), b.axis().cast<Long>(), b.axial_inertia(), b.slope(),
                                         b.no_load_rate());
  if (!body) return false;
  const Quat<Long> q{given.attitude.w, given.attitude.x, given.attitude.y, given.attitude.z};
  State<Long> start = body->state(normalised(q), given.angular_velocity.cast<Long>(), given.rotor_rate);
  if (scene.start().momentum.isZero(0)) start.momentum.setZero();  // what is zero to the rounding of the data
  const std::vector<Long> times(scene.question().times.begin(), scene.question().times.end());
  std::vector<State<Long>> states(times.size());
  FullMotionOptions<Long> options;
  options.tolerance = 1e-15L;
  options.integrator = integrator;
  options.step_cap = 2'000'000;
  const auto made = full_motion<Long>(*body, start, times, states, options);
  if (!made || made->status != ode::Status::reached) return false;
  Track track;
  for (const auto& s : states)
    track.states.push_back({{double(s.attitude.w), double(s.attitude.x), double(s.attitude.y), double(s.attitude.z)},
                            s.momentum.cast<double>(),
                            double(s.axial_momentum),
                            double(s.rotor_angle)});
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) track.error[i] = double(made->error[i]);
  fill(truth, scene, track);
  for (Column& column : truth.columns) column.error += 4e-16;
  return true;
}

}  // namespace gyrostat::rotor
