// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "gyrostat/ladder/cvode_runs.hpp"
#include "gyrostat/ladder/deceleration/full_motion.hpp"
#include "gyrostat/ladder/deceleration/full_rung.hpp"
#include "gyrostat/ode/cvode.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostat/rotation/kinematics.hpp"

/// The full equations by CVODE (Adams), for comparison. Needs the library gyrostat::cvode.
namespace gyrostat::deceleration {

namespace detail {

/// One CVODE run and its stop.
struct StoppedRun : CvodeRun<State<double>> {
  double stop_time = infinity<double>;
};

struct CvodeProblem {
  const Problem<double>& problem;
  Vec3<double> offset;      ///< M - U
  double greatest_control;  ///< N m

  static Vec3<double> momentum(const double* y) noexcept { return {y[0], y[1], y[2]}; }
  double opposed(const double* y) const noexcept { return (momentum(y) - offset).norm(); }

  static bool rhs(double, const double* y, double* rate, void* user) {
    const auto& self = *static_cast<const CvodeProblem*>(user);
    const Vec3<double> dM = momentum_rate(self.problem, momentum(y));
    std::copy(dM.begin(), dM.end(), rate);
    return dM.allFinite();
  }
  static bool rhs_with_attitude(double t, const double* y, double* rate, void* user) {
    const auto& self = *static_cast<const CvodeProblem*>(user);
    const auto dq = quaternion_rate<double>({y[3], y[4], y[5], y[6]}, self.problem.angular_velocity(momentum(y)));
    rate[3] = dq.w, rate[4] = dq.x, rate[5] = dq.y, rate[6] = dq.z;
    return rhs(t, y, rate, user);
  }
  static bool jacobian(double, const double* y, double* columns, void* user) {
    const auto& self = *static_cast<const CvodeProblem*>(user);
    const Mat3<double> J = momentum_jacobian(self.problem, momentum(y));
    std::copy(J.data(), J.data() + 9, columns);
    return J.allFinite();
  }
  static double step_limit(double, const double* y, void* user) {
    const auto& self = *static_cast<const CvodeProblem*>(user);
    const double U = self.opposed(y);
    const double rate = self.greatest_control + self.problem.drag * (U + self.problem.rotor_momentum.norm());
    return self.greatest_control > 0 ? 0.3 * U / rate : infinity<double>;
  }
};

/// To the stop and behind it, of the scene's problem or one of the same law near it.
inline StoppedRun cvode_run(const Scene& scene, const Problem<double>& problem, const Quat<double>& attitude,
                            std::span<const double> times, double tolerance, double longest, Monitor* monitor) {
  const bool turning = scene.question().wants_attitude;
  const bool total = problem.law == Law::total;
  CvodeProblem user{problem, total ? Vec3<double>::Zero().eval() : problem.rotor_momentum, scene.greatest_control()};
  const Hold<double> hold(problem);
  // what the control opposes, to the digits that are left of it where momenta cancel
  const double parts = problem.momentum.norm() + problem.rotor_momentum.norm();
  const double scale = std::max((problem.momentum - user.offset).norm(), 64 * epsilon<double> * parts);

  std::array<double, 7> y{problem.momentum[0], problem.momentum[1], problem.momentum[2], attitude.w,
                          attitude.x,          attitude.y,          attitude.z};
  const std::size_t n = turning ? 7 : 3;
  ode::CvodeSystem system;
  system.dimension = int(n);
  system.rhs = turning ? &CvodeProblem::rhs_with_attitude : &CvodeProblem::rhs;
  if (!turning) system.jacobian = &CvodeProblem::jacobian;
  system.step_limit = &CvodeProblem::step_limit;
  system.user = &user;

  StoppedRun run;
  const auto keep = [&](const Vec3<double>& M, const Quat<double>& turned) {
    run.states.push_back(state_of(problem, M, turning ? normalised(turned) : attitude));
  };
  const auto keep_numbers = [&](const double* at) { keep(CvodeProblem::momentum(at), {at[3], at[4], at[5], at[6]}); };
  std::size_t next = 0;
  while (next < times.size() && times[next] <= 0) keep_numbers(y.data()), ++next;
  bool at_rest = user.opposed(y.data()) <= 0 && hold.holds;
  double stop = 0, seen = 0;  // when U is at rest, and when it was seen to be all but so, with the attitude of then
  if (!at_rest) {
    auto solver =
        ode::Cvode::create(system, 0, std::span(y).first(n),
                           {ode::CvodeMethod::adams, tolerance, tolerance * (scale > 0 ? std::min(scale, 1.0) : 1.0),
                            ode::CvodeOptions{}.step_cap, longest * times.back()});
    if (!solver) return run.failure = solver.error(), run;
    auto cvode = std::move(solver).value();
    const auto keep_at = [&](double t) {
      std::array<double, 7> at{};
      if (!cvode.at(t, std::span(at).first(n))) return false;
      keep_numbers(at.data());
      return true;
    };
    const auto look_for_rest = [&] {
      std::copy(cvode.state().begin(), cvode.state().end(), y.begin());
      const double U = user.opposed(y.data());
      if (hold.holds && U <= std::max(1e-9, 30 * tolerance) * scale) {
        at_rest = true;
        const Vec3<double> toward = (CvodeProblem::momentum(y.data()) - user.offset) / U;
        seen = cvode.time();
        stop = seen + U / toward.dot(problem.control * toward);
      }
      return !at_rest;
    };
    run.failure = walk(cvode, times, next, run.counts, monitor, keep_at, look_for_rest);
    if (run.failure != Errc::ok) return run;
  }
  if (at_rest) run.stop_time = stop;
  const Vec3<double> rate = problem.angular_velocity(user.offset);
  const Quat<double> turned{y[3], y[4], y[5], y[6]};
  for (; next < times.size(); ++next)
    keep(user.offset, turned * quaternion_from_vector<double>(rate * (times[next] - seen)));
  return run;
}

/// What is not known where a time may lie on either side of the stop: what the control takes away in the time by which the stop may be off.
inline void add_doubt_of_rest(Track& track, const Scene& scene) {
  const auto& problem = scene.problem();
  const double left = scene.greatest_control() * track.stop_error * track.stop_time;
  const double rates = problem.inverse_inertia[2] * left;
  track.error[column::angular_momentum] += left;
  track.error[column::angular_momentum_norm] += left;
  track.error[column::angular_velocity] += rates;
  track.error[column::energy] += rates * (problem.rotor_momentum.norm() + left);
}

}  // namespace detail

/// Rung `full` by CVODE. The error is that of cvode_runs(). Finds the
/// stop only where it lies within the times asked for.
inline Track full_by_cvode(const Scene& scene, Monitor* monitor) {
  double stops[1 + honesty::cvode_companions];  // of the answer and its companions
  double* stop = stops;
  const auto run = [&](std::span<const double> watched, const CvodeTask& task) {
    using Near = detail::Neighbour<double>;
    const auto& problem = scene.problem();
    const Near near = task.change > 0 ? Near(problem, task.change, task.aside) : Near(problem);
    const Quat<double> turn = from_matrix(near.R);
    const bool turned = !near.R.isIdentity(0);
    auto made = detail::cvode_run(scene, near.problem, turned ? scene.attitude() * turn : scene.attitude(), watched,
                                  task.tolerance, task.longest, monitor);
    for (auto& state : made.states) {
      if (!turned) break;
      state.momentum = near.R * state.momentum;
      state.attitude = state.attitude * conjugate(turn);
    }
    *stop++ = made.stop_time;
    return made;
  };
  const auto runs = cvode_runs(Row<double>{scene.problem()}, scene.question().times, scene.goal().tightest, 1e-5, run);
  if (runs.failure != Errc::ok) return refused<Track>(runs.failure, why_cvode_failed(runs.failure));

  // what each step may err by itself adds up, and is shared by the runs where the longest step rules both; one number may have all of the mean square
  const double numbers = scene.question().wants_attitude ? 7 : 3;
  const double of_steps =
      (1 + double(runs.counts.steps) / (1 + honesty::cvode_companions)) * std::sqrt(numbers) * runs.tolerance;
  const auto error = runs.asked.relative(runs.error) + ColumnErrors<double>::all(of_steps);
  Track track = detail::track_of(scene.problem(), runs.states, scene.question().wants_attitude, error);
  track.counts = runs.counts;
  if (std::isfinite(stops[0])) {
    track.stop_time = stops[0];
    double off = 0;
    for (int c = 0; c < honesty::cvode_companions; ++c)
      off = greater(off, runs.margin[c] * std::abs(stops[0] - stops[1 + c]));
    track.stop_error = over(off, stops[0]) + 1e-8 + 1e3 * runs.tolerance;
    if (detail::doubt_modulus_at_stop(track, scene.problem(), scene.question().times))
      detail::add_doubt_of_rest(track, scene);
  }
  return track;
}

}  // namespace gyrostat::deceleration
