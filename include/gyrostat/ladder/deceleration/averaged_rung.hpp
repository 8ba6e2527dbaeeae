// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "gyrostat/core/linkage.hpp"
#include "gyrostat/ladder/deceleration/averaged_motion.hpp"
#include "gyrostat/ladder/deceleration/averaging.hpp"
#include "gyrostat/ladder/honesty.hpp"
#include "gyrostat/models/deceleration/averaging_error.hpp"

/// Rungs `averaged` and `averaged-2` without rotor momentum.
namespace gyrostat::deceleration {

/// The averaged motion without rotor momentum and what its error is made of.
template <class Elliptic>
class AveragedRun {
 public:
  AveragedRun(const Scene& scene, const Polhode<double>& start, double norm, double phase, double tolerance,
              double phase_error) noexcept
      : problem_(scene.problem()),
        greatest_(scene.greatest_control()),
        motion_(problem_, start, norm, phase, tolerance, phase_error) {
    visit(start, norm);
  }

  ode::Status advance(double t, double floor = 0) noexcept {
    const auto status = motion_.advance(t, floor, [this](const Polhode<double>& p, double norm) { visit(p, norm); });
    if (motion_.crossed()) error_.cross(motion_.crossing_norm(), greatest_, problem_.inverse_inertia);
    return status;
  }

  AveragedMotion<Elliptic, double>& motion() noexcept { return motion_; }
  const AveragingError<double>& error() const noexcept { return error_; }

 private:
  void visit(const Polhode<double>& p, double norm) noexcept {
    const auto b = ControlTorques<double>::of(problem_.control, p.axes);
    error_.visit(p, b, mean_torque<Elliptic>(p, b), problem_.drag, norm);
  }

  Problem<double> problem_;
  double greatest_;
  AveragedMotion<Elliptic, double> motion_;
  AveragingError<double> error_;
};

namespace detail {

/// The polhode of the start; where there is none the refusal is not ok.
struct PolhodeStart {
  Polhode<double> polhode{};
  Track refusal;
};

GYROSTAT_COMPILED_ONCE PolhodeStart start_of(const Scene& scene);

GYROSTAT_COMPILED_ONCE void warn_of_start(Track& track, const Scene& scene, const Polhode<double>& p);

GYROSTAT_COMPILED_ONCE void warn_of_motion(Track& track, const AveragingError<double>& error, bool crossed, bool stuck);

GYROSTAT_COMPILED_ONCE State<double> slow_state(const MeanState<double>& s);

/// A mean motion of second order (second_order_track).
template <class Elliptic>
struct SecondOrderPolhode {
  const Problem<double>& problem;
  AveragedRun<Elliptic>& run;
  double phase_error;  ///< local, quarter periods
  /// How far rounding of the data may move the first 1 - k2, relative: near a separatrix that moves the phase.
  double doubt;

  Halt advance(double t, double floor) noexcept {
    if (run.advance(t, floor) != ode::Status::reached) return not_followed(Errc::no_convergence);
    return run.motion().crossed() || run.motion().stuck() ? not_followed(Errc::separatrix) : Halt{};
  }
  bool floored() const noexcept { return run.motion().floored(); }
  double time() const noexcept { return run.motion().time(); }

  Result<State<double>> osculating() noexcept {
    const auto mean = run.motion().state();
    const auto b = ControlTorques<double>::of(problem.control, mean.polhode.axes);
    const auto o =
        oscillation<Elliptic>(mean.polhode, b, mean.norm, mean.phase * Elliptic::complete(mean.polhode.modulus).K);
    const auto p = shifted(mean.polhode, o.spread);
    if (!p.valid) return Errc::separatrix;
    const double norm = mean.norm * (1 + o.norm);
    State<double> state = slow_state({norm, p.polhode, mean.phase});
    state.momentum = momentum_on<Elliptic>(p.polhode, norm, mean.phase * Elliptic::complete(p.polhode.modulus).K);
    return state;
  }

  SlowError<double> first_order() const noexcept {
    return run.error().first_order(problem.momentum.norm(), problem.energy(problem.momentum));
  }
  SlowError<double> second_order() const noexcept { return run.error().second_order(); }
  double lag(double local) noexcept {
    constexpr double quarter =
        2;  // a quarter period is pi/2 rad of the amplitude, and some more where the motion lingers
    return quarter * (honesty::mean_steps * phase_error + (local + doubt) * std::abs(run.motion().state().phase));
  }
  ode::Counts counts() const noexcept { return run.motion().counts(); }
  void warn(Track& track) const { warn_of_motion(track, run.error(), run.motion().crossed(), run.motion().stuck()); }
};

}  // namespace detail

/// First order: started from the osculating polhode, carried down to rest.
template <class Elliptic>
Track averaged_track(const Scene& scene) {
  const auto [start, refusal] = detail::start_of(scene);
  if (refusal.failure != Errc::ok) return refusal;
  const auto& problem = scene.problem();
  const Vec3<double>& M0 = problem.momentum;
  const double norm0 = M0.norm();

  Track track;
  const double tolerance = mean_tolerance(scene);
  AveragedRun<Elliptic> run(scene, start, norm0, 0, tolerance, infinity<double>);
  const double energy0 = problem.energy(M0);
  if (scene.question().rung == any_rung) {
    const auto least = run.error().first_order(norm0, energy0);
    ColumnErrors<double> error;
    error[column::angular_momentum_norm] = least.norm / norm0;
    error[column::energy] = least.energy / energy0;
    error[column::modulus_squared] = least.k2;
    if (scene.goal().excess(error) > 1) return over_tolerance<Track>(error.greatest());
  }
  track.states.reserve(scene.question().times.size());
  for (const double t : scene.question().times) {
    if (run.advance(t) != ode::Status::reached)
      return refused<Track>(Errc::no_convergence, "the mean equations could not be integrated");
    track.states.push_back(detail::slow_state(run.motion().state()));
  }
  auto error = run.error().first_order(norm0, energy0);
  const double breakdown = breakdown_momentum(problem, scene.greatest_control());

  // Below a few breakdown momenta the body falls to the axis of the weakest control, the averaged one need not.
  const double low = 3 * breakdown;
  double late = scene.greatest_control() > 0 ? infinity<double> : 0;
  if (late > 0 && low < norm0 / 2 && run.advance(infinity<double>, low) == ode::Status::reached) {
    const auto s = run.motion().state();
    const auto b = ControlTorques<double>::of(problem.control, s.polhode.axes);
    const double D = mean_torque<Elliptic>(s.polhode, b).deceleration;
    const double tail = low * std::abs(1 / scene.least_control() - 1 / D);
    const double drift = run.error().first_order(norm0, energy0).norm / D;
    const auto stop = run.motion().stop_time();
    if (!stop) return refused<Track>(stop.error(), "the mean equations could not be integrated to rest");
    late = (tail + drift) / *stop;
  }
  if (const auto stop = run.motion().stop_time()) track.stop_time = *stop;
  const double weight = detail::weight_of_rest(scene, track.stop_time);
  if (weight > 1) {
    const auto whole = run.error().first_order(norm0, energy0);
    late += (weight - 1) * (whole.norm / norm0 + whole.energy / energy0);
  }
  if (late > 1) late = infinity<double>;  // not an estimate any more
  track.stop_error = std::isfinite(track.stop_time) ? late + detail::stop_of_steps(weight, tolerance) : 0;

  const double share = tolerance < honesty::mean_fine ? honesty::mean_steps_share : 0;
  const double steps = share * static_cast<double>(run.motion().counts().steps);
  const double local = std::max(honesty::mean_steps, steps) * tolerance, doubt = k2_of_data(problem, start, M0);
  error.norm += local * norm0 + problem.momentum_error();
  error.energy += local * energy0 + problem.energy_error(M0);
  error.k2 += local + doubt;
  if (scene.greatest_control() > 0 && track.states.back().norm < low + error.norm) {  // it is, or may be
    error.norm += std::min(low, norm0) * std::min(1.0, late * track.stop_time * scene.greatest_control() / low);
    error.k2 = 1;
  }
  detail::state_errors(track, error);
  if (!(breakdown < norm0 / 3)) track.leave_domain();
  track.counts = run.motion().counts();
  detail::warn_of_start(track, scene, start);
  detail::warn_of_motion(track, run.error(), run.motion().crossed(), run.motion().stuck());
  if (!Hold<double>(problem).comes) track.stop_time = infinity<double>, track.stop_error = 0;
  withhold_stop(track, scene);
  return track;
}

/// Second order: started from the mean polhode, answered with the osculating one and so with M itself; below
/// `hand_over` breakdown momenta the full equations take over.
template <class Elliptic>
Track averaged_2_track(const Scene& scene, Monitor* monitor) {
  const auto [start, refusal] = detail::start_of(scene);
  if (refusal.failure != Errc::ok) return refusal;
  const auto& problem = scene.problem();
  const Vec3<double>& M0 = problem.momentum;
  const double norm0 = M0.norm();
  const auto b = ControlTorques<double>::of(problem.control, start.axes);
  const double u0 = argument_of<Elliptic>(start, M0);
  const auto away = oscillation<Elliptic>(start, b, norm0, u0);
  const auto mean = shifted(start, -away.spread);
  if (!mean.valid || !(std::abs(away.norm) < .5))
    return refused<Track>(Errc::separatrix, "one oscillation reaches the separatrix: there is no mean polhode");

  // The later the full equations take over, the less the mean ones err there and the more turns the full ones make.
  const double last_norm = hand_over_share(scene) * breakdown_momentum(problem, scene.greatest_control());
  if (!(last_norm < norm0 / 2))
    return refused<Track>(Errc::not_applicable,
                          "the braking is too fast: averaging would hand over to the full equations at the start");

  // A relative error of the mean orbit becomes one of the phase, times the turns made.
  const double tolerance = 1e-3 * mean_tolerance(scene) + 1e-13;
  const double phase_error = mean_phase_error(scene);
  AveragedRun<Elliptic> run(scene, mean.polhode, norm0 * (1 - away.norm), u0 / Elliptic::complete(start.modulus).K,
                            tolerance, phase_error);
  const double doubt = std::min(k2_of_data(problem, start, M0) / start.modulus.kp2, 1e300);
  detail::SecondOrderPolhode<Elliptic> motion{problem, run, phase_error, doubt};
  Track track;
  detail::warn_of_start(track, scene, start);
  return second_order_track(std::move(track), scene, motion, last_norm, tolerance, monitor);
}

}  // namespace gyrostat::deceleration

#ifndef GYROSTAT_COMPILED
#include "gyrostat/ladder/deceleration/averaged_rung_definition.hpp"
#endif
