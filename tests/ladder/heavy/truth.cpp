// SPDX-License-Identifier: BSD-3-Clause
#include "truth.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/periodic_motion.hpp"
#include "gyrostat/ladder/heavy/track.hpp"

namespace gyrostat::heavy {

bool true_motion(const Scene& scene, Answer& truth) {
  using Long = long double;
  const auto& p = scene.problem();
  const auto problem = Problem<Long>::make(p.inertia().cast<Long>(), p.mass(), p.centre_of_mass().cast<Long>(),
                                           p.gravity(), p.gradient());
  if (!problem) return false;
  const auto& asked = scene.question().times;
  const std::vector<Long> times(asked.begin(), asked.end());
  std::vector<State<Long>> states(times.size());
  FullMotionOptions<Long> options;
  options.tolerance = 1e-14L;
  options.step_cap = 2'000'000;
  options.attitude = scene.question().wants_attitude;
  ColumnErrors<Long> error;
  Track track;
  if (scene.periodic()) {
    const auto& [spin, cosine] = *scene.periodic();
    const auto orbit = periodic_orbit<Long>(*problem, spin, cosine);
    // What does not close to rounding, its growth allowed for, is not found yet, and no reference: where the monodromy is singular (motions
    // that are not isolated, a lamina) a small closure says little of the start.
    if (!orbit) return false;
    if (!(orbit->closure < 1e-15L * std::max(1.0L, std::abs(orbit->trace_minus_4)))) return false;
    const PeriodicMotion<Long> motion(*problem, *orbit, times);
    options.attitude = true;
    options.tolerance /= 1 + motion.periods();
    std::vector<State<Long>> once(motion.once().size());
    const auto made = full_motion<Long>(*problem, orbit->start, motion.once(), once, options);
    if (!made || made->status != ode::Status::reached) return false;
    const auto carried = motion.carry_on(once, made->error, states);
    error = carried.error;
    track.periodicity = {double(orbit->period),      double(orbit->error.period), double(orbit->trace_minus_4),
                         double(orbit->error.trace), double(carried.precession),  double(carried.precession_error)};
  } else {
    const State<double>& s = scene.start();
    const auto& q = s.attitude;
    State<Long> start{s.angular_velocity.cast<Long>(), s.down.cast<Long>().normalized(),
                      normalised(Quat<Long>{q.w, q.x, q.y, q.z})};
    if (options.attitude) start.down = rotate<Long>(conjugate(start.attitude), {0, 0, -1});  // which alone was given
    const auto made = full_motion<Long>(*problem, start, times, states, options);
    if (!made || made->status != ode::Status::reached) return false;
    error = made->error;
  }
  for (const auto& s : states) {
    const auto& q = s.attitude;
    track.states.push_back({s.angular_velocity.cast<double>(),
                            s.down.cast<double>(),
                            {double(q.w), double(q.x), double(q.y), double(q.z)}});
  }
  for (std::size_t i = 0; i < std::size(column_kinds); ++i) track.error[i] = double(error[i]);
  fill(truth, scene, track);
  tell(truth, track.periodicity);
  for (Column& column : truth.columns) column.error += 4e-16;
  for (Quantity& q : truth.quantities)
    q.error += 4e-16 * (q.kind->measure == Measure::absolute ? std::abs(q.values[0]) : 1.0);
  return true;
}

}  // namespace gyrostat::heavy
