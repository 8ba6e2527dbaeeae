// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "gyrostat/ladder/cvode_walk.hpp"
#include "gyrostat/ladder/heavy/full_rung.hpp"
#include "gyrostat/models/heavy/full.hpp"
#include "gyrostat/ode/cvode.hpp"
#include "gyrostat/rotation/kinematics.hpp"

/// The full equations by CVODE (Adams), the trusted outsider. Needs the library gyrostat::cvode.
namespace gyrostat::heavy {

/// The full equations as numbers of order one: (p, q, r over the size that they reach | d | w, x, y, z where the attitude is wanted).
class CvodeEquations {
 public:
  using Numbers = std::array<double, 10>;

  CvodeEquations(const Problem<double>& problem, const State<double>& start, bool turning) noexcept
      : problem_(problem), turning_(turning) {
    const double rate = rate_size(problem, start);
    rate_ = rate > 0 ? rate : 1;
  }

  std::size_t dimension() const noexcept { return turning_ ? 10 : 6; }
  Numbers numbers(const Vec3<double>& w, const Vec3<double>& d, const Quat<double>& q) const noexcept {
    return {w[0] / rate_, w[1] / rate_, w[2] / rate_, d[0], d[1], d[2], q.w, q.x, q.y, q.z};
  }
  State<double> state(const double* y) const noexcept {
    State<double> s{rate_ * Vec3<double>(y[0], y[1], y[2]), {y[3], y[4], y[5]}, {}};
    if (turning_) s.attitude = {y[6], y[7], y[8], y[9]};
    return s;
  }

  /// For ode::Cvode, with a pointer to this for `user`. It must stay where it is while the integrator lives.
  ode::CvodeSystem system() noexcept {
    ode::CvodeSystem made;
    made.dimension = int(dimension());
    made.rhs = &rate;
    made.user = this;
    return made;
  }

 private:
  static bool rate(double, const double* y, double* out, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    const State<double> s = self.state(y);
    const auto made = self.numbers(angular_acceleration<double>(self.problem_, s.angular_velocity, s.down),
                                   fixed_vector_rate<double>(s.down, s.angular_velocity),
                                   quaternion_rate<double>(s.attitude, s.angular_velocity));
    std::copy_n(made.begin(), self.dimension(), out);
    return std::all_of(made.begin(), made.end(), [](double x) { return std::isfinite(x); });
  }

  Problem<double> problem_;
  double rate_;
  bool turning_;
};

namespace detail {

struct CvodeRun {
  std::vector<State<double>> states;
  Errc failure = Errc::ok;
  ode::Counts counts;
};

inline CvodeRun cvode_run(const Scene& scene, double tolerance, Monitor* monitor) {
  const auto& times = scene.question().times;
  const auto& start = scene.start();
  const double end = times.back();
  CvodeEquations equations(scene.problem(), start, scene.question().wants_attitude);
  auto y = equations.numbers(start.angular_velocity, start.down, start.attitude);
  const std::span<double> numbers(y.data(), equations.dimension());
  CvodeRun run;
  run.states.reserve(times.size());
  if (!(times.front() > 0)) run.states.push_back(start);
  if (!(end > 0)) return run;
  auto made = ode::Cvode::create(equations.system(), 0, numbers, {ode::CvodeMethod::adams, tolerance, tolerance});
  if (!made) return run.failure = made.error(), run;
  auto cvode = std::move(made).value();
  std::size_t next = run.states.size();
  run.failure = walk(
      cvode, times, next, run.counts, monitor,
      [&](double t) {
        if (!cvode.at(t, numbers)) return false;
        State<double> state = equations.state(y.data());
        state.attitude = normalised(state.attitude);
        run.states.push_back(state);
        return true;
      },
      [] { return true; });
  return run;
}

}  // namespace detail

/// Rung `full` by CVODE. The error is four times the distance to a second run at a tolerance ten times looser, ten times where the
/// tighter one is the tightest that CVODE is asked for.
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  const double tolerance = std::max(1e-13, scene.question().tolerance * 1e-6);
  auto run = detail::cvode_run(scene, tolerance, monitor);
  if (run.failure != Errc::ok) return refused<Track>(run.failure, message(run.failure));
  const auto looser = detail::cvode_run(scene, 10 * tolerance, monitor);
  if (looser.failure != Errc::ok) return refused<Track>(looser.failure, message(looser.failure));

  Track track;
  Comparison<double> both;
  for (std::size_t i = 0; i < run.states.size(); ++i) both.add(run.states[i], looser.states[i]);
  const auto& apart = both.difference();
  const double floor = 10 * tolerance, rate = rate_size(scene.problem(), scene.start());
  const double margin = tolerance > 1e-13 ? 4 : 10;  // near rounding a tighter tolerance wins little
  track.error = both.relative({margin * apart.angular_velocity + floor * rate, margin * apart.down + floor,
                               scene.question().wants_attitude ? margin * apart.attitude + floor : 0});
  track.states = std::move(run.states);
  track.counts = run.counts;
  track.counts += looser.counts;
  return track;
}

}  // namespace gyrostat::heavy
