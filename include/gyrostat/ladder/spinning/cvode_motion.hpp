// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "gyrostat/ladder/cvode_runs.hpp"
#include "gyrostat/ladder/cvode_walk.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/ladder/spinning/full_rung.hpp"
#include "gyrostat/ladder/spinning/neighbour.hpp"
#include "gyrostat/models/spinning/full.hpp"
#include "gyrostat/models/spinning/spin_angle.hpp"
#include "gyrostat/ode/cvode.hpp"
#include "gyrostat/rotation/kinematics.hpp"

/// The full equations by CVODE (Adams), for comparison. Needs the library gyrostat::cvode.
namespace gyrostat::spinning {

namespace detail {

/// The numbers of FullSystem without the two that nothing needs here, in units of the motion.
class CvodeEquations {
 public:
  static constexpr std::size_t width = 14;
  using Numbers = std::array<double, 16>;
  using Scaled = std::array<double, width>;

  CvodeEquations(const Problem<double>& problem, double span) : problem_(problem), system_(problem) {
    const auto scale = system_.scale(span);
    const double rate = scale[0], time = scale[8];
    unit_ = {rate, rate, rate, 1, 1, 1, 1, 1, time, time, time, time * time, time * time, time * time};
    const double size = problem.force.norm();
    direction_ = size > 0 ? Vec3<double>(problem.force / size) : Vec3<double>(0, 0, 1);
  }

  Scaled start() const noexcept {
    Scaled y{};
    for (std::size_t i = 0; i < width; ++i) y[i] = system_.start()[place(i)] / unit_[i];
    return y;
  }
  Numbers numbers(const double* y) const noexcept {
    Numbers x{};
    for (std::size_t i = 0; i < width; ++i) x[place(i)] = y[i] * unit_[i];
    return x;
  }
  SpinAngle<double>::Sample sample(const double* y) const noexcept {
    const Numbers x = numbers(y);
    return {system_.angular_velocity(x.data()), system_.attitude(x.data()), x[3]};
  }
  State<double> state(double t, const double* y, const Angles<double>& angles) const noexcept {
    const Numbers x = numbers(y);
    const Vec3<double> omega = system_.angular_velocity(x.data());
    const Quat<double> q = system_.attitude(x.data());
    return {omega,
            angles,
            q,
            inertial_momentum(problem_, omega, q),
            system_.velocity(x.data()),
            system_.position(t, x.data())};
  }

  static bool rate(double, const double* y, double* out, void* user) {
    const auto& self = *static_cast<const CvodeEquations*>(user);
    const Numbers x = self.numbers(y);
    const Vec3<double> omega(x[0], x[1], x[2]);
    const Quat<double> q{x[4], x[5], x[6], x[7]};
    const Vec3<double> a = angular_acceleration(self.problem_, omega), d = rotate<double>(q, self.direction_);
    const auto dq = quaternion_rate<double>(q, omega);
    const Scaled value{a[0], a[1], a[2], omega[2], dq.w, dq.x, dq.y, dq.z, d[0], d[1], d[2], x[8], x[9], x[10]};
    double sum = 0;
    for (std::size_t i = 0; i < width; ++i) sum += out[i] = value[i] / self.unit_[i];
    return std::isfinite(sum);
  }

 private:
  static constexpr std::size_t place(std::size_t i) noexcept { return i < 11 ? i : i + 1; }

  const Problem<double>& problem_;
  FullSystem<double> system_;
  Scaled unit_;
  Vec3<double> direction_;
};

/// One CVODE run over these times. least_cosine: a lower bound of cos(psi) on the way.
inline CvodeRun<State<double>> cvode_run(const Problem<double>& problem, std::span<const double> times,
                                         double tolerance, double longest, double& least_cosine, Monitor* monitor) {
  const double end = times.back();
  CvodeEquations equations(problem, end);
  const auto start = equations.start();
  SpinAngle<double> angle(problem);
  CvodeRun<State<double>> run;
  run.states.reserve(times.size());
  const auto keep = [&](double t, const double* y) {
    run.states.push_back(equations.state(t, y, angle.angles()));
    least_cosine = angle.least_cosine();
  };
  if (!(times.front() > 0)) keep(0, start.data());
  if (!(end > 0)) return run;

  ode::CvodeSystem system;
  system.dimension = int(CvodeEquations::width);
  system.rhs = &CvodeEquations::rate;
  system.user = &equations;
  auto made = ode::Cvode::create(
      system, 0, start, {ode::CvodeMethod::adams, tolerance, tolerance, ode::CvodeOptions{}.step_cap, longest * end});
  if (!made) return run.failure = made.error(), run;
  auto cvode = std::move(made).value();
  CvodeEquations::Scaled y{};
  const auto at = [&](double t) {
    cvode.at(t, y);
    return equations.sample(y.data());
  };
  std::size_t next = run.states.size();
  run.failure = walk(
      cvode, times, next, run.counts, monitor,
      [&](double t) {
        angle.follow(t, at(t), at);
        if (!cvode.at(t, y)) return false;
        keep(t, y.data());
        return true;
      },
      [&] {
        angle.follow(cvode.time(), equations.sample(cvode.state().data()), at);
        return true;
      });
  return run;
}

}  // namespace detail

/// Rung `full` by CVODE. The error is that of cvode_runs().
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  const auto& problem = scene.problem();
  const auto& times = scene.question().times;
  const Row<double> row{scales(problem, times.back())};
  const double rate = problem.rate_size(times.back());
  double least_cosine[1 + honesty::cvode_companions] = {1, 1, 1};
  int run = 0;
  auto runs =
      cvode_runs(row, times, scene.goal().tightest, 1e-6, [&](std::span<const double> watched, const CvodeTask& task) {
        const auto of = task.change > 0 ? neighbour(problem, rate, task.change, task.aside) : problem;
        return detail::cvode_run(of, watched, task.tolerance, task.longest, least_cosine[run++], monitor);
      });
  if (runs.failure != Errc::ok) return refused<Track>(runs.failure, why_cvode_failed(runs.failure));

  Track track;
  track.states = std::move(runs.states);
  track.counts = runs.counts;
  auto error = runs.error + honesty::cvode_looser[0] * runs.tolerance * runs.asked.size();
  const double attitude = error[column::attitude];
  error[column::euler_312] = angles_error<double>(attitude, track.states);
  track.error = runs.asked.relative(error);
  if (loses_turns<double>(track.states, problem.angles.phi, least_cosine[0], attitude))
    detail::warn_of_gimbal_lock(track, least_cosine[0]);
  return track;
}

}  // namespace gyrostat::spinning
