// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/ladder/cvode_runs.hpp"
#include "gyrostat/ladder/full_motion.hpp"
#include "gyrostat/ladder/heavy/full_motion.hpp"
#include "gyrostat/ladder/heavy/track.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/ode/cvode.hpp"
#include "gyrostat/rotation/kinematics.hpp"

/// The full equations by CVODE (Adams), for comparison. Needs the library gyrostat::cvode.
namespace gyrostat::heavy {

/// The full equations as numbers of order one: (p, q, r over the size that they reach | d | w, x, y, z where the attitude is wanted).
class CvodeEquations {
 public:
  CvodeEquations(const Problem<double>& problem, const State<double>& start, bool turning) noexcept
      : problem_(problem), turning_(turning) {
    const double rate = rate_size(problem, start);
    rate_ = rate > 0 ? rate : 1;
    start_ = numbers(start.angular_velocity, start.down, start.attitude);
  }

  std::vector<double> start() const { return {start_.begin(), start_.begin() + dimension()}; }
  /// With an attitude of unit norm.
  State<double> state(const double* y) const noexcept {
    State<double> made = as_it_stands(y);
    made.attitude = normalised(made.attitude);
    return made;
  }

  /// For ode::Cvode, with a pointer to this for `user`. It must stay where it is while the integrator lives.
  ode::CvodeSystem system() noexcept {
    ode::CvodeSystem made;
    made.dimension = dimension();
    made.rhs = &rate;
    made.user = this;
    return made;
  }

 private:
  using Numbers = std::array<double, 10>;

  int dimension() const noexcept { return turning_ ? 10 : 6; }
  Numbers numbers(const Vec3<double>& w, const Vec3<double>& d, const Quat<double>& q) const noexcept {
    return {w[0] / rate_, w[1] / rate_, w[2] / rate_, d[0], d[1], d[2], q.w, q.x, q.y, q.z};
  }
  State<double> as_it_stands(const double* y) const noexcept {
    State<double> s{rate_ * Vec3<double>(y[0], y[1], y[2]), {y[3], y[4], y[5]}, {}};
    if (turning_) s.attitude = {y[6], y[7], y[8], y[9]};
    return s;
  }

  static bool rate(double, const double* y, double* out, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    const State<double> s = self.as_it_stands(y);
    const auto made = self.numbers(angular_acceleration<double>(self.problem_, s.angular_velocity, s.down),
                                   fixed_vector_rate<double>(s.down, s.angular_velocity),
                                   quaternion_rate<double>(s.attitude, s.angular_velocity));
    std::copy_n(made.begin(), self.dimension(), out);
    return std::all_of(made.begin(), made.end(), [](double x) { return std::isfinite(x); });
  }

  Problem<double> problem_;
  double rate_;
  bool turning_;
  Numbers start_;
};

/// Rung `full` by CVODE, from the scene's start. The error is that of cvode_runs().
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  const auto& times = scene.question().times;
  const auto& start = scene.start();
  const bool turning = scene.question().wants_attitude;
  const Row<double> row = row_of(scene);
  const auto run = [&](std::span<const double> watched, const CvodeTask& task) {
    const ode::CvodeOptions options{ode::CvodeMethod::adams, task.tolerance, task.tolerance, step_budget,
                                    task.longest * times.back()};
    using Near = detail::Neighbour<double>;
    std::optional<Near> near;
    if (task.change > 0) {
      near.emplace(scene.problem(), start, task.change, task.aside, scene.converts_start());
      if (!turning) near->start.attitude = start.attitude;
    }
    CvodeEquations equations(near ? near->problem : scene.problem(), near ? near->start : start, turning);
    auto made = run_cvode(equations, near ? near->start : start, watched, options, monitor);
    if (!near) return made;
    for (auto& state : made.states) {
      const auto attitude = state.attitude;
      state = Near::in_turned_axes(near->turn.transpose(), state);
      if (!turning) state.attitude = attitude;
    }
    return made;
  };
  auto runs = cvode_runs(row, times, scene.goal().tightest, 1e-6, run);
  if (runs.failure != Errc::ok) return refused<Track>(runs.failure, why_cvode_failed(runs.failure));

  Track track;
  track.states = std::move(runs.states);
  track.counts = runs.counts;
  const double floor = honesty::cvode_looser[0] * runs.tolerance;
  const double rate = std::max(rate_size(scene.problem(), start), row.scale[column::angular_velocity]);
  const ColumnErrors<double> parts{rate, 1, turning ? 1.0 : 0.0};
  track.error = runs.asked.relative(runs.error + floor * parts);
  return track;
}

}  // namespace gyrostat::heavy
